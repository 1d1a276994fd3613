//! The search for contacts among the intervals of each cell.

use std::ops::Range;

use glam::Vec3A;
use texere_core::backend::room_for;
use texere_core::definitions::{Sampling, tangent_factor};
use texere_core::{YarnPlace, Yarns};

use super::contact::CLEARANCE_BESIDE;
use super::crowd::Crowd;
use super::curvature;
use super::found::Found;
use super::line::{self, Line, Span};
use super::met::Met;
use super::pair::Pair;
use super::part::Part;
use super::rolls::Rolls;
use super::support::Support;
use crate::ContactError;
use crate::grid::{Bounds, Grid};
use crate::watch::Watch;

/// The most intervals of a cell that are compared in all pairs. If threads are clear of one
/// another, a cell holds some 60 intervals, with one control point a crossing or with several. With
/// twice the value, `one_crowd_does_not_hide_the_rest` is red; with half, no test is.
pub(super) const FULL: usize = 256;

/// Number of pairs between two reports of progress.
const REPORT_EVERY: u64 = 1 << 14;

/// Upper bound of the pairs that are compared in a cell of this many intervals.
pub(super) const fn cell_work(intervals: usize) -> u64 {
    let half = if intervals < 2 * CLEARANCE_BESIDE { intervals } else { 2 * CLEARANCE_BESIDE };
    intervals as u64 * half as u64 / 2
}

/// The yarns, with the reach of their sections.
pub(super) struct Probe<'a> {
    yarns: &'a Yarns,
    supports: Vec<Support>,
    ways: Vec<f64>,
    /// The greatest ratio of a contact that is looked for:
    /// [`CLEARANCE_NEAR`](super::CLEARANCE_NEAR) at most.
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

    /// All intervals in order, in spans of `most` at most.
    pub(super) fn spans(&self, most: usize) -> Vec<Span<'_>> {
        (0..self.yarns.layout().yarns().len()).flat_map(|yarn| self.line(yarn).spans(most)).collect()
    }

    /// Adds to `found` all contacts of two intervals that meet in `cells`, if `fresh` holds for at
    /// least one of them.
    ///
    /// **Errors**: [`ContactError::OutOfMemory`], and [`ContactError::Cancelled`] if the caller of
    /// `watch` asks to stop.
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
            // Two intervals may meet in several cells. They are compared in the first cell that
            // both reach into.
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
                        let pair = Pair::new([(one, &met[first]), (other, &met[second])], rolls, self.near);
                        pair.contacts(self.yarns.sources(), &mut found, watch)?;
                    }
                }
            }
        }
        watch.advance(unreported)?;
        Ok(found)
    }

    /// Adds all contacts of a cell with many intervals, or the crowd that the intervals form.
    ///
    /// A plane sweeps over the intervals. When it reaches an interval, that interval is compared
    /// with all others that the plane meets.
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
        // The sweep goes along the axis on which boxes are shortest relative to the box round all
        // of them.
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
                    Pair::new(pair, rolls, self.near).contacts(self.yarns.sources(), found, watch)?;
                }
            }
            beside.push((part, met));
        }
        watch.advance(unreported)
    }

    /// The ratio and the place of the tightest bend of the intervals of `span`.
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

    /// The ratio and the place of the tightest bend of each interval of `span` for which `fresh`
    /// holds, if that bend is tighter than `ratio`.
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
