//! Where two intervals come nearest to one another if each is taken for the straight tube along its tangent: near the truth for
//! sections that neither turn nor have lobes, and soon found.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::approach::{MARGIN, SHORT, STEPS, STRIDE, Side};
use super::support::upright;

/// The sine of the angle below which two tangents count as parallel: a crossing so flat is found by its neighbours.
const PARALLEL: f64 = 0.02;

/// Steps of the golden section to the direction that separates two parallel yarns best, out of half a turn: they leave
/// 5e-3 rad, and a ratio off by the square of that.
const AROUND: usize = 13;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Where two tubes touch: parameters, the factor by which both sections could grow until then, and the way from the first to the
/// other at right angles to both surfaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    pub(super) place: DVec2,
    pub(super) ratio: f64,
    pub(super) normal: DVec3,
}

/// Both yarns' tangent tubes at two places: the factor at which they touch, and how far along each the touching point
/// lies from its place, in intervals.
struct Touch {
    ratio: f64,
    offset: DVec2,
    /// From the first tube to the other.
    normal: DVec3,
}

/// Slides both places from `start` to where the tubes touch: parameters, and the factor by which both sections could grow until
/// then. None where that leads to other intervals, or touches nothing.
///
/// Straight tubes touch where their common normal is N = t₁ × t₂; scaled by λ = N·Δ / (h₁(N) + h₂(-N)), h the sections'
/// support functions, their surfaces meet in one point. On bent tubes that point must lie in the sections of the very
/// two places: the places go towards it until it does.
pub(super) fn nearest(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<Nearest> {
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
    (!outside).then_some(Nearest { place, ratio: last.ratio, normal: last.normal })
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
        return Some(Touch { ratio, offset: DVec2::new(alpha, beta) / speeds, normal });
    }
    // Side by side: the direction that separates best, level with one another. The ratio, a linear function of the
    // direction over a convex one, has one maximum.
    let tangent = tangent_a;
    let along = apart.dot(tangent);
    let level = apart - along * tangent;
    let towards = level.try_normalize()?;
    let aside = tangent.cross(towards);
    let turned = |angle: f64| towards * angle.cos() + aside * angle.sin();
    let separated = |angle: f64| {
        let normal = turned(angle);
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
    let (best, angle) = if ratios[0] > ratios[1] { (ratios[0], tried[0]) } else { (ratios[1], tried[1]) };
    // Half of the way each; of two that run against one another both go forward or back.
    let forward = tangent_a.dot(tangent_b).signum();
    let offset = 0.5 * along * DVec2::new(1.0, -forward) / speeds;
    Some(Touch { ratio: best, offset, normal: turned(angle) })
}
