//! The search: which intervals meet in a cell, and where two of them come nearest to one another.

use std::cell::{Cell, OnceCell};
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use glam::{DVec2, Vec3A};
use texere_core::backend::room_for;
use texere_core::definitions::{Sampling, tangent_factor};
use texere_core::{YarnPlace, Yarns};

use super::approach::{Side, refine};
use super::contact::{CLEARANCE_ACCURACY, CLEARANCE_BESIDE, Contact};
use super::crowd::Crowd;
use super::curvature;
use super::extent::Extent;
use super::found::Found;
use super::interval::{Chords, Cubic, SAGITTA, closest};
use super::line::{self, Line, Span};
use super::nearer::nearer;
use super::part::Part;
use super::passing::Passing;
use super::rolls::{IntervalRolls, Rolls};
use super::support::Support;
use super::surface::Surface;
use super::touch::{touch, touch_near};
use super::tubes;
use crate::ContactError;
use crate::grid::{Bounds, Grid};
use crate::watch::Watch;

/// The most intervals of a cell that are simply compared with one another. Threads that are clear
/// of one another come to some 60, with one control point a crossing or several.
pub(super) const FULL: usize = 256;

/// Pairs between two reports of progress.
const REPORT_EVERY: u64 = 1 << 14;

/// How many times as far as its interval is long a section reaches that counts by its hull alone,
/// untwisted.
const DISC: f64 = 64.0;

/// What is worked out of an interval once it is asked for.
#[derive(Default)]
struct Met {
    curve: OnceCell<Curve>,
    chords: OnceCell<Chords>,
    extent: OnceCell<Extent>,
}

impl Met {
    fn curve(&self, part: &Part<'_>, rolls: &Rolls) -> &Curve {
        self.curve.get_or_init(|| Curve::new(part, rolls))
    }

    fn chords(&self, curve: &Curve) -> &Chords {
        self.chords.get_or_init(|| curve.cubic.chords())
    }

    fn extent(&self, curve: &Curve, support: &Support) -> &Extent {
        self.extent.get_or_init(|| Extent::new(&curve.cubic, support))
    }
}

/// An interval that meets another.
struct Curve {
    cubic: Cubic,
    passing: Passing,
    /// How far its surface may lie from the centreline, mm.
    reach: f64,
    /// Whether sections are circles, so that the distance of the centrelines counts.
    round: bool,
    /// Whether they are all alike, too.
    even: bool,
    /// As [`Rolls::of_interval`] has them.
    rolls: IntervalRolls,
}

impl Curve {
    fn new(part: &Part<'_>, rolls: &Rolls) -> Self {
        let (cubic, support) = (part.line.cubic(part.point), part.line.support);
        let reach = cubic.half_bound() * support.extent();
        let round = support.is_circle() && cubic.is_round();
        let (point, line) = (part.point, &part.line);
        let rolls = rolls.of_interval(line.yarn, point, line.window(point), line.window_after(point));
        Self { passing: Passing::new(&cubic), reach, round, even: round && cubic.is_even(), rolls, cubic }
    }
}

/// Pairs that are looked at in a cell of so many intervals, at most.
pub(super) const fn cell_work(intervals: usize) -> u64 {
    let half = if intervals < 2 * CLEARANCE_BESIDE { intervals } else { 2 * CLEARANCE_BESIDE };
    intervals as u64 * half as u64 / 2
}

/// The yarns, and how far their sections reach.
pub(super) struct Probe<'a> {
    yarns: &'a Yarns,
    supports: Vec<Support>,
    ways: Vec<f64>,
    /// Contacts beyond this are not looked for: [`CLEARANCE_NEAR`](super::CLEARANCE_NEAR) at most.
    near: f64,
    /// The factor of the spline's tangents.
    s: f64,
}

impl<'a> Probe<'a> {
    pub(super) fn new(yarns: &'a Yarns, sampling: Sampling, near: f64) -> Self {
        let supports = yarns.layout().sections().iter().map(Support::new).collect();
        Self {
            yarns,
            supports,
            ways: line::ways(yarns.points()),
            near,
            s: tangent_factor(sampling.tension()),
        }
    }

    fn line(&self, yarn: usize) -> Line<'_> {
        let section = self.yarns.layout().yarns()[yarn].section;
        Line::new(self.yarns, yarn, &self.supports[section as usize], self.s, &self.ways)
    }

    /// The yarn that control point `point` belongs to.
    fn line_of(&self, point: usize) -> Line<'_> {
        let offsets = self.yarns.layout().offsets();
        self.line(offsets.partition_point(|&start| start <= point as u64).saturating_sub(1))
    }

    /// All intervals in order, `most` at a time at most.
    pub(super) fn spans(&self, most: usize) -> Vec<Span<'_>> {
        (0..self.yarns.layout().yarns().len()).flat_map(|yarn| self.line(yarn).spans(most)).collect()
    }

    /// All contacts of intervals that meet in `cells`, one of them at least `fresh`.
    ///
    /// **Errors**: [`ContactError::OutOfMemory`]; [`ContactError::Cancelled`] where `watch` says
    /// so.
    pub(super) fn search(
        &self,
        grid: &Grid,
        rolls: &Rolls,
        cells: Range<usize>,
        fresh: &dyn Fn(usize) -> bool,
        mut found: Found,
        watch: &Watch<'_>,
    ) -> Result<Found, ContactError> {
        let mut points = Vec::new();
        let mut parts: Vec<Part<'_>> = Vec::new();
        let mut met: Vec<Met> = Vec::new();
        let mut unreported = 0;
        for cell in cells {
            points.clear();
            room_for(&mut points, grid.count_in(cell), "a cell's intervals")?;
            points.extend(grid.entries(cell));
            points.sort_unstable();
            parts.clear();
            room_for(&mut parts, points.len(), "a cell's intervals")?;
            for &point in &points {
                let line = match parts.last() {
                    Some(before) if before.line.holds(point) => before.line,
                    _ => self.line_of(point),
                };
                let bounds = line.bounds(point, self.near);
                parts.push(Part { point, line, bounds, cell: grid.cell(bounds.low) });
            }
            // Two may meet in several cells: where what they share begins they count.
            let counts = |one: &Part<'_>, other: &Part<'_>| {
                (fresh(one.point) || fresh(other.point))
                    && one.bounds.meets(&other.bounds)
                    && grid.number(one.cell.max(other.cell)) == cell
            };
            if parts.len() > FULL {
                self.sweep(&mut parts, rolls, counts, &mut found, watch)?;
                continue;
            }
            unreported += cell_work(parts.len());
            if unreported >= REPORT_EVERY {
                watch.advance(std::mem::take(&mut unreported))?;
            }
            met.clear();
            met.resize_with(parts.len(), Met::default);
            found.pairs += (parts.len() * parts.len().saturating_sub(1) / 2) as u64;
            for (second, other) in parts.iter().enumerate() {
                for (first, one) in parts[..second].iter().enumerate() {
                    if counts(one, other) {
                        self.pair([(one, &met[first]), (other, &met[second])], rolls, &mut found, watch)?;
                    }
                }
            }
        }
        watch.advance(unreported)?;
        Ok(found)
    }

    /// All contacts of many intervals, or that they are a crowd.
    ///
    /// A plane is moved over them, and each is compared with those that the plane meets when it
    /// comes to it.
    fn sweep(
        &self,
        parts: &mut [Part<'_>],
        rolls: &Rolls,
        counts: impl Fn(&Part<'_>, &Part<'_>) -> bool,
        found: &mut Found,
        watch: &Watch<'_>,
    ) -> Result<(), ContactError> {
        let crowd = Crowd::of(parts, |part| part.line.place(part.point, 0.0, self.yarns.sources()));
        if crowd.is_some_and(|crowd| crowd.fill > 1.0) {
            found.add_crowd(crowd);
            return Ok(());
        }
        // Along the axis on which boxes are shortest beside all of them.
        let (whole, sides) = parts.iter().fold((Bounds::NOTHING, Vec3A::ZERO), |(whole, sides), part| {
            (whole.joined(part.bounds), sides + (part.bounds.high - part.bounds.low))
        });
        let axis = (sides / (whole.high - whole.low)).min_position();
        parts.sort_by(|one, other| one.bounds.low[axis].total_cmp(&other.bounds.low[axis]));
        let mut beside: Vec<(&Part<'_>, Box<Met>)> = Vec::new();
        let (each, mut unreported) = (cell_work(parts.len()) / parts.len() as u64, 0);
        for part in &*parts {
            beside.retain(|(other, _)| other.bounds.high[axis] >= part.bounds.low[axis]);
            if beside.len() > CLEARANCE_BESIDE {
                found.add_crowd(crowd);
                break;
            }
            unreported += each;
            if unreported >= REPORT_EVERY {
                watch.advance(std::mem::take(&mut unreported))?;
            }
            found.pairs += beside.len() as u64;
            let met = Box::new(Met::default());
            for (other, other_met) in &beside {
                if counts(part, other) {
                    let mut pair = [(part, &*met), (*other, &**other_met)];
                    pair.sort_by_key(|(part, _)| part.point);
                    self.pair(pair, rolls, found, watch)?;
                }
            }
            beside.push((part, met));
        }
        watch.advance(unreported)
    }

    /// The contacts of two intervals, the first one's number being the lower.
    ///
    /// **Errors**: [`ContactError::Cancelled`] where `watch` says so.
    fn pair(
        &self,
        [(one, first), (other, second)]: [(&Part<'_>, &Met); 2],
        rolls: &Rolls,
        found: &mut Found,
        watch: &Watch<'_>,
    ) -> Result<(), ContactError> {
        let (a, b) = (first.curve(one, rolls), second.curve(other, rolls));
        let reach = a.reach + b.reach;
        let within = self.near * reach;
        let cuts = [one, other].map(|part| part.line.cut(part.point));
        let same = one.line.yarn == other.line.yarn;
        let passes_by = if a.even && b.even {
            a.passing.leaves_to_neighbours(&b.passing, cuts[0], reach)
                || b.passing.leaves_to_neighbours(&a.passing, cuts[1], reach)
        } else {
            same && one.line.leads_on(one.point, other.point)
        };
        if passes_by {
            return Ok(());
        }
        let straight = [a, b].map(|curve| [curve.cubic.position(0.0), curve.cubic.position(1.0)]);
        let bends = a.cubic.bend() + b.cubic.bend();
        if closest(straight[0], straight[1]).0 > (within + bends).powi(2) {
            return Ok(());
        }
        let sides = [
            Side { cubic: &a.cubic, support: one.line.support, cut: cuts[0] },
            Side { cubic: &b.cubic, support: other.line.support, cut: cuts[1] },
        ];
        // Two places so close along a yarn can only meet in a fold.
        let apart = |place: DVec2| {
            let reach =
                [(a, place.x), (b, place.y)].map(|(curve, t)| curve.cubic.at(t).sizes().max_element());
            let window = FRAC_PI_2 * (reach[0] + reach[1]) * one.line.support.extent();
            !same || !one.line.within(window, (one.point, place.x), (other.point, place.y))
        };
        let add = |place: DVec2, ratio: f64, found: &mut Found| {
            let sources = self.yarns.sources();
            found.add(ratio, || Contact {
                places: [
                    one.line.place(one.point, place.x, sources),
                    other.line.place(other.point, place.y, sources),
                ],
                ratio,
            });
        };
        // Chords may be further from one another than the curves are.
        let (chords, within) = ([first.chords(a), second.chords(b)], within + SAGITTA * reach);
        let surfaces =
            [Surface { side: sides[0], rolls: &a.rolls }, Surface { side: sides[1], rolls: &b.rolls }];
        let surfaces = surfaces.each_ref();
        // Of yarns so much thicker than their control points lie apart each interval is a disc: its
        // tube is all there is to it.
        let discs = [a, b].into_iter().any(|curve| DISC * curve.cubic.length() < curve.reach);
        if !discs && surfaces.iter().any(|surface| !surface.is_simple()) {
            // Surfaces that have lobes or turn may come near in many places, whatever the
            // centrelines do.
            let mut all = Vec::new();
            chords[0].approaches(chords[1], within, false, |starts| all.push(starts[0]));
            let touching = if all.is_empty() { None } else { touch(surfaces, &all, apart) };
            if let Some((place, ratio)) = touching {
                add(place, ratio, found);
            }
            // Each takes as long as thousands of other pairs.
            return watch.advance(0);
        }
        let round = a.round && b.round;
        if !round && !discs {
            let extents = [first.extent(a, one.line.support), second.extent(b, other.line.support)];
            if extents[0].is_clear_of(extents[1], self.near) {
                return Ok(());
            }
        }
        let mut seen: Vec<DVec2> = Vec::new();
        let least = Cell::new(f64::INFINITY);
        let valley = Cell::new(false);
        let refined = |start: DVec2| {
            let approach = refine(sides[0], sides[1], start);
            least.set(approach.ratio.min(least.get()));
            valley.set(valley.get() || approach.valley);
            approach.own.map(|place| (place, approach.ratio))
        };
        let mut keep = |(place, ratio): (DVec2, f64)| {
            let again = seen.iter().any(|other| (*other - place).abs().max_element() < 0.01);
            if ratio <= self.near && !again && apart(place) {
                seen.push(place);
                add(place, ratio, found);
            }
        };
        // Of a yarn with itself, what lies beside the knot that two intervals share hides an
        // approach further along.
        chords[0].approaches(chords[1], within, same && round, |starts| {
            // The first may lead out of the interval to an approach beside this one's own.
            let reached = starts.into_iter().find_map(|start| match round {
                true => refined(start),
                false if discs => {
                    let near = tubes::nearest(sides[0], sides[1], start)?;
                    Some((DVec2::new(sides[0].own(near.place.x)?, sides[1].own(near.place.y)?), near.ratio))
                }
                false => touch_near(surfaces, self.near, tubes::nearest(sides[0], sides[1], start)?),
            });
            if let Some(approach) = reached {
                keep(approach);
            }
        });
        // Approaches that lie in one valley may be one to the chords.
        while !discs && valley.get() {
            let known = least.get();
            let nearer = nearer(&a.cubic, &b.cubic, known.min(self.near) - CLEARANCE_ACCURACY);
            let Some(start) = nearer else { break };
            refined(start).into_iter().for_each(&mut keep);
            if least.get() >= known {
                break;
            }
        }
        Ok(())
    }

    /// The tightest bend of the intervals of `span`.
    pub(super) fn tightest(&self, span: &Span<'_>, rolls: &Rolls) -> (f64, Option<YarnPlace>) {
        let line = &span.line;
        let turning = rolls.matter(line.yarn);
        let mut best = (f64::INFINITY, None);
        for point in span.points.clone() {
            if let Some((ratio, t)) = curvature::tightest(&line.cubic(point), line.support, turning, best.0) {
                best = (ratio, Some(line.place(point, t, self.yarns.sources())));
            }
        }
        best
    }

    /// The tightest bend of each interval of `span` for which `fresh` holds, where it is tighter
    /// than `ratio`.
    pub(super) fn bends(
        &self,
        span: &Span<'a>,
        rolls: &Rolls,
        ratio: f64,
        fresh: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = (f64, YarnPlace)> {
        let line = span.line;
        let turning = rolls.matter(line.yarn);
        span.points.clone().filter(move |point| fresh(*point)).filter_map(move |point| {
            let (bend, t) = curvature::tightest(&line.cubic(point), line.support, turning, ratio)?;
            Some((bend, line.place(point, t, self.yarns.sources())))
        })
    }
}
