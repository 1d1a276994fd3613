//! The surfaces of yarns as they are drawn, sampled by separate code of this test: how near they
//! come to one another, and what shows from above.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use texere_core::{Origin, Yarns};

/// Number of rings per interval.
const RINGS: usize = 12;
/// Number of points of a section.
const SIDES: usize = 40;

/// A ring: its middle, its tangent, and its axes with the lengths of half width and half height.
#[derive(Clone, Copy)]
struct Ring {
    middle: DVec3,
    tangent: DVec3,
    side: DVec3,
    up: DVec3,
}

/// The rings of every yarn.
pub(crate) struct Surfaces {
    yarns: Vec<Vec<Ring>>,
    pub(crate) warp: Vec<bool>,
}

/// Value and slope of one coordinate of the cardinal spline of tension 0.
fn spline(four: [f64; 4], t: f64) -> [f64; 2] {
    let [a, b, c, d] = four;
    let (m, n) = ((c - a) / 2.0, (d - b) / 2.0);
    let value = (2.0 * t.powi(3) - 3.0 * t * t + 1.0) * b
        + (t.powi(3) - 2.0 * t * t + t) * m
        + (3.0 * t * t - 2.0 * t.powi(3)) * c
        + (t.powi(3) - t * t) * n;
    let slope = (6.0 * t * t - 6.0 * t) * b
        + (3.0 * t * t - 4.0 * t + 1.0) * m
        + (6.0 * t - 6.0 * t * t) * c
        + (3.0 * t * t - 2.0 * t) * n;
    [value, slope]
}

impl Surfaces {
    pub(crate) fn new(yarns: &Yarns) -> Self {
        let all = (0..yarns.layout().yarns().len()).map(|yarn| {
            let points: Vec<[f64; 5]> = yarns
                .yarn_points(yarn)
                .unwrap()
                .iter()
                .map(|p| [p.x, p.y, p.z, p.half_width(), p.half_height()].map(f64::from))
                .collect();
            let count = points.len();
            let far = |one: [f64; 5], two: [f64; 5]| std::array::from_fn(|of| 2.0 * one[of] - two[of]);
            let at = |place: isize| match place {
                -1 => far(points[0], points[1]),
                place if place as usize == count => far(points[count - 1], points[count - 2]),
                place => points[place as usize],
            };
            let mut rings = Vec::new();
            for interval in 0..count - 1 {
                let four = [-1, 0, 1, 2].map(|step| at(interval as isize + step));
                for ring in 0..RINGS + usize::from(interval + 2 == count) {
                    let t = ring as f64 / RINGS as f64;
                    let of = |of: usize| spline(four.map(|point| point[of]), t);
                    let [x, y, z, wide, high] = [0, 1, 2, 3, 4].map(of);
                    let tangent = DVec3::new(x[1], y[1], z[1]).normalize();
                    let side = DVec3::Z.cross(tangent).normalize();
                    rings.push(Ring {
                        middle: DVec3::new(x[0], y[0], z[0]),
                        tangent,
                        side: side * wide[0],
                        up: tangent.cross(side) * high[0],
                    });
                }
            }
            rings
        });
        let warp = yarns.layout().yarns().iter().map(|yarn| matches!(yarn.origin, Origin::End(_)));
        Self { yarns: all.collect(), warp: warp.collect() }
    }

    /// The factor by which all sections would have to grow until two surfaces touch, kept within
    /// [0.5, 1.03].
    pub(crate) fn clearance(&self) -> f64 {
        let cell = 1.2
            * self
                .yarns
                .iter()
                .flatten()
                .map(|ring| ring.side.length().max(ring.up.length()))
                .fold(0.0, f64::max);
        let key = |at: DVec3| [at.x, at.y].map(|value| (value / cell).floor() as i64);
        let mut cells: HashMap<[i64; 2], Vec<(usize, usize)>> = HashMap::new();
        for (yarn, rings) in self.yarns.iter().enumerate() {
            for (number, ring) in rings.iter().enumerate() {
                cells.entry(key(ring.middle)).or_default().push((yarn, number));
            }
        }
        let mut least: f64 = 1.03;
        for (yarn, rings) in self.yarns.iter().enumerate() {
            for ring in rings {
                let [x, y] = key(ring.middle);
                // For every other yarn, the numbers of its rings near this ring. Its surface is
                // searched from the ring before the first of these to the ring after the last.
                let mut near: HashMap<usize, Vec<usize>> = HashMap::new();
                for (dx, dy) in (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| (dx, dy))) {
                    for &(other, number) in cells.get(&[x + dx, y + dy]).into_iter().flatten() {
                        if other != yarn {
                            near.entry(other).or_default().push(number);
                        }
                    }
                }
                for (other, numbers) in near {
                    let [from, to] = [*numbers.iter().min().unwrap(), *numbers.iter().max().unwrap()];
                    let rings =
                        &self.yarns[other][from.saturating_sub(1)..(to + 2).min(self.yarns[other].len())];
                    for side in 0..SIDES {
                        let (sin, cos) = (side as f64 / SIDES as f64 * std::f64::consts::TAU).sin_cos();
                        let out = ring.side * cos + ring.up * sin;
                        // The factor at which the section of the other yarn reaches the point of
                        // this one, less the factor by which both have grown: negative if the point
                        // lies inside the other yarn.
                        let left =
                            |growth: f64| inside(rings, ring.middle + out * growth).map(|far| far - growth);
                        if left(least).is_some_and(|left| left < 0.0) {
                            let [mut low, mut high] = [0.5, least];
                            for _ in 0..20 {
                                let middle = f64::midpoint(low, high);
                                if left(middle).is_some_and(|left| left < 0.0) {
                                    high = middle
                                } else {
                                    low = middle
                                }
                            }
                            least = high;
                        }
                    }
                }
            }
        }
        least
    }

    /// For each set, the crimp: the length of its yarns over the length that they span, less 1.
    pub(crate) fn crimp(&self) -> [f64; 2] {
        [true, false].map(|warp| {
            let yarns = self.yarns.iter().zip(&self.warp).filter(|(_, is)| **is == warp);
            let [mut taken, mut spanned] = [0.0; 2];
            for (rings, _) in yarns {
                taken += rings.windows(2).map(|two| (two[1].middle - two[0].middle).length()).sum::<f64>();
                let way = rings.last().unwrap().middle - rings[0].middle;
                spanned += if warp { way.y } else { way.x }.abs();
            }
            taken / spanned - 1.0
        })
    }

    /// For each set, the mean width of its threads.
    pub(crate) fn widths(&self) -> [f64; 2] {
        [true, false].map(|warp| {
            let yarns = self.yarns.iter().zip(&self.warp).filter(|(_, is)| **is == warp);
            let widths: Vec<f64> =
                yarns.flat_map(|(rings, _)| rings).map(|ring| 2.0 * ring.side.length()).collect();
            widths.iter().sum::<f64>() / widths.len() as f64
        })
    }

    /// Distance from the lowest surface to the highest.
    pub(crate) fn thickness(&self) -> f64 {
        let reach = |ring: &Ring| ring.up.z.hypot(ring.side.z);
        let high =
            self.yarns.iter().flatten().map(|ring| ring.middle.z + reach(ring)).fold(f64::MIN, f64::max);
        let low =
            self.yarns.iter().flatten().map(|ring| ring.middle.z - reach(ring)).fold(f64::MAX, f64::min);
        high - low
    }

    /// The share of the rectangle between two corners where no yarn lies, and the share where the
    /// weft lies on top, seen straight from above.
    pub(crate) fn seen(&self, corners: [DVec2; 2], pixels: usize) -> [f64; 2] {
        let mut screen = vec![(f64::NEG_INFINITY, false); pixels * pixels];
        let scale = (corners[1] - corners[0]) / pixels as f64;
        for (rings, &warp) in self.yarns.iter().zip(&self.warp) {
            for two in rings.windows(2) {
                let steps =
                    (((two[1].middle - two[0].middle).truncate() / scale).length() * 1.5).ceil().max(1.0);
                let across = ((two[0].side.truncate() / scale).length() * 3.0).ceil().max(2.0);
                for step in 0..steps as usize {
                    let share = step as f64 / steps;
                    let mix = |one: DVec3, two: DVec3| one.lerp(two, share);
                    let (middle, side, up) = (
                        mix(two[0].middle, two[1].middle),
                        mix(two[0].side, two[1].side),
                        mix(two[0].up, two[1].up),
                    );
                    for part in 0..=across as usize {
                        let cos = 2.0 * part as f64 / across - 1.0;
                        let place = middle + side * cos + up * (1.0 - cos * cos).max(0.0).sqrt();
                        let pixel = (place.truncate() - corners[0]) / scale;
                        if pixel.cmpge(DVec2::ZERO).all() && pixel.cmplt(DVec2::splat(pixels as f64)).all() {
                            let shown = &mut screen[pixel.y as usize * pixels + pixel.x as usize];
                            if place.z > shown.0 {
                                *shown = (place.z, warp);
                            }
                        }
                    }
                }
            }
        }
        let share = |of: &dyn Fn(&(f64, bool)) -> bool| {
            screen.iter().filter(|pixel| of(pixel)).count() as f64 / screen.len() as f64
        };
        [share(&|pixel| pixel.0 == f64::NEG_INFINITY), share(&|pixel| pixel.0.is_finite() && !pixel.1)]
    }
}

/// The least factor by which a section between two neighbouring rings has to grow to reach `place`:
/// below 1 inside of the yarn, and 1 on its surface. None if the place lies between no two
/// neighbouring rings.
fn inside(rings: &[Ring], place: DVec3) -> Option<f64> {
    let mut least: Option<f64> = None;
    let before = |ring: &Ring| (place - ring.middle).dot(ring.tangent);
    let mut last = rings.first().map(before)?;
    for two in rings.windows(2) {
        let next = before(&two[1]);
        if last >= 0.0 && next < 0.0 {
            let share = last / (last - next);
            let mix = |one: DVec3, two: DVec3| one.lerp(two, share);
            let from = place - mix(two[0].middle, two[1].middle);
            let along = |axis: DVec3| from.dot(axis) / axis.length_squared();
            let far = along(mix(two[0].side, two[1].side)).hypot(along(mix(two[0].up, two[1].up)));
            least = Some(least.map_or(far, |least| least.min(far)));
        }
        last = next;
    }
    least
}
