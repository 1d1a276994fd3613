//! The places where two intervals come nearest to one another, with each interval replaced by the
//! straight tube along its tangent.
//!
//! If the sections neither turn nor have lobes, the result is close to that of the true surfaces.
//! A few steps are then enough.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::approach::{MARGIN, SHORT, STEPS, STRIDE, Side, refine};
use super::contact::CLEARANCE_NEAR;
use super::interval::At;

/// The sine of the angle below which two tangents count as parallel. With half the value, and with
/// twice, no test is red.
const PARALLEL: f64 = 0.02;

/// The ratio of tubes above which the yarns' true surfaces count as apart, too. With half the
/// value, `flattened_yarns_are_measured_by_their_surfaces` is red; with twice, no test is.
const FAR: f64 = CLEARANCE_NEAR + 0.1;

/// The cosine of the angle up to which two yarns count as running side by side. With half the
/// value, and with twice, no test is red.
const BESIDE: f64 = 0.9;

/// Steps of the golden-section search for the direction that separates two parallel yarns best,
/// over half a turn. They leave an error of at most 2.3e-3 rad in the direction, and of about its
/// square in the ratio. With half the value, and with twice, no test is red.
const AROUND: usize = 13;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The touch of two tubes: the parameters of its place, the factor by which both sections could
/// grow until they touch, and the direction from the first tube to the other at right angles to
/// both surfaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    pub(super) place: DVec2,
    pub(super) ratio: f64,
    pub(super) normal: DVec3,
    /// Whether the steps to the place have converged. Between two yarns that run nearly side by
    /// side the touching point may jump back and forth.
    pub(super) ended: bool,
}

/// The touch of the tubes along the tangents at two places of two yarns: the factor at which they
/// touch, and how far along each yarn the touching point lies from the yarn's place, in intervals.
struct Touch {
    ratio: f64,
    offset: DVec2,
    /// The direction from the first tube to the other.
    normal: DVec3,
}

/// Moves both places from `start` to where the tubes touch. None if the places leave their
/// intervals, if the tubes run side by side and far apart, or if a yarn has no direction.
///
/// Straight tubes along the tangents t₁ and t₂ have the common normal N = t₁ × t₂. Let Δ lead from
/// the first centre to the second, and let h₁ and h₂ be the sections' support functions. Scaled by
/// λ = N·Δ / (h₁(N) + h₂(-N)), both surfaces meet in one point. On bent tubes that point must lie
/// in the sections at both places. The places move towards the point until it does.
pub(super) fn nearest(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<Nearest> {
    let mut place = DVec2::new(one.held(start.x), other.held(start.y));
    let meeting = Meeting::new(one, other, place)?;
    if meeting.passes_far_beside() {
        return None;
    }
    let (mut last, mut ended) = (meeting.touch(), false);
    for _ in 0..STEPS {
        if one.is_gone(place.x, last.offset.x) || other.is_gone(place.y, last.offset.y) {
            return None;
        }
        // On the outer side of a tight bend a full step would overshoot.
        let step = (0.6 * last.offset).clamp(DVec2::splat(-STRIDE), DVec2::splat(STRIDE));
        let next = DVec2::new(one.held(place.x + step.x), other.held(place.y + step.y));
        let moved = (next - place).abs().max_element();
        place = next;
        last = Meeting::new(one, other, place)?.touch();
        if moved < SHORT {
            ended = true;
            break;
        }
    }
    // At a yarn's cut end the touching point may lie beyond the end. Then nothing touches there.
    let beyond = |t: f64, offset: f64| (t <= 0.0 && offset < -MARGIN) || (t >= 1.0 && offset > MARGIN);
    let outside = beyond(place.x, last.offset.x) || beyond(place.y, last.offset.y);
    (!outside).then_some(Nearest { place, ratio: last.ratio, normal: last.normal, ended })
}

/// The place where two tubes that run nearly side by side are nearest to one another: the place
/// where their centrelines are nearest.
pub(super) fn nearest_beside(one: Side<'_>, other: Side<'_>, start: DVec2) -> Option<Nearest> {
    let place = refine(one, other, start).own?;
    let Touch { ratio, normal, .. } = Meeting::new(one, other, place)?.beside();
    Some(Nearest { place, ratio, normal, ended: true })
}

/// Two yarns at two places.
struct Meeting<'a> {
    sides: [Side<'a>; 2],
    at: [At; 2],
    tangents: [DVec3; 2],
    frames: [[DVec3; 2]; 2],
}

impl<'a> Meeting<'a> {
    #[inline]
    fn new(one: Side<'a>, other: Side<'a>, place: DVec2) -> Option<Self> {
        let at = [one.cubic.at(place.x), other.cubic.at(place.y)];
        let tangents = [at[0].velocity.try_normalize()?, at[1].velocity.try_normalize()?];
        let frames = [one.cubic.frame(place.x, tangents[0]), other.cubic.frame(place.y, tangents[1])];
        Some(Self { sides: [one, other], at, tangents, frames })
    }

    fn apart(&self) -> DVec3 {
        self.at[1].position - self.at[0].position
    }

    fn speeds(&self) -> DVec2 {
        DVec2::new(self.at[0].velocity.length(), self.at[1].velocity.length())
    }

    /// The sum of the reaches of both surfaces towards one another along `normal`, and the points
    /// that reach furthest.
    fn reach(&self, normal: DVec3) -> (f64, [DVec3; 2]) {
        let furthest = |yarn: usize, normal: DVec3| {
            self.sides[yarn].support.furthest(self.frames[yarn], self.at[yarn].sizes(), normal)
        };
        let on = [furthest(0, normal), furthest(1, -normal)];
        (normal.dot(on[0]) - normal.dot(on[1]), on)
    }

    /// Whether both yarns run side by side and the direction between their centrelines already
    /// separates them. The best direction separates them at least as well.
    fn passes_far_beside(&self) -> bool {
        let ([tangent, other], apart) = (self.tangents, self.apart());
        let level = apart - apart.dot(tangent) * tangent;
        tangent.dot(other).abs() > BESIDE
            && level.try_normalize().is_some_and(|towards| level.length() > FAR * self.reach(towards).0)
    }

    /// The touch of the tubes.
    fn touch(&self) -> Touch {
        let ([tangent_a, tangent_b], apart) = (self.tangents, self.apart());
        let cross = tangent_a.cross(tangent_b);
        let sine = cross.length();
        if sine <= PARALLEL {
            return self.beside();
        }
        let normal = if cross.dot(apart) < 0.0 { -cross / sine } else { cross / sine };
        let (reach, [on_a, on_b]) = self.reach(normal);
        let ratio = normal.dot(apart) / reach;
        // The way from one surface's point to the other's. It is α times the first tangent minus β
        // times the second.
        let left = apart + ratio * (on_b - on_a);
        let cosine = tangent_a.dot(tangent_b);
        let (along_a, along_b) = (left.dot(tangent_a), left.dot(tangent_b));
        let alpha = (along_a - cosine * along_b) / (sine * sine);
        let beta = (cosine * along_a - along_b) / (sine * sine);
        Touch { ratio, offset: DVec2::new(alpha, beta) / self.speeds(), normal }
    }

    /// The touch of yarns that run side by side. All directions at right angles to the first yarn
    /// are compared, and the one that separates the yarns best counts. The distance of the two
    /// places along the yarns goes into the offset. As a function of the direction, the ratio is a
    /// linear function divided by a convex one. It therefore has one maximum.
    fn beside(&self) -> Touch {
        let ([tangent, tangent_b], apart) = (self.tangents, self.apart());
        let along = apart.dot(tangent);
        let level = apart - along * tangent;
        let towards = level.try_normalize().unwrap_or(self.frames[0][0]);
        let aside = tangent.cross(towards);
        let turned = |angle: f64| towards * angle.cos() + aside * angle.sin();
        let separated = |angle: f64| {
            let normal = turned(angle);
            normal.dot(level) / self.reach(normal).0
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
        // Each place moves by half of the way along the yarns. If the yarns run in opposite
        // directions, both move forward or both back.
        let forward = tangent.dot(tangent_b).signum();
        let offset = 0.5 * along * DVec2::new(1.0, -forward) / self.speeds();
        Touch { ratio: best, offset, normal: turned(angle) }
    }
}
