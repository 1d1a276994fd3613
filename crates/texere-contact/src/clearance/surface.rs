//! The surface of one interval as a mesh draws it: section, roll and flattening at every place. A
//! place of an interval is *level* with a point if the plane of the section there holds the point.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::approach::Side;
use super::rolls::IntervalRolls;

/// The most steps of Newton's method to the place of an interval that is level with a point. With
/// half the value, and with twice, no test is red.
const STEPS: usize = 8;

/// How far the [`STEPS`] may lead out of the interval, in intervals. With half the value, and with
/// twice, no test is red.
const STRAY: f64 = 0.25;

/// The length of a step that ends the search, in intervals. The next step would be about as long as
/// the square of that length. With half the value, and with twice, no test is red.
const SHORT: f64 = 1e-4;

/// An interval with everything that its surface depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) side: Side<'a>,
    pub(super) rolls: &'a IntervalRolls,
}

/// Position of the section at one place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub(super) centre: DVec3,
    pub(super) tangent: DVec3,
    /// Side and up of the frame along which the yarn is flattened.
    frame: [DVec3; 2],
    /// Half width and half height.
    sizes: DVec2,
    /// The roll's cosine and sine.
    roll: DVec2,
}

impl Stand {
    /// The vector from the centre to `point` of the section, mm.
    pub(super) fn way(&self, point: DVec2) -> DVec3 {
        let point = self.roll.rotate(point) * self.sizes;
        self.frame[0] * point.x + self.frame[1] * point.y
    }

    /// `direction` in the coordinates of the section after the section is turned by its roll: the
    /// components of `direction` along side and up, times half width and half height. The dot
    /// product of the result and a point of the turned section is the point's reach along
    /// `direction`.
    fn across(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.frame[0]), direction.dot(self.frame[1])) * self.sizes
    }

    /// `direction` in the coordinates of the section before the section is turned by its roll.
    pub(super) fn seen(&self, direction: DVec3) -> DVec2 {
        DVec2::new(self.roll.x, -self.roll.y).rotate(self.across(direction))
    }
}

impl Surface<'_> {
    /// Whether the section has neither lobes nor corners, and does not turn.
    pub(super) fn is_simple(&self) -> bool {
        self.side.support.is_smooth() && self.rolls.is_empty()
    }

    /// The section's position at `t`. None if the velocity is 0 there.
    pub(super) fn stand(&self, t: f64) -> Option<Stand> {
        let [centre, velocity, _] = self.side.cubic.path(t);
        let tangent = velocity.try_normalize()?;
        let (frame, sizes) = (self.side.cubic.frame(t, tangent), self.side.cubic.sizes(t));
        let roll = if self.rolls.is_empty() {
            DVec2::X
        } else {
            let cubic = self.side.cubic;
            let lean = if self.rolls.is_carried() { cubic.lean(t, tangent) } else { 0.0 };
            DVec2::from_angle((self.rolls.at(cubic, t) - lean) * TAU)
        };
        Some(Stand { centre, tangent, frame, sizes, roll })
    }

    /// Upper bound of the section's reach in a direction of length 1, whatever its roll, mm.
    pub(super) fn reach(&self, stand: &Stand, direction: DVec3) -> f64 {
        stand.across(direction).length() * self.side.support.extent()
    }

    /// The parameter near `t` of the place that is level with `point`.
    pub(super) fn level_with(&self, point: DVec3, mut t: f64) -> f64 {
        for _ in 0..STEPS {
            let [position, velocity, acceleration] = self.side.cubic.path(t);
            let apart = point - position;
            let (along, flat) = (apart.dot(velocity), velocity.length_squared());
            // If the point lies near the centre of curvature or beyond it, the step is that of a
            // straight line.
            let bent = flat - apart.dot(acceleration);
            let step = along / if bent > 0.1 * flat { bent } else { flat + f64::MIN_POSITIVE };
            let next = (t + step).clamp(-STRAY, 1.0 + STRAY);
            let moved = (next - t).abs();
            t = next;
            if moved < SHORT {
                break;
            }
        }
        t
    }

    /// The factor by which the section grows until the surface meets `point`, and the parameter
    /// near `t` of that place. None if the place belongs to another interval, or if the point is so
    /// far from the centreline that the factor exceeds `most`.
    pub(super) fn growth_at(&self, point: DVec3, t: f64, most: f64) -> Option<(f64, f64)> {
        let t = self.level_with(point, t);
        let reach = most * self.side.support.extent() * self.side.cubic.sizes(t).max_element();
        if self.side.held(t) != t || point.distance_squared(self.side.cubic.position(t)) > reach * reach {
            return None;
        }
        let stand = self.stand(t)?;
        let apart = point - stand.centre;
        let across = DVec2::new(apart.dot(stand.frame[0]), apart.dot(stand.frame[1])) / stand.sizes;
        // The vector is turned back by the roll.
        let unrolled = DVec2::new(stand.roll.x, -stand.roll.y).rotate(across);
        Some((self.side.support.growth_at(unrolled), t))
    }
}
