//! The surface of one interval as it is drawn: section, roll and flattening at every place.

use glam::{DVec2, DVec3};

use super::approach::Side;
use super::support::upright;

/// Steps of Newton's method to the place of an interval that is level with a point.
const STEPS: usize = 8;

/// How far, in intervals, these steps may lead out of the interval.
const STRAY: f64 = 0.25;

/// A step so short that the place is found, in intervals.
const SHORT: f64 = 1e-7;

/// An interval with all that its surface depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) side: Side<'a>,
    /// Rolls at equal steps from the interval's beginning to its end, turns, without jumps; none where a roll does not matter.
    pub(super) rolls: &'a [f64],
}

/// How the section stands at one place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub(super) centre: DVec3,
    /// The upright frame's side and up.
    frame: [DVec3; 2],
    /// Half width and half height.
    sizes: DVec2,
    /// The roll's cosine and sine.
    roll: DVec2,
}

impl Surface<'_> {
    /// How the section stands at `t`; nowhere where the yarn stands still.
    pub(super) fn stand(&self, t: f64) -> Option<Stand> {
        let at = self.side.cubic.at(t);
        let frame = upright(at.velocity.try_normalize()?);
        Some(Stand { centre: at.position, frame, sizes: at.sizes(), roll: self.roll(t) })
    }

    fn roll(&self, t: f64) -> DVec2 {
        let Some(steps) = self.rolls.len().checked_sub(1).filter(|steps| *steps > 0) else {
            return DVec2::X;
        };
        // Beyond the interval it goes on as it came.
        let place = t * steps as f64;
        let before = (place.max(0.0) as usize).min(steps - 1);
        let [from, to] = [self.rolls[before], self.rolls[before + 1]];
        DVec2::from_angle((from + (place - before as f64) * (to - from)) * std::f64::consts::TAU)
    }

    /// The way from the centre of a section that stands so to the point of its outline that lies `share` of the way round it, mm.
    pub(super) fn way(&self, stand: &Stand, share: f64) -> DVec3 {
        let point = stand.roll.rotate(self.side.support.point(share)) * stand.sizes;
        stand.frame[0] * point.x + stand.frame[1] * point.y
    }

    /// The place near `t` whose cross-section `point` lies in.
    pub(super) fn level_with(&self, point: DVec3, mut t: f64) -> f64 {
        for _ in 0..STEPS {
            let at = self.side.cubic.at(t);
            let apart = point - at.position;
            let (along, flat) = (apart.dot(at.velocity), at.velocity.length_squared());
            // Beyond the centre of a bend the straight line's step.
            let bent = flat - apart.dot(at.acceleration);
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

    /// The factor by which the section grows until the surface meets `point`, and where: near `t`. None where that is no longer
    /// this interval's.
    pub(super) fn growth_at(&self, point: DVec3, t: f64) -> Option<(f64, f64)> {
        let t = self.level_with(point, t);
        if self.side.held(t) != t {
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
