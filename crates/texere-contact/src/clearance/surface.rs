//! The surface of one interval as it is drawn: section, roll and flattening at every place.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::approach::Side;
use super::rolls::IntervalRolls;

/// Steps of Newton's method to the place of an interval that is level with a point.
const STEPS: usize = 8;

/// How far, in intervals, these steps may lead out of the interval.
const STRAY: f64 = 0.25;

/// A step so short that the next would lead no further than its square, in intervals.
const SHORT: f64 = 1e-4;

/// An interval with all that its surface depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) side: Side<'a>,
    pub(super) rolls: &'a IntervalRolls,
}

/// How the section stands at one place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub(super) centre: DVec3,
    pub(super) tangent: DVec3,
    /// The upright frame's side and up.
    frame: [DVec3; 2],
    /// Half width and half height.
    sizes: DVec2,
    /// The roll's cosine and sine.
    roll: DVec2,
}

impl Stand {
    /// The way from the centre to `point` of the section, mm.
    pub(super) fn way(&self, point: DVec2) -> DVec3 {
        let point = self.roll.rotate(point) * self.sizes;
        self.frame[0] * point.x + self.frame[1] * point.y
    }

    /// `direction` as points of the section that is turned already see it: flattening does to
    /// directions the other way round what it does to points.
    fn across(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.frame[0]), direction.dot(self.frame[1])) * self.sizes
    }

    /// `direction` as points of the section see it.
    pub(super) fn seen(&self, direction: DVec3) -> DVec2 {
        DVec2::new(self.roll.x, -self.roll.y).rotate(self.across(direction))
    }
}

impl Surface<'_> {
    /// Whether the section has neither lobes nor corners, and does not turn.
    pub(super) fn is_simple(&self) -> bool {
        self.side.support.is_smooth() && self.rolls.is_empty()
    }

    /// How the section stands at `t`; nowhere where the yarn stands still.
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

    /// No less than a section that stands so reaches in a direction whose length is 1, whatever its
    /// roll, mm.
    pub(super) fn reach(&self, stand: &Stand, direction: DVec3) -> f64 {
        stand.across(direction).length() * self.side.support.extent()
    }

    /// The place near `t` whose cross-section `point` lies in.
    pub(super) fn level_with(&self, point: DVec3, mut t: f64) -> f64 {
        for _ in 0..STEPS {
            let [position, velocity, acceleration] = self.side.cubic.path(t);
            let apart = point - position;
            let (along, flat) = (apart.dot(velocity), velocity.length_squared());
            // Beyond the centre of a bend the straight line's step.
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

    /// The factor by which the section grows until the surface meets `point`, and where: near `t`.
    /// None where that is no longer this interval's, or so far from the centreline that it is more
    /// than `most`.
    pub(super) fn growth_at(&self, point: DVec3, t: f64, most: f64) -> Option<(f64, f64)> {
        let t = self.level_with(point, t);
        let reach = most * self.side.support.extent() * self.side.cubic.sizes(t).max_element();
        if self.side.held(t) != t || point.distance_squared(self.side.cubic.position(t)) > reach * reach {
            return None;
        }
        let stand = self.stand(t)?;
        let apart = point - stand.centre;
        let across = DVec2::new(apart.dot(stand.frame[0]), apart.dot(stand.frame[1])) / stand.sizes;
        // Turned back by the roll.
        let unrolled = DVec2::new(stand.roll.x, -stand.roll.y).rotate(across);
        Some((self.side.support.growth_at(unrolled), t))
    }
}
