//! Tests of a ray against boxes and triangles.

use texere_core::{Bounds, Ray};

/// The ray counts as not moving along an axis if the size of the scaled direction's component is
/// below this. Directions are scaled so that the largest component is from 1 to 4, or less if it
/// was subnormal.
const NO_WAY: f64 = 1e-290;

/// The factor by which the distance at which a ray leaves a box is enlarged. The distances at which
/// a ray enters and leaves a box are each off by at most three roundings.
const BOX_SLACK: f64 = 1.0 + 8.0 * f64::EPSILON;

/// A ray, prepared for tests against boxes and triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beam {
    origin: [f64; 3],
    /// One over each component of the scaled direction; infinite along axes on which the ray does
    /// not move.
    inverse: [f64; 3],
    /// The numbers of the three axes. The ray moves most along the last.
    axes: [usize; 3],
    /// How far the ray moves along the first two of `axes` for each unit along the last. The third
    /// number is one over the scaled direction's component along the last.
    shear: [f64; 3],
    /// The power of two by which the direction was multiplied.
    scale: f64,
}

/// Where a triangle was hit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// Distance from the origin, in lengths of the scaled direction.
    pub(super) along: f64,
    /// The barycentric weight of each corner.
    pub(super) weights: [f64; 3],
}

impl Beam {
    /// Prepares `ray`. None for a ray that goes nowhere, or whose numbers are not finite.
    pub(super) fn new(ray: &Ray) -> Option<Self> {
        let Ray { origin, direction } = *ray;
        let largest = direction.into_iter().fold(0.0f64, |most, component| most.max(component.abs()));
        let finite = origin.into_iter().chain(direction).all(f64::is_finite);
        if !finite || largest == 0.0 {
            return None;
        }
        // Scaling by a power of two is exact, and keeps what follows from overflowing.
        let exponent = (largest.to_bits() >> 52) & 0x7ff;
        let scale = f64::from_bits((2046 - exponent).max(1) << 52);
        let direction = direction.map(|component| component * scale);
        let most = (0..3).max_by(|&one, &other| direction[one].abs().total_cmp(&direction[other].abs()))?;
        let axes = [(most + 1) % 3, (most + 2) % 3, most];
        let way = direction[most];
        Some(Self {
            origin,
            inverse: direction.map(|way| if way.abs() < NO_WAY { f64::INFINITY } else { 1.0 / way }),
            axes,
            shear: [direction[axes[0]] / way, direction[axes[1]] / way, 1.0 / way],
            scale,
        })
    }

    /// A distance, given in lengths of the scaled direction, in lengths of the ray's own direction.
    pub(super) fn unscaled(&self, along: f64) -> f64 {
        along * self.scale
    }

    /// The distance at which the ray enters a box; 0 if the ray begins inside. None if the ray
    /// misses the box, or enters it only after `most`.
    pub(super) fn enters(&self, bounds: &Bounds, most: f64) -> Option<f64> {
        let (mut entry, mut exit) = (0.0f64, most);
        for axis in 0..3 {
            let (origin, inverse) = (self.origin[axis], self.inverse[axis]);
            let [low, high] = [bounds.low[axis], bounds.high[axis]].map(|at| f64::from(at) - origin);
            if inverse == f64::INFINITY {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (first, last) = if inverse < 0.0 { (high, low) } else { (low, high) };
            entry = entry.max(first * inverse);
            exit = exit.min(last * inverse * BOX_SLACK);
        }
        (entry <= exit).then_some(entry)
    }

    /// The place at which the ray hits a triangle, from either side.
    ///
    /// The triangle is sheared so that the ray becomes an axis. The side of an edge on which the
    /// ray passes is the sign of a product. Both triangles at an edge work out the same product,
    /// with opposite signs, so no ray slips through between them.
    ///
    /// **Source**: Woop, Benthin and Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013.
    /// The paper falls back to double precision; here everything is in double precision.
    pub(super) fn touches(&self, corners: [[f32; 3]; 3]) -> Option<Touch> {
        let ([x, y, z], [across, up, along]) = (self.axes, self.shear);
        let [a, b, c] = corners.map(|corner| {
            let at = |axis: usize| f64::from(corner[axis]) - self.origin[axis];
            [at(x) - across * at(z), at(y) - up * at(z), along * at(z)]
        });
        let edge = |one: [f64; 3], other: [f64; 3]| one[0] * other[1] - one[1] * other[0];
        let sides = [edge(c, b), edge(a, c), edge(b, a)];
        // NaN fails both comparisons, and so is no hit.
        let inside = sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
        let whole = sides[0] + sides[1] + sides[2];
        if !inside || whole == 0.0 {
            return None;
        }
        let weights = sides.map(|side| side / whole);
        let along = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
        (along >= 0.0).then_some(Touch { along, weights })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;

    const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 3.0]];

    fn beam(origin: [f64; 3], direction: [f64; 3]) -> Beam {
        Beam::new(&Ray { origin, direction }).unwrap()
    }

    #[test]
    fn a_triangle_is_hit_from_either_side_and_never_behind() {
        for (z, down) in [(9.0, -1.0), (-9.0, 1.0)] {
            let beam = beam([1.0, 2.0, z], [0.0, 0.0, down]);
            let touch = beam.touches(TRIANGLE).unwrap();
            assert_eq!(beam.unscaled(touch.along), (z - 2.0).abs());
            assert_eq!(touch.weights, [0.25, 0.25, 0.5]);
        }
        assert!(beam([1.0, 2.0, 9.0], [0.0, 0.0, 1.0]).touches(TRIANGLE).is_none());
        assert!(beam([3.0, 2.0, 9.0], [0.0, 0.0, -1.0]).touches(TRIANGLE).is_none());
        let flat = [TRIANGLE[0], TRIANGLE[1], TRIANGLE[1]];
        assert!(beam([1.0, 0.0, 9.0], [0.0, 0.0, -1.0]).touches(flat).is_none());
    }

    #[test]
    fn lengths_of_the_direction_are_lengths_of_the_direction() {
        for length in [1.0, 3.0, 1e-300, 1e300, 5e-324, f64::MAX] {
            let beam = beam([1.0, 2.0, 9.0], [0.0, 0.0, -length]);
            let along = beam.unscaled(beam.touches(TRIANGLE).unwrap().along);
            assert!((along * length - 7.0).abs() < 1e-12 || !(along * length).is_normal(), "{length}");
            assert!(beam.enters(&Bounds { low: [0.0; 3], high: [4.0; 3] }, f64::INFINITY).is_some());
        }
    }

    #[test]
    fn rays_that_are_none_are_refused() {
        let nan = f64::NAN;
        for (origin, direction) in [
            ([0.0; 3], [0.0; 3]),
            ([0.0; 3], [0.0, nan, 1.0]),
            ([nan, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0; 3], [f64::INFINITY, 0.0, 0.0]),
        ] {
            assert!(Beam::new(&Ray { origin, direction }).is_none());
        }
        // The numbers are finite, but far too large: nothing is hit, and nothing panics.
        assert!(beam([1e300, 1e300, 1e300], [-1.0, -1.0, -1.0]).touches(TRIANGLE).is_none());
    }

    #[test]
    fn a_ray_within_the_face_of_a_box_meets_it() {
        let bounds = Bounds { low: [0.0; 3], high: [4.0; 3] };
        assert_eq!(beam([0.0, 4.0, 9.0], [0.0, 0.0, -1.0]).enters(&bounds, 9.0), Some(5.0));
        assert_eq!(beam([0.0, 4.0, 9.0], [0.0, 0.0, -1.0]).enters(&bounds, 4.5), None);
        assert_eq!(beam([0.0, 4.5, 9.0], [0.0, 0.0, -1.0]).enters(&bounds, 9.0), None);
        assert_eq!(beam([2.0, 2.0, 2.0], [0.0, 1.0, -1.0]).enters(&bounds, 9.0), Some(0.0));
        assert_eq!(beam([2.0, 2.0, 2.0], [0.0, 1.0, -1.0]).enters(&Bounds::NOTHING, 9.0), None);
    }
}
