//! How tightly yarns bend.

use super::interval::{At, Cubic};
use super::support::Support;

/// Places of an interval at which its bend is measured before the tightest is refined.
const SAMPLES: usize = 8;

/// Steps of the golden section: 12 leave 6e-3 of the way between two samples, and a ratio off by the square of that.
const STEPS: usize = 12;

/// Radius of curvature over how far the section reaches into the bend.
fn ratio(at: &At, support: &Support) -> f64 {
    let speed_squared = at.velocity.length_squared();
    let turn = at.velocity.cross(at.acceleration);
    let (speed, turning) = (speed_squared.sqrt(), turn.length());
    // Rounding of a straight line's derivatives is no bend.
    if turning <= 1e-9 * speed * at.acceleration.length() {
        return f64::INFINITY;
    }
    let reach = if support.is_circle() {
        1.0
    } else {
        let inwards = turn.cross(at.velocity).normalize_or_zero();
        support.furthest(at.velocity / speed, inwards).dot(inwards)
    };
    speed_squared * speed / (turning * reach * at.radius[0])
}

/// The least ratio of an interval and where it is, or nothing where it is more than `within`.
///
/// Where the yarn turns straight back the ratio is 0.
pub(super) fn tightest(cubic: &Cubic, support: &Support, within: f64) -> Option<(f64, f64)> {
    if cubic.curvature_bound() > within * cubic.radius_bound() * support.extent() {
        return None;
    }
    let step = 1.0 / SAMPLES as f64;
    let mut best = (f64::INFINITY, 0.0);
    let mut before = cubic.at(0.0);
    let mut turns_back = None;
    for k in 0..=SAMPLES {
        let t = k as f64 * step;
        let here = cubic.at(t);
        let ratio = ratio(&here, support);
        if ratio < best.0 {
            best = (ratio, t);
        }
        if here.velocity.dot(before.velocity) < 0.0 {
            turns_back = Some(t - step);
        }
        before = here;
    }
    if let Some(from) = turns_back {
        // At its slowest a yarn that turns straight back does not move; one in a bend does.
        let slowest = golden(|t| cubic.at(t).velocity.length_squared(), from, from + step);
        let speed = |t: f64| cubic.at(t).velocity.length();
        if speed(slowest) < 1e-4 * speed(from).max(speed(from + step)) {
            return Some((0.0, slowest));
        }
        best = (0.0, slowest);
    }
    // Twice what counts leaves room for a tighter place between two samples.
    if best.0 > 2.0 * within && turns_back.is_none() {
        return None;
    }
    let t = golden(|t| ratio(&cubic.at(t), support), (best.1 - step).max(0.0), (best.1 + step).min(1.0));
    let found = ratio(&cubic.at(t), support);
    let (found, t) = if turns_back.is_none() && best.0 < found { best } else { (found, t) };
    (found < within).then_some((found, t))
}

/// Where `of` is least between `low` and `high`, by golden section.
fn golden(of: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (high - SHARE * (high - low), low + SHARE * (high - low));
    let (mut at_a, mut at_b) = (of(a), of(b));
    for _ in 0..STEPS {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - SHARE * (high - low);
            at_a = of(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + SHARE * (high - low);
            at_b = of(b);
        }
    }
    f64::midpoint(low, high)
}
