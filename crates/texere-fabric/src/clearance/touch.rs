//! Where the surfaces of two intervals touch as both sections grow, of whatever section, flattening and roll.
//!
//! Points of one surface are tried against the other one, at the growth at which something touched so far: most of them lie
//! outside and are done with. From those that lie inside, or nearly so, the way leads downhill to where the surfaces touch at
//! the least growth close by.

use glam::{DVec2, DVec3, Vec2Swizzles};

use super::contact::CLEARANCE_NEAR;
use super::surface::{Stand, Surface};

/// Points of an outline that are tried: of one without and of one with lobes or corners.
const POINTS: usize = 48;
const POINTS_LOBED: usize = 96;

/// The step along the yarn from one section that is tried to the next, in least half widths or heights of either yarn.
const STEP: f64 = 0.25;

/// The same, in turns of either yarn's roll.
const STEP_TURNS: f64 = 1.0 / 72.0;

/// Sections of an interval that are tried at most.
const SECTIONS_MAX: usize = 256;

/// By how much the growth at a place that is tried may exceed the least so far for the way to lead downhill from there: as
/// much as a lobe rises between two places.
const SLACK: f64 = 0.015;

/// The way downhill ends with steps this much shorter than those between places that are tried.
const FINEST: f64 = 1.0 / 256.0;

/// How exact a growth is worked out.
const EXACT: f64 = 2e-5;

/// Where surfaces touch: parameters of both, and the growth.
type Touch = (DVec2, f64);

/// The least growth at which the surfaces touch, near parameters `start` to begin with, and where. `counts` says whether two
/// parameters may touch. None where that is another interval's, or at more than [`CLEARANCE_NEAR`].
pub(super) fn touch(
    one: &Surface<'_>,
    other: &Surface<'_>,
    start: DVec2,
    counts: impl Fn(DVec2) -> bool,
) -> Option<Touch> {
    // The thinner one's points, so that none of its shape falls between two points of the other.
    let swapped = other.side.cubic.half_bound() < one.side.cubic.half_bound();
    let (place, growth) = if swapped {
        let (place, growth) =
            Search { thin: other, thick: one, counts: |at: DVec2| counts(at.yx()) }.least(start.x)?;
        (place.yx(), growth)
    } else {
        Search { thin: one, thick: other, counts }.least(start.y)?
    };
    Some((DVec2::new(one.side.own(place.x)?, other.side.own(place.y)?), growth))
}

struct Search<'a, F> {
    thin: &'a Surface<'a>,
    thick: &'a Surface<'a>,
    counts: F,
}

/// A point of the thinner surface, its parameter along the yarn and its share of the way round the outline, and the other one's place and growth where they touch.
#[derive(Debug, Clone, Copy)]
struct Found {
    t: f64,
    round: f64,
    other: f64,
    growth: f64,
}

impl<F: Fn(DVec2) -> bool> Search<'_, F> {
    fn least(&self, other: f64) -> Option<Touch> {
        let side = &self.thin.side;
        let (low, high) = (side.held(f64::NEG_INFINITY), side.held(f64::INFINITY));
        let lobed = !(self.thin.side.support.is_smooth() && self.thick.side.support.is_smooth());
        let points = if lobed { POINTS_LOBED } else { POINTS };
        let sections = self.sections();
        let steps = DVec2::new((high - low) / sections as f64, 1.0 / points as f64);
        let mut best: Option<Found> = None;
        let mut tried: Vec<DVec2> = Vec::new();
        let mut beside = other;
        for k in 0..=sections {
            let t = low + k as f64 * steps.x;
            let Some(stand) = self.thin.stand(t) else { continue };
            beside = self.thick.level_with(stand.centre, beside.clamp(0.0, 1.0));
            let towards = self.thick.side.cubic.position(beside) - stand.centre;
            for point in 0..points {
                let round = point as f64 * steps.y;
                let way = self.thin.way(&stand, round);
                if way.dot(towards) < 0.0 {
                    continue;
                }
                let level = best.map_or(CLEARANCE_NEAR, |found| found.growth) + SLACK;
                if self.lies_outside(&stand, way, level, beside) {
                    continue;
                }
                let near = |other: &DVec2| {
                    let apart = (round - other.y).rem_euclid(1.0);
                    (t - other.x).abs() <= 2.0 * steps.x && apart.min(1.0 - apart) <= 2.0 * steps.y
                };
                if tried.iter().any(near) {
                    continue;
                }
                let Some(found) = self.solve(t, round, level, beside) else { continue };
                let lowest = self.downhill(found, steps);
                tried.extend([DVec2::new(t, round), DVec2::new(lowest.t, lowest.round)]);
                if best.is_none_or(|best| lowest.growth < best.growth) {
                    best = Some(lowest);
                }
            }
        }
        best.filter(|best| best.growth <= CLEARANCE_NEAR)
            .map(|best| (DVec2::new(best.t, best.other), best.growth))
    }

    /// How many steps the thinner interval is tried in.
    fn sections(&self) -> usize {
        let [thin, thick] = [self.thin, self.thick].map(|surface| &surface.side);
        let finest = |surface: &Surface<'_>| {
            let [first, last] =
                [surface.rolls.first(), surface.rolls.last()].map(|roll| roll.copied().unwrap_or(0.0));
            (last - first).abs() / surface.side.cubic.length()
        };
        let least = |floors: [f64; 2]| floors[0].min(floors[1]) * 2.0;
        let size = least(thin.cubic.floors()).min(least(thick.cubic.floors()));
        let turning = finest(self.thin).max(finest(self.thick));
        let step = (STEP * size).min(STEP_TURNS / turning.max(f64::MIN_POSITIVE));
        let count = thin.cubic.length() / step;
        if count.is_finite() { (count.ceil() as usize).clamp(4, SECTIONS_MAX) } else { SECTIONS_MAX }
    }

    /// Whether the point of a section grown by `level` lies outside of the other surface grown likewise.
    fn lies_outside(&self, stand: &Stand, way: DVec3, level: f64, beside: f64) -> bool {
        self.excess(stand, way, level, beside).is_none_or(|(excess, _)| excess > 0.0)
    }

    /// By how much more the other surface must grow to meet a point of a section grown by `growth`, and where it does.
    fn excess(&self, stand: &Stand, way: DVec3, growth: f64, beside: f64) -> Option<(f64, f64)> {
        let (needed, other) = self.thick.growth_at(stand.centre + growth * way, beside)?;
        Some((needed - growth, other))
    }

    /// Where the surfaces touch on the ray through the point that lies `round` the outline of the section at `t`, at `level` at most.
    fn solve(&self, t: f64, round: f64, level: f64, beside: f64) -> Option<Found> {
        let stand = self.thin.stand(t)?;
        let way = self.thin.way(&stand, round);
        let mut high = level;
        let (mut over, mut other) =
            self.excess(&stand, way, high, beside).filter(|(excess, _)| *excess <= 0.0)?;
        let (mut low, mut under) = (0.0, f64::INFINITY);
        while high - low > EXACT && over < 0.0 {
            // The secant, or half way where there is none yet or it leads nowhere.
            let secant = low + (high - low) * under / (under - over);
            let middle = f64::midpoint(low, high);
            let inner = (high - low) * 0.02;
            let next = if secant.is_finite() { secant.clamp(low + inner, high - inner) } else { middle };
            match self.excess(&stand, way, next, other) {
                Some((excess, place)) if excess <= 0.0 => (high, over, other) = (next, excess, place),
                Some((excess, _)) => (low, under) = (next, excess),
                None => (low, under) = (next, f64::INFINITY),
            }
        }
        (self.counts)(DVec2::new(t, other)).then_some(Found { t, round, other, growth: high })
    }

    /// From `found` to the least growth close by, with steps that get shorter.
    fn downhill(&self, mut found: Found, mut steps: DVec2) -> Found {
        let finest = steps * FINEST;
        while steps.x > finest.x {
            let better = [
                (1.0, 0.0),
                (-1.0, 0.0),
                (0.0, 1.0),
                (0.0, -1.0),
                (1.0, 1.0),
                (-1.0, -1.0),
                (1.0, -1.0),
                (-1.0, 1.0),
            ]
            .into_iter()
            .find_map(|(along, aside)| {
                let t = self.thin.side.held(found.t + along * steps.x);
                self.solve(t, found.round + aside * steps.y, found.growth - EXACT, found.other)
            });
            match better {
                Some(better) => found = better,
                None => steps /= 2.0,
            }
        }
        found
    }
}
