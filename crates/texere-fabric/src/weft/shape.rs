//! The shape of a plain loop, from which those of all others come.

use glam::DVec3;

use super::Gauge;

/// Points of the spline between two control points at which the distance of loops is measured.
const SAMPLES: usize = 16;

/// Depths between which one is sought, in diameters, and in how many halvings.
const DEPTHS: [f64; 2] = [0.5, 0.9];
const HALVINGS: usize = 10;

/// Loops that come this much nearer than they can be are near enough: it costs no depth.
const CLOSE: f64 = 0.004;

/// The first half of a plain loop that is drawn to the face: across in shares of the wale's and the
/// neck's width, height in that of the loop's, and z in depths.
///
/// Feet and heads are round arcs, legs make a V. Feet lie behind the legs of the loop that they
/// come through, legs in front of its head.
pub(super) const FOOT: Node = Node { up: 0.083, z: -0.48 };
pub(super) const LOWER: Node = Node { up: 0.285, z: 0.41 };
pub(super) const LEG: Node = Node { up: 0.5, z: 0.98 };
pub(super) const UPPER: Node = Node { up: 0.715, z: 0.41 };
pub(super) const SHOULDER: Node = Node { up: 0.917, z: -0.48 };
pub(super) const HEAD: Node = Node { up: 1.0, z: -0.84 };
/// The middle of the arc between two loops.
pub(super) const ARC: Node = Node { up: 0.0, z: -0.84 };

/// Half the width of a loop at its feet, at its legs and at its shoulders, in wales.
pub(super) const FOOT_WIDE: f64 = 0.19;
pub(super) const LEG_WIDE: f64 = 0.25;
pub(super) const SHOULDER_WIDE: f64 = 0.31;

/// A place along half a loop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Its height, in heights of the loop.
    pub(super) up: f64,
    /// How far it lies towards the side to which the loop is drawn, in depths.
    pub(super) z: f64,
}

/// The sizes that loops of a cloth have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shape {
    /// From one wale to the next, mm.
    pub(super) wale: f64,
    /// From one course to the next, mm.
    pub(super) course: f64,
    /// Diameter of the thickest yarn, mm.
    pub(super) diameter: f64,
    /// How far a loop reaches out of the plane of the cloth, mm, in units of which [`Node::z`]
    /// counts.
    pub(super) depth: f64,
}

impl Shape {
    /// The flattest loops that come no nearer to one another than they must: clearance rises with
    /// the depth, and then not any more.
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

    /// Height of a loop from foot to head, mm.
    pub(super) fn height(&self) -> f64 {
        1.76 * self.course
    }

    /// Half the width of a loop where it is narrowest, between both feet; so far are two heads
    /// apart, too. mm.
    pub(super) fn narrow(&self) -> f64 {
        (0.53 * self.diameter).max(0.09 * self.wale)
    }

    /// A plain loop and the arc to its left, the loop's middle at x = 0 and its feet at y = 0.
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

    /// The least distance of a plain loop's centreline to those of the courses beside it, in
    /// diameters.
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

/// The spline between the middle two of four points.
pub(super) fn cardinal([before, start, end, after]: [DVec3; 4], t: f64) -> DVec3 {
    let (leaving, arriving, span) = ((end - before) / 2.0, (after - start) / 2.0, end - start);
    let bend = span * 3.0 - leaving * 2.0 - arriving;
    start + (leaving + (bend + (leaving + arriving - span * 2.0) * t) * t) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The depths that a search by another program found, in diameters, by the wale spacing in
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
