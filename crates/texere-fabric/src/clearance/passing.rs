//! Whether one interval goes steadily towards another, or steadily away from it.

use glam::DVec3;

use super::interval::Cubic;

/// What counts as level, in the distance looked within times the speed at a knot: rounding alone.
///
/// At a knot where the distance is level the later interval has it. So the earlier one may be left out where it is no
/// further than this from level, the later one where it rises by twice as much at least: rounding can't lose it between
/// the two.
const LEVEL: f64 = 1e-12;

/// An interval as Bernstein coefficients, relative to where it begins so that nothing is lost far from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Passing {
    start: DVec3,
    /// x, y and z of the four corners of its Bézier polygon.
    corners: [[f64; 4]; 3],
    velocities: [DVec3; 3],
    /// (A - start) · A', of degree five.
    own: [f64; 6],
}

impl Passing {
    pub(super) fn new(cubic: &Cubic) -> Self {
        let start = cubic.position(0.0);
        let [u0, u1, u2] = cubic.velocities();
        let c1 = u0 / 3.0;
        let c2 = c1 + u1 / 3.0;
        let c3 = c2 + u2 / 3.0;
        Self {
            start,
            corners: [[0.0, c1.x, c2.x, c3.x], [0.0, c1.y, c2.y, c3.y], [0.0, c1.z, c2.z, c3.z]],
            velocities: [u0, u1, u2],
            own: [
                0.0,
                0.6 * c1.dot(u0),
                0.3 * c2.dot(u0) + 0.6 * c1.dot(u1),
                0.1 * c3.dot(u0) + 0.6 * c2.dot(u1) + 0.3 * c1.dot(u2),
                0.4 * c3.dot(u1) + 0.6 * c2.dot(u2),
                c3.dot(u2),
            ],
        }
    }

    /// Bounds of half the slope of the squared distance to any point of `other`, along this interval: the least and the
    /// largest coefficient of (A - B) · A', of degree five in its own parameter and three in the other's.
    fn slopes(&self, other: &Self) -> [f64; 2] {
        let shift = other.start - self.start;
        let [x, y, z] = &other.corners;
        let along = |velocity: DVec3| -> [f64; 4] {
            std::array::from_fn(|k| {
                (shift.x + x[k]) * velocity.x + (shift.y + y[k]) * velocity.y + (shift.z + z[k]) * velocity.z
            })
        };
        let [u, v, w] = self.velocities;
        let (a, b, c) = (along(u), along(v), along(w));
        let [mut least, mut most] = [[f64::INFINITY; 4], [f64::NEG_INFINITY; 4]];
        for k in 0..4 {
            // B · A', raised from degree two to five.
            let raised = [
                a[k],
                0.6 * a[k] + 0.4 * b[k],
                0.3 * a[k] + 0.6 * b[k] + 0.1 * c[k],
                0.1 * a[k] + 0.6 * b[k] + 0.3 * c[k],
                0.4 * b[k] + 0.6 * c[k],
                c[k],
            ];
            for (own, others) in self.own.iter().zip(raised) {
                let slope = own - others;
                least[k] = if slope < least[k] { slope } else { least[k] };
                most[k] = if slope > most[k] { slope } else { most[k] };
            }
        }
        [least.into_iter().fold(f64::INFINITY, f64::min), most.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Whether the interval comes nearest to `other` at one of its knots whatever the place on `other`, and that knot
    /// is another interval's to report. `cut` says which of its ends are an open yarn's, `within` how near the two
    /// may be.
    pub(super) fn leaves_to_neighbours(&self, other: &Self, cut: [bool; 2], within: f64) -> bool {
        let [least, most] = self.slopes(other);
        let level = |velocity: DVec3| LEVEL * within * velocity.length();
        (!cut[0] && least > 2.0 * level(self.velocities[0])) || (!cut[1] && most <= level(self.velocities[2]))
    }
}
