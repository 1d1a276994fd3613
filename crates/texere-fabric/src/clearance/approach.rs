//! Where two intervals of round yarns come nearest to one another, refined on the spline.

use glam::{DMat2, DVec2};

use super::interval::{At, Cubic};
use super::support::Support;

/// A parameter this near to an interval's beginning is at it; this near to its end it is the next interval's.
const AT_KNOT: f64 = 1e-6;

/// How far, in intervals, refinement may stray out of an interval before the approach is another's.
pub(super) const MARGIN: f64 = 0.05;

/// Steps of refinement.
pub(super) const STEPS: usize = 40;

/// The longest step, in intervals.
pub(super) const STRIDE: f64 = 0.25;

/// A step this short, in intervals, ends refinement: what is left changes a ratio by its square.
pub(super) const SHORT: f64 = 1e-5;

/// A step so short that it leads nowhere, in intervals.
const CLOSE: f64 = 1e-7;

/// One interval of a yarn, and what it is to its yarn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) cubic: &'a Cubic,
    pub(super) support: &'a Support,
    /// Whether its beginning and its end are an open yarn's.
    pub(super) cut: [bool; 2],
}

impl Side<'_> {
    /// `t`, if it is this interval's: at knots within a yarn the later interval has it.
    pub(super) fn own(&self, t: f64) -> Option<f64> {
        if t < AT_KNOT {
            (self.cut[0] || t > -AT_KNOT).then_some(0.0)
        } else if t > 1.0 - AT_KNOT {
            self.cut[1].then_some(1.0)
        } else {
            Some(t)
        }
    }

    /// Whether `t` is held outside of the interval, where it would go on outwards: what it is after is another's.
    pub(super) fn is_gone(&self, t: f64, direction: f64) -> bool {
        direction != 0.0 && self.held(t + CLOSE * direction.signum()) == t && self.own(t).is_none()
    }

    /// `t`, held at a yarn's own ends and a little outside the interval elsewhere.
    pub(super) fn held(&self, t: f64) -> f64 {
        let [low, high] =
            [if self.cut[0] { 0.0 } else { -MARGIN }, if self.cut[1] { 1.0 } else { 1.0 + MARGIN }];
        t.clamp(low, high)
    }
}

/// The nearest approach of two round yarns close to parameters `start`: its parameters, and the distance over the sum of the
/// radii. None where it belongs to other intervals.
pub(super) fn refine(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<(DVec2, f64)> {
    let (place, ratio) = nearest(one, other, start)?;
    Some((DVec2::new(one.own(place.x)?, other.own(place.y)?), ratio))
}

/// Newton's method on (distance / sum of radii)², by way of |Δ|² - λ² (r₁ + r₂)², whose least value at the least λ is 0
/// (Dinkelbach, "On nonlinear fractional programming", Management Science 13, 1967).
fn nearest(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<(DVec2, f64)> {
    let ratio = |a: &At, b: &At| (a.position - b.position).length() / (a.radius()[0] + b.radius()[0]);
    let held_at = |place: DVec2| DVec2::new(one.held(place.x), other.held(place.y));
    let at = |place: DVec2| (one.cubic.at(place.x), other.cubic.at(place.y));
    let mut place = held_at(start);
    let (mut a, mut b) = at(place);
    let mut lambda = ratio(&a, &b);
    for _ in 0..STEPS {
        let (apart, radii) = (a.position - b.position, a.radius()[0] + b.radius()[0]);
        let held = lambda * lambda;
        let gradient = DVec2::new(
            apart.dot(a.velocity) - held * radii * a.radius()[1],
            -apart.dot(b.velocity) - held * radii * b.radius()[1],
        );
        let across = -a.velocity.dot(b.velocity) - held * a.radius()[1] * b.radius()[1];
        let own = |at: &At, towards: f64| {
            let flat = at.velocity.length_squared();
            let bent = flat + towards * apart.dot(at.acceleration)
                - held * (at.radius()[1] * at.radius()[1] + radii * at.radius()[2]);
            (flat, bent)
        };
        let ((flat_a, bent_a), (flat_b, bent_b)) = (own(&a, 1.0), own(&b, -1.0));
        // Where the distance is not convex, enough is added on the diagonal, by the measure of the straight lines through
        // both places, that it becomes so. A little more keeps parallel lines where they are.
        let scale = DVec2::new(flat_a, flat_b) + f64::MIN_POSITIVE;
        let short = if bent_a > 0.0 && bent_a * bent_b > across * across {
            0.0
        } else {
            let (own, across) = (DVec2::new(bent_a, bent_b) / scale, across / (scale.x * scale.y).sqrt());
            let least = own.x + own.y - (own.x - own.y).hypot(2.0 * across);
            (-least).max(0.0)
        };
        let added = scale * (short + 1e-9);
        let (aa, bb) = (bent_a + added.x, bent_b + added.y);
        if one.is_gone(place.x, -gradient.x) || other.is_gone(place.y, -gradient.y) {
            return None;
        }
        // A parameter that is held where it would go on stays; the other one goes on alone.
        let held_from = |towards: DVec2| {
            let stays = |side: &Side<'_>, t: f64, towards: f64| {
                towards != 0.0 && side.held(t + CLOSE * towards.signum()) == t
            };
            [stays(&one, place.x, towards.x), stays(&other, place.y, towards.y)]
        };
        let alone = |fixed: [bool; 2]| {
            let step = DVec2::new(-gradient.x / aa, -gradient.y / bb);
            DVec2::select(fixed.into(), DVec2::ZERO, step)
        };
        let step = match held_from(-gradient) {
            [false, false] => {
                let hessian = DMat2::from_cols(DVec2::new(aa, across), DVec2::new(across, bb));
                let step = -(hessian.inverse() * gradient);
                match held_from(step) {
                    [false, false] => step,
                    fixed => alone(fixed),
                }
            }
            fixed => alone(fixed),
        };
        // A yarn that stands still at a place has no way to go there.
        let step = if step.is_finite() { step } else { DVec2::ZERO };
        let mut step = step * (STRIDE / step.abs().max_element()).min(1.0);
        // It leads downhill, but it may lead too far: round a sharp bend it would go back and forth without end.
        let moved = loop {
            let next = held_at(place + step);
            let moved = (next - place).abs().max_element();
            let (next_a, next_b) = at(next);
            let next_lambda = ratio(&next_a, &next_b);
            if next_lambda <= lambda || moved < CLOSE {
                (place, a, b, lambda) = (next, next_a, next_b, next_lambda);
                break moved;
            }
            step /= 2.0;
        };
        // Where nothing was added, what is left is the square of it.
        if moved < if short == 0.0 { SHORT } else { CLOSE } {
            break;
        }
    }
    Some((place, lambda))
}
