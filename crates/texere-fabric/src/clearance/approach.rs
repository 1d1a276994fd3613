//! Where two intervals come nearest to one another, refined on the spline.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat2, DVec2, DVec3};

use super::interval::{At, Cubic};
use super::support::{Support, upright};

/// A parameter this near to an interval's beginning is at it; this near to its end it is the next interval's.
const AT_KNOT: f64 = 1e-6;

/// How far, in intervals, refinement may stray out of an interval before the approach is another's.
const MARGIN: f64 = 0.05;

/// Steps of refinement.
const STEPS: usize = 40;

/// The longest step, in intervals.
const STRIDE: f64 = 0.25;

/// A step this short, in intervals, ends refinement: what is left changes a ratio by its square.
const SHORT: f64 = 1e-5;

/// A step so short that it leads nowhere, in intervals.
const CLOSE: f64 = 1e-7;

/// The sine of the angle below which two tangents count as parallel: a crossing so flat is found by its neighbours.
const PARALLEL: f64 = 0.02;

/// Steps of the golden section to the direction that separates two parallel yarns best, out of half a turn: they leave
/// 5e-3 rad, and a ratio off by the square of that.
const AROUND: usize = 13;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

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
    fn own(&self, t: f64) -> Option<f64> {
        if t < AT_KNOT {
            (self.cut[0] || t > -AT_KNOT).then_some(0.0)
        } else if t > 1.0 - AT_KNOT {
            self.cut[1].then_some(1.0)
        } else {
            Some(t)
        }
    }

    /// Whether `t` is held outside of the interval, where it would go on outwards: what it is after is another's.
    fn is_gone(&self, t: f64, direction: f64) -> bool {
        direction != 0.0 && self.held(t + CLOSE * direction.signum()) == t && self.own(t).is_none()
    }

    /// `t`, held at a yarn's own ends and a little outside the interval elsewhere.
    fn held(&self, t: f64) -> f64 {
        let [low, high] =
            [if self.cut[0] { 0.0 } else { -MARGIN }, if self.cut[1] { 1.0 } else { 1.0 + MARGIN }];
        t.clamp(low, high)
    }
}

/// The nearest approach close to parameters `start`: its parameters, and the factor by which both sections could grow
/// until they touch. None where it belongs to other intervals.
pub(super) fn refine(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<(DVec2, f64)> {
    let round = [one, other].iter().all(|side| side.support.is_circle() && side.cubic.is_round());
    let found = if round { refine_round(one, other, start) } else { refine_flat(one, other, start) };
    let (place, ratio) = found?;
    Some((DVec2::new(one.own(place.x)?, other.own(place.y)?), ratio))
}

/// Newton's method on (distance / sum of radii)², by way of |Δ|² - λ² (r₁ + r₂)², whose least value at the least λ is 0
/// (Dinkelbach, "On nonlinear fractional programming", Management Science 13, 1967).
fn refine_round(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<(DVec2, f64)> {
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

/// Both yarns' tangent tubes at two places: the factor at which they touch, and how far along each the touching point
/// lies from its place, in intervals.
struct Touch {
    ratio: f64,
    offset: DVec2,
}

/// Slides both places to where the tubes touch.
///
/// Straight tubes touch where their common normal is N = t₁ × t₂; scaled by λ = N·Δ / (h₁(N) + h₂(-N)), h the sections'
/// support functions, their surfaces meet in one point. On bent tubes that point must lie in the sections of the very
/// two places: the places go towards it until it does.
fn refine_flat(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<(DVec2, f64)> {
    let mut place = DVec2::new(one.held(start.x), other.held(start.y));
    let mut last = touch(one, other, place)?;
    for _ in 0..STEPS {
        if one.is_gone(place.x, last.offset.x) || other.is_gone(place.y, last.offset.y) {
            return None;
        }
        // Outside a tight bend the whole way would overshoot.
        let step = (0.6 * last.offset).clamp(DVec2::splat(-STRIDE), DVec2::splat(STRIDE));
        let next = DVec2::new(one.held(place.x + step.x), other.held(place.y + step.y));
        let moved = (next - place).abs().max_element();
        place = next;
        last = touch(one, other, place)?;
        if moved < SHORT {
            break;
        }
    }
    // At a yarn's cut end the touching point may lie beyond it: then nothing touches there.
    let beyond = |t: f64, offset: f64| (t <= 0.0 && offset < -MARGIN) || (t >= 1.0 && offset > MARGIN);
    let outside = beyond(place.x, last.offset.x) || beyond(place.y, last.offset.y);
    (!outside).then_some((place, last.ratio))
}

fn touch(one: Side<'_>, other: Side<'_>, place: DVec2) -> Option<Touch> {
    let (a, b) = (one.cubic.at(place.x), other.cubic.at(place.y));
    let apart = b.position - a.position;
    let (tangent_a, tangent_b) = (a.velocity.try_normalize()?, b.velocity.try_normalize()?);
    let speeds = DVec2::new(a.velocity.length(), b.velocity.length());
    let frames = [upright(tangent_a), upright(tangent_b)];
    let meet = |normal: DVec3| {
        let on_a = one.support.furthest(frames[0], a.sizes(), normal);
        let on_b = other.support.furthest(frames[1], b.sizes(), -normal);
        let reach = normal.dot(on_a) - normal.dot(on_b);
        (normal.dot(apart) / reach, on_a, on_b)
    };
    let cross = tangent_a.cross(tangent_b);
    let sine = cross.length();
    if sine > PARALLEL {
        let normal = if cross.dot(apart) < 0.0 { -cross / sine } else { cross / sine };
        let (ratio, on_a, on_b) = meet(normal);
        // The way from one surface's point to the other's, as α t₁ - β t₂.
        let left = apart + ratio * (on_b - on_a);
        let cosine = tangent_a.dot(tangent_b);
        let (along_a, along_b) = (left.dot(tangent_a), left.dot(tangent_b));
        let alpha = (along_a - cosine * along_b) / (sine * sine);
        let beta = (cosine * along_a - along_b) / (sine * sine);
        return Some(Touch { ratio, offset: DVec2::new(alpha, beta) / speeds });
    }
    // Side by side: the direction that separates best, level with one another. The ratio, a linear function of the
    // direction over a convex one, has one maximum.
    let tangent = tangent_a;
    let along = apart.dot(tangent);
    let level = apart - along * tangent;
    let towards = level.try_normalize()?;
    let aside = tangent.cross(towards);
    let separated = |angle: f64| {
        let normal = towards * angle.cos() + aside * angle.sin();
        let (_, on_a, on_b) = meet(normal);
        normal.dot(level) / (normal.dot(on_a) - normal.dot(on_b))
    };
    let (mut low, mut high) = (-FRAC_PI_2, FRAC_PI_2);
    let mut tried = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut ratios = tried.map(separated);
    for _ in 0..AROUND {
        if ratios[0] > ratios[1] {
            high = tried[1];
            tried = [high - GOLDEN * (high - low), tried[0]];
            ratios = [separated(tried[0]), ratios[0]];
        } else {
            low = tried[0];
            tried = [tried[1], low + GOLDEN * (high - low)];
            ratios = [ratios[1], separated(tried[1])];
        }
    }
    let best = ratios[0].max(ratios[1]);
    // Half of the way each; of two that run against one another both go forward or back.
    let forward = tangent_a.dot(tangent_b).signum();
    Some(Touch { ratio: best, offset: 0.5 * along * DVec2::new(1.0, -forward) / speeds })
}
