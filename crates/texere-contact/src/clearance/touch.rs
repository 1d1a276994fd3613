//! The place where the surfaces of two intervals touch first as both sections grow, for any
//! section, flattening and roll.
//!
//! Both yarns grow until they touch. The *growth* is the factor on both sections. It is 1 for the
//! yarns as they are. A point of the thinner surface touches the thicker one at some growth, and
//! the least growth over all points is the contact's ratio. Most points need more growth than the
//! least so far. One test at the least growth so far rejects such a point.
//!
//! ```text
//! best = the least growth found from the approaches of the centrelines
//! for each section along the thinner yarn:
//!     for each place of the thicker yarn that is level with it:
//!         skip the section if both surfaces are out of reach at growth best
//!         for each point of the section's outline:
//!             skip it if it lies outside the thicker surface at growth best
//!             growth = where the point's ray meets the thicker surface, by secants
//!             best = min(best, growth after a descent along the yarn and round it)
//! ```
//!
//! Sections that neither turn nor have lobes need one descent only. It starts where the straight
//! tubes along both tangents touch (see [`tubes`] and [`touch_near`]).

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec2Swizzles};

use super::approach::Side;
use super::contact::CLEARANCE_NEAR;
use super::surface::{Stand, Surface};
use super::tubes::{self, Nearest};

/// Number of points that are tried of an outline without lobes and corners.
const POINTS: usize = 48;

/// Number of points that are tried of an outline with lobes or corners.
const POINTS_LOBED: usize = 96;

/// The step along the yarn between sections that are tried, as a share of the sum of both yarns'
/// least half widths or heights. With half the value, `plied_threads_in_their_own_room_stay_clear`
/// is red; with twice, no test is.
const STEP: f64 = 0.25;

/// The step along the yarn between sections that are tried, in turns of either yarn's roll. The
/// shorter of this step and [`STEP`] counts.
const STEP_TURNS: f64 = 1.0 / 72.0;

/// The height of lobes and flat sides, as a share of the reach of both surfaces, up to which they
/// don't show. Turns of a yarn with less relief than this need no finer steps. With half the value,
/// and with twice, no test is red.
const RELIEF: f64 = 1e-3;

/// The most sections of an interval that are tried.
const SECTIONS_MAX: usize = 4096;

/// A descent starts at a place if the growth there exceeds the least growth so far by no more than
/// this share. A lobe may rise by as much between two places that are tried. With twice the value,
/// `the_clearance_is_that_of_surfaces` is red; with half, no test is.
const SLACK: f64 = 0.015;

/// Once this many starts and ends of descents are known, [`SLACK`] no longer counts. From then on a
/// descent starts only at a place whose growth is less than the least so far. With half the value,
/// and with twice, no test is red.
const PLACES: usize = 16;

/// The growth below which no lesser growth is looked for. The surfaces then pierce one another
/// deeply. With half the value, and with twice, no test is red.
const DEEP: f64 = 0.25;

/// A point inside a bent yarn may lie up to this many times as far from the yarn's tangent as the
/// surface does. With half the value, `plied_threads_in_their_own_room_stay_clear` is red; with
/// twice, no test is.
const BENT: f64 = 1.3;

/// The largest error, in intervals, of the tangent's estimate of the place level with a point. With
/// half the value, and with twice, no test is red.
const SLANT: f64 = 0.2;

/// The cosine of the angle up to which an interval may turn and still have a single place level
/// with a point near it. With half the value, and with twice, no test is red.
const STRAIGHT: f64 = 0.7;

/// The distance up to which two places of the thicker yarn count as one, in intervals. With half
/// the value, and with twice, no test is red.
const SAME: f64 = 1e-3;

/// The length of a descent's last steps, as a share of its first steps. With half the value, and
/// with twice, no test is red.
const FINEST: f64 = 1.0 / 32.0;

/// The largest error of the ratio of tubes whose steps have not converged. With half the value, and
/// with twice, no test is red.
const OFF: f64 = 0.1;

/// The largest error of the ratio of tubes whose steps have converged. With half the value, and
/// with twice, no test is red.
const OFF_ENDED: f64 = 0.01;

/// The accuracy of a growth. With half the value, and with twice, no test is red.
const EXACT: f64 = 2e-5;

/// A touch of two surfaces: the parameters of both, and the growth.
type Touch = (DVec2, f64);

/// The least growth at which the surfaces touch, and the place. `starts` are parameters of
/// approaches of the centrelines. `counts` says whether a touch at two parameters counts. None if
/// the place belongs to another interval, or if the growth exceeds [`CLEARANCE_NEAR`].
pub(super) fn touch(
    surfaces: [&Surface<'_>; 2],
    starts: &[DVec2],
    counts: impl Fn(DVec2) -> bool,
) -> Option<Touch> {
    match exchanged(surfaces) {
        false => own(surfaces, Search { surfaces, counts }.least(starts)?),
        true => {
            let [one, other] = surfaces;
            let starts: Vec<DVec2> = starts.iter().map(|start| start.yx()).collect();
            let search = Search { surfaces: [other, one], counts: |place: DVec2| counts(place.yx()) };
            let (place, growth) = search.least(&starts)?;
            own(surfaces, (place.yx(), growth))
        }
    }
}

/// The least growth at which two surfaces that neither turn nor have lobes touch, close to the
/// place where their tubes touch. None if the tubes show that the growth exceeds `most`, or if the
/// place belongs to another interval.
pub(super) fn touch_near(surfaces: [&Surface<'_>; 2], most: f64, tubes: Nearest) -> Option<Touch> {
    if tubes.ratio > most + if tubes.ended { OFF_ENDED } else { OFF } {
        return None;
    }
    if let Some(found) = near(surfaces, &tubes) {
        return within(surfaces, &tubes, found);
    }
    if tubes.ended {
        // The point in which the tubes touch is clear of the true surface, so the tubes' own ratio
        // is returned.
        return own(surfaces, (tubes.place, tubes.ratio));
    }
    let [one, other] = surfaces;
    let beside = tubes::nearest_beside(one.side, other.side, tubes.place)?;
    within(surfaces, &beside, near(surfaces, &beside).unwrap_or((beside.place, beside.ratio)))
}

/// The result of a descent from the place where tubes touch, if that place belongs to these
/// intervals. The descent itself may lead into a neighbouring interval, whose own tubes may touch
/// elsewhere or nowhere.
fn within(surfaces: [&Surface<'_>; 2], tubes: &Nearest, (place, growth): Touch) -> Option<Touch> {
    own(surfaces, (tubes.place, growth))?;
    Some((place.clamp(DVec2::ZERO, DVec2::ONE), growth))
}

/// The place where the surfaces touch, by a descent from the place where their tubes touch. None if
/// the point in which the tubes touch is clear of the true surface.
fn near(surfaces: [&Surface<'_>; 2], tubes: &Nearest) -> Option<Touch> {
    let Nearest { place, ratio, normal, .. } = *tubes;
    let [one, other] = surfaces;
    if exchanged(surfaces) {
        let found = Search { surfaces: [other, one], counts: |_| true }.near(place.yx(), ratio, -normal);
        found.map(|(place, growth)| (place.yx(), growth))
    } else {
        Search { surfaces, counts: |_| true }.near(place, ratio, normal)
    }
}

/// Whether the second surface is the thinner one. Points of the thinner surface are tried, because
/// points on the thicker one would lie too far apart.
fn exchanged([one, other]: [&Surface<'_>; 2]) -> bool {
    other.side.cubic.half_bound() < one.side.cubic.half_bound()
}

/// A touch, if it belongs to these intervals.
fn own([one, other]: [&Surface<'_>; 2], (place, growth): Touch) -> Option<Touch> {
    Some((DVec2::new(one.side.own(place.x)?, other.side.own(place.y)?), growth))
}

/// The search for a touch of two surfaces. The first is the thinner one, whose points are tried.
struct Search<'a, F> {
    surfaces: [&'a Surface<'a>; 2],
    counts: F,
}

/// A point of the thinner surface that touches the other one: its parameter `t` along the yarn, its
/// share `round` of the way round the outline, the `other` surface's parameter, and the growth.
#[derive(Debug, Clone, Copy)]
struct Found {
    t: f64,
    round: f64,
    other: f64,
    growth: f64,
}

/// The descents so far: where they started and ended, and the best end.
#[derive(Debug, Default)]
struct Tried {
    best: Option<Found>,
    /// Starts and ends of descents, as parameters along the thinner yarn and shares of the way
    /// round its outline.
    places: Vec<DVec2>,
}

impl Tried {
    fn add(&mut self, from: Option<DVec2>, lowest: Found) {
        self.places.extend(from.into_iter().chain([DVec2::new(lowest.t, lowest.round)]));
        if self.best.is_none_or(|best| lowest.growth < best.growth) {
            self.best = Some(lowest);
        }
    }

    /// The least growth so far or, if no touch is known yet, the greatest growth that is looked
    /// for.
    fn level(&self) -> f64 {
        self.best.map_or(CLEARANCE_NEAR, |found| found.growth)
    }

    /// How much the growth at a place may exceed the least growth so far for a descent to start
    /// there.
    fn slack(&self) -> f64 {
        if self.places.len() < PLACES { SLACK * self.level() } else { 0.0 }
    }

    fn is_near(&self, at: DVec2, steps: DVec2) -> bool {
        self.places.iter().any(|place| {
            let round = (at.y - place.y).rem_euclid(1.0);
            (at.x - place.x).abs() <= steps.x && round.min(1.0 - round) <= steps.y
        })
    }
}

impl Found {
    fn touch(self) -> Touch {
        (DVec2::new(self.t, self.other), self.growth)
    }
}

impl<F: Fn(DVec2) -> bool> Search<'_, F> {
    /// The end of a descent from the point of a section that reaches furthest along `normal`.
    fn near(&self, start: DVec2, growth: f64, normal: DVec3) -> Option<Touch> {
        let thin = self.surfaces[0];
        let round = if thin.side.support.is_circle() {
            thin.stand(start.x)?.seen(normal).to_angle() / TAU
        } else {
            self.facing(start.x, normal, &shares(POINTS))?
        };
        let found = self.solve(start.x, round, growth + OFF, start.y)?;
        let steps = DVec2::new(1.0 / self.sections() as f64, 1.0 / POINTS as f64);
        Some(self.downhill(found, steps / 2.0).touch())
    }

    fn least(&self, starts: &[DVec2]) -> Option<Touch> {
        let [thin, thick] = self.surfaces;
        let (low, high) = (thin.side.held(f64::NEG_INFINITY), thin.side.held(f64::INFINITY));
        let mut rounds = shares(POINTS_LOBED);
        // Corners may be narrower than the steps between the equally spaced places.
        rounds.extend(shares(thin.side.support.corners()));
        let sections = self.sections();
        let steps = DVec2::new((high - low) / sections as f64, 1.0 / POINTS_LOBED as f64);
        let outline: Vec<(f64, DVec2)> =
            rounds.iter().map(|&round| (round, thin.side.support.point(round))).collect();
        // The approaches come first. They give a small growth early, which rejects most other
        // points.
        let first = |start: &DVec2| {
            let towards = thick.side.cubic.position(start.y) - thin.side.cubic.position(start.x);
            let round = self.facing(start.x, towards, &rounds)?;
            let found = self.solve(start.x, round, CLEARANCE_NEAR, start.y)?;
            Some(if found.growth < DEEP { found } else { self.downhill(found, steps) })
        };
        let mut tried = Tried::default();
        starts.iter().filter_map(first).for_each(|found| tried.add(None, found));
        // An interval that bends back has several places level with a point.
        let [leaving, _, arriving] = thick.side.cubic.velocities();
        let bent = leaving.dot(arriving) < STRAIGHT * leaving.length() * arriving.length();
        let mut besides: Vec<f64> = if bent { vec![0.1, 0.5, 0.9] } else { vec![] };
        besides.extend(starts.first().map(|start| start.y));
        for t in (0..=sections).map(|k| low + k as f64 * steps.x) {
            if tried.level() < DEEP {
                break;
            }
            let Some(stand) = thin.stand(t) else { continue };
            for k in 0..besides.len() {
                besides[k] = thick.level_with(stand.centre, besides[k].clamp(0.0, 1.0));
                if !besides[..k].iter().any(|other| (other - besides[k]).abs() < SAME) {
                    self.section(&stand, [t, besides[k]], steps, &outline, &mut tried);
                }
            }
        }
        tried.best.filter(|best| best.growth <= CLEARANCE_NEAR).map(Found::touch)
    }

    /// Tries the points of the section at `t`, near place `beside` of the other yarn.
    fn section(
        &self,
        stand: &Stand,
        [t, beside]: [f64; 2],
        steps: DVec2,
        outline: &[(f64, DVec2)],
        tried: &mut Tried,
    ) {
        let [thin, thick] = self.surfaces;
        let Some(other) = thick.stand(beside) else { return };
        let towards = other.centre - stand.centre;
        let level = tried.level() + tried.slack();
        // If the two surfaces are out of reach at this growth, none of the points can touch.
        let (direction, apart) = (towards.normalize_or_zero(), towards.length());
        if apart > BENT * level * (thin.reach(stand, direction) + thick.reach(&other, direction)) {
            return;
        }
        let thickest = thick.side.cubic.half_bound() * thick.side.support.extent();
        let speed = thick.side.cubic.path(beside)[1].length();
        let [low, high] = [f64::NEG_INFINITY, f64::INFINITY].map(|end| thick.side.held(end));
        let seen = stand.seen(towards);
        for &(round, point) in outline.iter().filter(|(_, point)| point.dot(seen) >= 0.0) {
            let level = tried.level() + tried.slack();
            let apart = level * stand.way(point) - towards;
            let along = apart.dot(other.tangent);
            if (apart - along * other.tangent).length_squared() > (BENT * level * thickest).powi(2) {
                continue;
            }
            // Points beyond the interval by more than `SLANT` belong to neighbouring intervals of
            // the thicker yarn.
            let level_with = beside + along / speed;
            let at = DVec2::new(t, round);
            if level_with < low - SLANT || level_with > high + SLANT || tried.is_near(at, 2.0 * steps) {
                continue;
            }
            if let Some(found) = self.solve_at(stand, at, level, beside) {
                tried.add(Some(at), self.downhill(found, steps));
                if tried.level() < DEEP {
                    return;
                }
            }
        }
    }

    /// The place of the outline, out of `rounds`, that reaches furthest in a direction from the
    /// section at `t`.
    fn facing(&self, t: f64, direction: DVec3, rounds: &[f64]) -> Option<f64> {
        let seen = self.surfaces[0].stand(t)?.seen(direction);
        let reach = |round: &f64| self.surfaces[0].side.support.point(*round).dot(seen);
        rounds.iter().copied().max_by(|a, b| reach(a).total_cmp(&reach(b)))
    }

    /// Number of steps between the sections of the thinner interval that are tried.
    fn sections(&self) -> usize {
        let [thin, thick] = self.surfaces.map(|surface| &surface.side);
        let least = |side: &Side<'_>| side.cubic.floors().into_iter().fold(f64::INFINITY, f64::min);
        let reach = |side: &Side<'_>| side.cubic.half_bound() * side.support.extent();
        let both = reach(thin) + reach(thick);
        let turning = self.surfaces.map(|surface| {
            let Surface { side, rolls } = surface;
            let relief = side.cubic.half_bound() * (side.support.extent() - side.support.inner());
            if relief > RELIEF * both { rolls.whole() / side.cubic.length() } else { 0.0 }
        });
        let finest = turning[0].max(turning[1]).max(f64::MIN_POSITIVE);
        let step = (STEP * (least(thin) + least(thick))).min(STEP_TURNS / finest);
        let count = thin.cubic.length() / step;
        if count.is_finite() { (count.ceil() as usize).clamp(4, SECTIONS_MAX) } else { SECTIONS_MAX }
    }

    /// How much more than `growth` both sections must grow for the other surface to meet this point
    /// of the section, and the parameter of that place. None if the point is out of the other
    /// surface's reach at `growth`, if the place belongs to another interval, or if the other yarn
    /// has no direction there.
    fn excess(&self, stand: &Stand, way: DVec3, growth: f64, beside: f64) -> Option<(f64, f64)> {
        let (needed, other) = self.surfaces[1].growth_at(stand.centre + growth * way, beside, growth)?;
        Some((needed - growth, other))
    }

    /// The touch of both surfaces on the ray through the outline's point `round` of the section at
    /// `t`, near place `beside` of the other yarn. None if the growth would exceed `level`.
    fn solve(&self, t: f64, round: f64, level: f64, beside: f64) -> Option<Found> {
        self.solve_at(&self.surfaces[0].stand(t)?, DVec2::new(t, round), level, beside)
    }

    fn solve_at(&self, stand: &Stand, at: DVec2, level: f64, beside: f64) -> Option<Found> {
        let [t, round] = at.to_array();
        let way = stand.way(self.surfaces[0].side.support.point(round));
        let mut high = level;
        let (mut over, mut other) =
            self.excess(stand, way, high, beside).filter(|(excess, _)| *excess <= 0.0)?;
        let (mut low, mut under) = (0.0, f64::INFINITY);
        while high - low > EXACT && over < 0.0 {
            // The next growth is that of the secant, or the middle if there is no finite secant.
            let secant = low + (high - low) * under / (under - over);
            let middle = f64::midpoint(low, high);
            let inner = (high - low) * 0.02;
            let next = if secant.is_finite() { secant.clamp(low + inner, high - inner) } else { middle };
            match self.excess(stand, way, next, other) {
                Some((excess, place)) if excess <= 0.0 => (high, over, other) = (next, excess, place),
                Some((excess, _)) => (low, under) = (next, excess),
                None => (low, under) = (next, f64::INFINITY),
            }
        }
        (self.counts)(DVec2::new(t, other)).then_some(Found { t, round, other, growth: high })
    }

    /// The descent from `found` to the least growth close by, with steps that get shorter.
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
                let t = self.surfaces[0].side.held(found.t + along * steps.x);
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

/// Places round an outline, as shares of the way, equally far apart.
fn shares(count: usize) -> Vec<f64> {
    (0..count).map(|place| place as f64 / count as f64).collect()
}
