//! Whether one interval only comes nearer to another, or only goes away from it. A knot is a
//! control point, at which one interval ends and the next begins.

use glam::DVec3;

use super::interval::Cubic;

/// The greatest slope that counts as level. A slope is half the derivative of the squared distance
/// at a knot, divided by the sum of both radii and by the speed there.
///
/// The later interval owns a contact at a knot where the distance is level. The earlier interval
/// may be left out if the slope is no more than this, the later one if the slope is more than twice
/// this. In between, [`refine`](super::approach::refine) decides. Refinement leaves an error of the
/// slope of a hundredth of this. At 1e-12 rounding counts crossings on a knot twice
/// (`a_crossing_on_a_control_point_is_one_contact`).
pub(super) const LEVEL: f64 = 1e-8;

/// An interval as Bernstein coefficients, relative to its beginning so that no digits are lost far
/// from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Passing {
    start: DVec3,
    /// The four corners of the interval's Bézier polygon.
    corners: [DVec3; 4],
    velocities: [DVec3; 3],
    /// The coefficients of (A - start) · A', of degree five. A is the place on this interval, and
    /// A' its derivative.
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
            corners: [DVec3::ZERO, c1, c2, c3],
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

    /// Half the slope, along this interval, of the squared distance to corner number `corner` of
    /// `other`'s Bézier polygon. With A the place on this interval and B the corner, these are the
    /// coefficients of (A - B) · A', of degree five in this interval's parameter.
    #[inline]
    fn slopes(&self, other: &Self, corner: usize) -> [f64; 6] {
        let place = other.start - self.start + other.corners[corner];
        let [u, v, w] = self.velocities;
        let (a, b, c) = (place.dot(u), place.dot(v), place.dot(w));
        let own = &self.own;
        // B · A', raised from degree two to five.
        [
            own[0] - a,
            own[1] - (0.6 * a + 0.4 * b),
            own[2] - (0.3 * a + 0.6 * b + 0.1 * c),
            own[3] - (0.1 * a + 0.6 * b + 0.3 * c),
            own[4] - (0.4 * b + 0.6 * c),
            own[5] - c,
        ]
    }

    /// Whether this interval comes nearest to every place of `other` at one of its own knots, and
    /// the contact at that knot belongs to another interval. `cut` says which ends of this interval
    /// are ends of an open yarn. `radii` is the sum of both radii, mm.
    pub(super) fn leaves_to_neighbours(&self, other: &Self, cut: [bool; 2], radii: f64) -> bool {
        let level = |velocity: DVec3| LEVEL * radii * velocity.length();
        let (rises, falls) = (2.0 * level(self.velocities[0]), level(self.velocities[2]));
        (!cut[0] && self.all_slopes(other, |slope| slope > rises))
            || (!cut[1] && self.all_slopes(other, |slope| slope <= falls))
    }

    /// Whether `holds` is true of all slopes, at any place on `other`. All slopes lie between the
    /// least and the greatest of their coefficients, which are tested for each corner of `other`.
    #[inline]
    fn all_slopes(&self, other: &Self, holds: impl Fn(f64) -> bool) -> bool {
        (0..4)
            .all(|corner| self.slopes(other, corner).into_iter().fold(true, |all, slope| all & holds(slope)))
    }
}
