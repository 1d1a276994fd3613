//! The table of the plain loop: the nodes of its feet, legs and head.
//!
//! Every loop of a weft knit starts from this table. A plain loop is symmetrical. Each half has
//! five nodes, from the foot to the shoulder. The head lies between both halves, and an arc between
//! one loop and the next. The yarn is the spline through the nodes.
//!
//! | node | half the width of the loop | height | z |
//! |---|---|---|---|
//! | `HEAD` | 0 | 1 | -0.84 |
//! | `SHOULDER` | 0.31 wales | 0.917 | -0.48 |
//! | `UPPER`: a leg's upper end | half a wale less [`Shape::narrow`] | 0.715 | 0.41 |
//! | `LEG`: its middle | 0.25 wales | 0.5 | 0.98 |
//! | `LOWER`: its lower end | [`Shape::narrow`] | 0.285 | 0.41 |
//! | `FOOT` | 0.19 wales | 0.083 | -0.48 |
//! | `ARC`: half way to the next loop | half a wale | 0 | -0.84 |
//!
//! Heights are in heights of the loop ([`Shape::height`]), from the feet up. z is in depths
//! ([`Shape::depth`]), and is positive on the side to which the loop is drawn. [`Shape::new`] finds
//! the depth.
//!
//! `form.rs` bends the table for loops that are not plain. `path.rs` places loop after loop.

use glam::DVec3;

use super::Gauge;

/// Number of places in each control interval at which [`Shape::clearance`] measures. 8 places give
/// the same depths; with 4, `loops_are_as_deep_as_they_must_be` is red.
const SAMPLES: usize = 16;

/// Range in which [`Shape::new`] seeks the depth, in yarn diameters, and number of times that it
/// halves the range. A search by another program gave 0.64 to 0.70
/// (`loops_are_as_deep_as_they_must_be`). Ten halvings leave 0.0004 diameters; 5 pass that test, 3
/// do not. With half the values, and with twice,
/// `jersey_has_the_loop_length_and_thickness_of_the_books` is red.
const DEPTHS: [f64; 2] = [0.5, 0.9];
const HALVINGS: usize = 10;

/// Clearance by which a loop may fall short of the deepest loop, in diameters. From some depth on,
/// clearance hardly grows. 0 to 0.01 give depths within 0.02 of one another; with 0.02,
/// `loops_are_as_deep_as_they_must_be` is red.
const CLOSE: f64 = 0.004;

/// Nodes of half a plain loop, from foot to head: the table at the head of this file.
///
/// Feet and heads are round arcs, and the legs make a V. Feet lie behind the legs of the loop that
/// they come through, and legs in front of its head. The numbers were read off a plain loop that
/// contact steps had brought to rest. Loops of this shape have to keep a clearance of 0.99 at known
/// depths: `loops_are_as_deep_as_they_must_be` is red with a z of -0.4 at feet or shoulders, 0.3 at
/// an end of a leg, 0.85 or 1.1 at its middle, -0.7 at head or arc, and with a `LOWER.up` of 0.32
/// or an `UPPER.up` of 0.68. It is green with 0.06 and 0.1 for `FOOT.up`, and with 0.45 and 0.55
/// for `LEG.up`.
pub(super) const FOOT: Node = Node { up: 0.083, z: -0.48 };
pub(super) const LOWER: Node = Node { up: 0.285, z: 0.41 };
pub(super) const LEG: Node = Node { up: 0.5, z: 0.98 };
pub(super) const UPPER: Node = Node { up: 0.715, z: 0.41 };
pub(super) const SHOULDER: Node = Node { up: 0.917, z: -0.48 };
pub(super) const HEAD: Node = Node { up: 1.0, z: -0.84 };
/// The middle of the arc between two loops.
pub(super) const ARC: Node = Node { up: 0.0, z: -0.84 };

/// Half the width of a loop at its feet, at the middle of its legs and at its shoulders, in wales.
/// The widths were read off the loop at rest, as the nodes were. With 0.22 at the feet or 0.28 at
/// the shoulders, `loops_are_as_deep_as_they_must_be` is red. It is green with 0.22 and 0.28 at the
/// legs.
pub(super) const FOOT_WIDE: f64 = 0.19;
/// Half the width at the middle of the legs. With half the value, and with twice,
/// `loops_are_as_deep_as_they_must_be` is red.
pub(super) const LEG_WIDE: f64 = 0.25;
/// Half the width at the shoulders. With half the value, and with twice,
/// `loops_are_as_deep_as_they_must_be` is red.
pub(super) const SHOULDER_WIDE: f64 = 0.31;

/// A node of half a loop: its height and its z.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Height above the feet, in heights of the loop ([`Shape::height`]).
    pub(super) up: f64,
    /// Distance from the plane of the cloth towards the side to which the loop is drawn, in depths
    /// ([`Shape::depth`]).
    pub(super) z: f64,
}

/// The sizes that all loops of a cloth have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shape {
    /// Distance from one wale to the next, mm.
    pub(super) wale: f64,
    /// Distance from one course to the next, mm.
    pub(super) course: f64,
    /// Diameter of the thickest yarn, mm.
    pub(super) diameter: f64,
    /// The depth of a loop, mm: how far it reaches out of the plane of the cloth. [`Node::z`]
    /// counts in depths.
    pub(super) depth: f64,
}

impl Shape {
    /// The shape of the flattest loops that keep their distance from one another.
    ///
    /// Clearance rises with the depth at first, and then stays nearly level. The search halves
    /// [`DEPTHS`] towards the depth at which clearance becomes level.
    pub(super) fn new(gauge: &Gauge, diameter: f64) -> Self {
        let of = |depth: f64| Self {
            wale: gauge.wale_mm,
            course: gauge.course_mm,
            diameter,
            depth: depth * diameter,
        };
        let [mut low, mut high] = DEPTHS;
        let enough = of(high).clearance().min(1.0) - CLOSE;
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if of(middle).clearance() < enough {
                low = middle;
            } else {
                high = middle;
            }
        }
        of(high)
    }

    /// Height of a loop from foot to head, mm. The factor was read off the loop at rest, as the
    /// nodes were. 1.6 courses need depths of 0.69 to 0.85 diameters. With 1.6, 1.7, 1.85 and 1.9,
    /// `loops_are_as_deep_as_they_must_be` is red.
    pub(super) fn height(&self) -> f64 {
        1.76 * self.course
    }

    /// Half the width of a loop at the lower ends of its legs, where it is narrowest, mm.
    /// Neighbouring loops are equally close at the upper ends of their legs. 0.53 diameters keep
    /// two yarns just clear of touching there; with 0.6, `loops_are_as_deep_as_they_must_be` is
    /// red. 0.09 wales are by eye.
    pub(super) fn narrow(&self) -> f64 {
        (0.53 * self.diameter).max(0.09 * self.wale)
    }

    /// Control points of a plain loop and of the arc to its left. The loop's middle is at x = 0 and
    /// its feet are at y = 0. Only the search for the depth needs them: `form.rs` places the loops
    /// of a knit.
    fn plain(&self) -> Vec<DVec3> {
        let at = |x: f64, node: Node| DVec3::new(x, node.up * self.height(), node.z * self.depth);
        let (wale, narrow) = (self.wale, self.narrow());
        let half = |hand: f64| {
            [
                at(hand * FOOT_WIDE * wale, FOOT),
                at(hand * narrow, LOWER),
                at(hand * LEG_WIDE * wale, LEG),
                at(hand * (0.5 * wale - narrow), UPPER),
                at(hand * SHOULDER_WIDE * wale, SHOULDER),
            ]
        };
        let mut points = vec![at(-0.5 * wale, ARC)];
        points.extend(half(-1.0));
        points.push(at(0.0, HEAD));
        points.extend(half(1.0).into_iter().rev());
        points
    }

    /// Least distance from the centreline of a plain loop to the course above it, in diameters.
    fn clearance(&self) -> f64 {
        let points = self.plain();
        let count = points.len() as isize;
        let at = |number: isize| {
            let loops = number.div_euclid(count) as f64;
            points[number.rem_euclid(count) as usize] + DVec3::X * (loops * self.wale)
        };
        let sample = |number: usize| {
            let (interval, t) = ((number / SAMPLES) as isize, (number % SAMPLES) as f64 / SAMPLES as f64);
            cardinal([-1, 0, 1, 2].map(|step| at(interval + step)), t)
        };
        let curve: Vec<_> = (0..points.len() * SAMPLES).map(sample).collect();
        let mut least = f64::INFINITY;
        for across in -1..=1 {
            let next = DVec3::new(f64::from(across) * self.wale, self.course, 0.0);
            for one in &curve {
                for other in &curve {
                    least = least.min(one.distance_squared(*other + next));
                }
            }
        }
        least.sqrt() / self.diameter
    }
}

/// The cardinal spline between the middle two of four points, at `t` from 0 to 1.
pub(super) fn cardinal([before, start, end, after]: [DVec3; 4], t: f64) -> DVec3 {
    let (leaving, arriving, span) = ((end - before) / 2.0, (after - start) / 2.0, end - start);
    let bend = span * 3.0 - leaving * 2.0 - arriving;
    start + (leaving + (bend + (leaving + arriving - span * 2.0) * t) * t) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wale spacing, and the depth that a search by another program found for it, both in
    /// diameters.
    const DEPTHS: [(f64, f64); 6] =
        [(4.2, 0.70), (4.5, 0.68), (5.0, 0.67), (6.0, 0.65), (8.0, 0.64), (10.0, 0.64)];

    #[test]
    fn loops_are_as_deep_as_they_must_be() {
        for (wale, depth) in DEPTHS {
            let shape = Shape::new(&Gauge::new(0.3 * wale, 0.3 * 0.75 * wale), 0.3);
            assert!((shape.depth / 0.3 - depth).abs() < 0.02, "{wale}: {shape:?}");
            assert!(shape.clearance() > 0.99, "{wale}: {}", shape.clearance());
        }
    }

    #[test]
    fn a_spline_goes_through_its_points() {
        let points = [0.0, 1.0, 3.0, 4.0].map(|x| DVec3::new(x, x * x, 1.0));
        assert_eq!([cardinal(points, 0.0), cardinal(points, 1.0)], [points[1], points[2]]);
        // A straight line stays one.
        assert_eq!(cardinal([0.0, 1.0, 2.0, 3.0].map(|x| DVec3::X * x), 0.25), DVec3::X * 1.25);
    }
}
