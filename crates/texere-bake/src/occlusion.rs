//! Ambient occlusion of a surface that is given by its heights.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// The number of upright planes in which the horizon is looked for, each in two opposite
/// directions.
const SLICES: u32 = 8;

/// The most places that are looked at along each direction. At the usual size of texels and the
/// usual reach, no texel is passed over.
const STEPS: u32 = 64;

/// The share of the light of an even sky that reaches each texel of a surface, from 0 to 1.
/// `height` (mm) and `normal` (x to the right, y up, z out of the surface) have a value for each
/// texel, row by row from the top. `texel_mm` is the width and the height of a texel. Only what
/// lies within `reach_mm` takes light away. If the map `tiles`, the surface goes on beyond its
/// edges.
///
/// **Source**: Jimenez, Wu, Pesce and Jarabo 2016, Practical Realtime Strategies for Accurate
/// Indirect Occlusion, equation 7: the light between two horizons, weighted by its cosine.
///
/// ```
/// // Nothing takes light from a plane.
/// let light = texere_bake::occlusion(&[0.0; 16], &[[0.0, 0.0, 1.0]; 16], [4, 4], [0.1, 0.1], 1.0, true);
/// assert!(light.iter().all(|light| (light - 1.0).abs() < 1e-6));
/// ```
///
/// **Panics** if there is not a height and a normal for each texel.
#[must_use]
pub fn occlusion(
    height: &[f32],
    normal: &[[f32; 3]],
    size: [u32; 2],
    texel_mm: [f64; 2],
    reach_mm: f64,
    tiles: bool,
) -> Vec<f32> {
    let count = size[0] as usize * size[1] as usize;
    assert!(height.len() == count && normal.len() == count, "a height and a normal for each texel");
    let surface = Surface { height, size: size.map(i64::from), texel_mm, reach_mm, tiles };
    let light = |(at, normal): (usize, &[f32; 3])| {
        let place = [at as i64 % surface.size[0], at as i64 / surface.size[0]];
        surface.light(place, DVec3::from(normal.map(f64::from))) as f32
    };
    normal.par_iter().enumerate().map(light).collect()
}

#[derive(Debug, Clone, Copy)]
struct Surface<'a> {
    height: &'a [f32],
    size: [i64; 2],
    texel_mm: [f64; 2],
    reach_mm: f64,
    tiles: bool,
}

impl Surface<'_> {
    fn light(&self, place: [i64; 2], normal: DVec3) -> f64 {
        let sum: f64 = (0..SLICES)
            .map(|slice| {
                let direction = DVec2::from_angle(PI * (f64::from(slice) + 0.5) / f64::from(SLICES));
                self.light_of_slice(place, normal, direction)
            })
            .sum();
        (sum / f64::from(SLICES)).clamp(0.0, 1.0)
    }

    /// The light that comes in the upright plane along `direction`.
    fn light_of_slice(&self, place: [i64; 2], normal: DVec3, direction: DVec2) -> f64 {
        let along = direction.extend(0.0);
        let (aside, up) = (normal.dot(along), normal.z);
        let length = aside.hypot(up);
        if length == 0.0 {
            return 0.0;
        }
        // The angle from the vertical to the normal within the plane.
        let lean = aside.atan2(up);
        let [back, ahead] = [-direction, direction].map(|way| self.horizon(place, way));
        // Light from below the surface itself does not count.
        let [back, ahead] = [(-back).max(lean - FRAC_PI_2), ahead.min(lean + FRAC_PI_2)];
        let arc = |horizon: f64| lean.cos() + 2.0 * horizon * lean.sin() - (2.0 * horizon - lean).cos();
        length * (arc(back) + arc(ahead)) / 4.0
    }

    /// The angle from the vertical to the horizon in `direction`. The horizon is the place that is
    /// seen at the steepest angle upwards. It is level if no place is higher than `place`.
    fn horizon(&self, place: [i64; 2], direction: DVec2) -> f64 {
        let own = self.at(place).unwrap_or(0.0);
        let step = self.texel_mm[0].min(self.texel_mm[1]);
        let steps = (self.reach_mm / step).clamp(1.0, f64::from(STEPS)).floor();
        let mut steepest = 0.0_f64;
        for number in 1..=steps as u32 {
            let wanted = self.reach_mm * f64::from(number) / steps;
            // Rows go down, and y goes up.
            let right = (direction.x * wanted / self.texel_mm[0]).round() as i64;
            let down = (-direction.y * wanted / self.texel_mm[1]).round() as i64;
            let away = (right as f64 * self.texel_mm[0]).hypot(down as f64 * self.texel_mm[1]);
            if let Some(there) = self.at([place[0] + right, place[1] + down]).filter(|_| away > 0.0) {
                steepest = steepest.max((there - own) / away);
            }
        }
        FRAC_PI_2 - steepest.atan()
    }

    /// The height at a column and a row. None if they lie beyond the edge of a map that does not
    /// tile.
    fn at(&self, [column, row]: [i64; 2]) -> Option<f64> {
        let [width, height] = self.size;
        let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
        if !is_inside && !self.tiles {
            return None;
        }
        let at = row.rem_euclid(height) * width + column.rem_euclid(width);
        Some(f64::from(self.height[at as usize]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The floor of an endless trench sees an endless strip of sky. In the middle of the floor the
    /// strip's form factor is the sine of the angle from the vertical to the trench's edges.
    #[test]
    fn the_floor_of_a_trench_sees_the_strip_above_it() {
        let (width, floor, deep) = (400_i64, 20_i64, 0.5_f64);
        let height: Vec<f32> = (0..width * 3)
            .map(|at| if (at % width - width / 2).abs() <= floor { 0.0 } else { deep as f32 })
            .collect();
        let normal = vec![[0.0, 0.0, 1.0]; height.len()];
        let light = occlusion(&height, &normal, [width as u32, 3], [0.02; 2], 1.28, true);
        // The walls stand 21 texels away from the middle.
        let half = 0.42_f64;
        let exact = half / half.hypot(deep);
        let middle = f64::from(light[(width + width / 2) as usize]);
        assert!((middle - exact).abs() < 0.02, "{middle} for {exact}");
        // Beside a wall half of the sky is hidden, and the far wall hides little.
        let beside = f64::from(light[(width + width / 2 + floor) as usize]);
        let exact = 0.5 * (0.02_f64 / 0.02_f64.hypot(deep) + 0.82 / 0.82_f64.hypot(deep));
        assert!((beside - exact).abs() < 0.03, "{beside} for {exact}");
        // Nothing stands above the walls.
        assert!(light[width as usize] > 0.99);
    }

    /// A slope with nothing round it sees the part of the sky that lies above its own plane.
    #[test]
    fn a_slope_sees_the_sky_above_its_plane() {
        for degrees in [0.0_f64, 20.0, 45.0, 70.0] {
            let lean = degrees.to_radians();
            let side = 101_i64;
            let slope = -lean.tan();
            let height: Vec<f32> =
                (0..side * side).map(|at| (slope * (at % side) as f64 * 0.01) as f32).collect();
            let normal = vec![[lean.sin() as f32, 0.0, lean.cos() as f32]; height.len()];
            let light = occlusion(&height, &normal, [side as u32; 2], [0.01; 2], 0.4, false);
            // The form factor of a leaning plane for the sky. The plane faces some directions below
            // the level horizon, and no light comes from these.
            let exact = (1.0 + lean.cos()) / 2.0;
            let middle = f64::from(light[(side * side / 2) as usize]);
            assert!((middle - exact).abs() < 0.02, "{degrees}: {middle} for {exact}");
        }
    }
}
