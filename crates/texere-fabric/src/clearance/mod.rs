//! Clearance: how near yarns come to one another and to themselves, and how tightly they bend.

mod approach;
mod crowd;
mod curvature;
mod found;
mod grid;
mod interval;
mod line;
mod passing;
mod search;
mod support;
mod watch;

use std::ops::ControlFlow;

use rayon::prelude::*;
use texere_core::Yarns;

pub use self::crowd::Crowd;
pub(crate) use self::line::neighbours;

use self::found::Found;
use self::grid::Grid;
use self::search::{FULL, Probe, cell_work};
use self::watch::Watch;
use crate::FabricError;

/// Contacts further apart than this factor are not looked for.
pub const CLEARANCE_NEAR: f64 = 1.1;

/// How exact a ratio is where both yarns are round: yarns at 0.999 of touching count as touching.
///
/// Of flat yarns it is 0.01: their sections' frames and tangents count, but not how these change along a section's
/// reach. Of two approaches side by side on one pair of sharply bent intervals the nearer may stay unseen: once in some
/// 30,000 tangles of random yarns that was 0.003.
pub const CLEARANCE_ACCURACY: f64 = 1e-3;

/// The most contacts that are listed one by one.
pub const CONTACTS_LISTED: usize = 100;

/// The most control intervals that one is compared with in a cell of the search, beside each other on one plane through it.
///
/// Yarns that are clear of one another come that close where a radius has some 250 control points, or where a thousand
/// straight yarns of two points lie side by side.
pub const CLEARANCE_BESIDE: usize = 1024;

/// The most pairs of control intervals that are looked at for each control point: an interval lies in 6 cells on average
/// at most, and is compared with [`CLEARANCE_BESIDE`] in each. Of cloth it is 20 to 60.
pub const CLEARANCE_PAIRS: u64 = grid::ENTRIES * CLEARANCE_BESIDE as u64;

const _: () = assert!(FULL / 2 <= CLEARANCE_BESIDE);

/// Width of a bin of the histogram.
pub const CLEARANCE_BIN: f64 = 0.01;

/// The most control points whose clearance is measured.
const POINTS_LIMIT: usize = 1 << 29;

/// Cells, and intervals, that one task takes.
const TASK: usize = 1024;

/// One place of a yarn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YarnPlace {
    /// The yarn, from 0.
    pub yarn: usize,
    /// The control interval: the number of the control point that it starts from, from 0 within the yarn.
    pub interval: usize,
    /// Where in the interval, from 0 to 1.
    pub t: f64,
    /// The centreline there, mm.
    pub position: [f64; 3],
    /// The source of the nearer of the interval's control points, if the yarns have sources.
    pub source: Option<u32>,
}

/// Where two yarns, or two parts of one, are nearer to one another than anywhere close by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The two places, the lower yarn first.
    pub places: [YarnPlace; 2],
    /// The factor by which both sections could grow until they touch: 1 where they just do, less where they pierce. Of
    /// round yarns it is the distance of the centrelines over the sum of the radii.
    pub ratio: f64,
}

/// How near yarns come to one another and to themselves.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    /// The least ratio of all contacts (see [`Contact::ratio`]); infinite where nothing comes within [`CLEARANCE_NEAR`].
    /// Where there is a [`Clearance::crowd`] it is no more than its yarns have room for, which may be less than that of any
    /// contact.
    pub min: f64,
    /// All contacts within [`CLEARANCE_NEAR`]. Where two yarns run side by side each pair of control intervals may be one.
    pub contacts: u64,
    /// Contacts that pierce: nearer than 1 by more than [`CLEARANCE_ACCURACY`].
    pub below_one: u64,
    /// The worst contacts, [`CONTACTS_LISTED`] at most, worst first.
    pub worst: Vec<Contact>,
    /// How many contacts have a ratio in \[0, 0.01), \[0.01, 0.02) and so on to [`CLEARANCE_NEAR`] (steps of [`CLEARANCE_BIN`]).
    pub histogram: Vec<u64>,
    /// The least radius of curvature over how far the section reaches into the bend (its radius, of round yarns).
    /// Below 1 the tube folds into itself. Infinite where all yarns are straight. It is exact to a thousandth.
    pub curvature_min: f64,
    /// Where that is.
    pub curvature_at: Option<YarnPlace>,
    /// The worst of the places that are too crowded to be measured: contacts there are missing above.
    pub crowd: Option<Crowd>,
    /// Pairs of control intervals that were looked at, the work that it took: [`CLEARANCE_PAIRS`] a control point at most.
    pub pairs: u64,
}

/// Measures how near yarns come to one another, to themselves, and how tightly they bend.
///
/// Of each pair of yarn parts within [`CLEARANCE_NEAR`] the nearest approach is found on the spline itself, whose tension is
/// `tension`; sections stand upright, as untwisted ones do, and count with their hulls. Two places of one yarn count
/// from an arc length of π/2 times the sum of their radii on: nearer ones can only meet in a bend tighter than the yarn
/// is thick (Schur's theorem: no curve with that curvature brings its ends closer than the circle does), which the
/// curvature tells. A loop within one control interval is told by the curvature alone.
///
/// Where much more yarn lies than there is room for, no pairs are measured: yarns that are several times as thick as they
/// lie apart are told by [`Clearance::crowd`] at once. So time grows with the control points alone (flat sections take about five times as long as round ones); beside the yarns
/// it takes about 9 bytes a control point.
///
/// **Errors**: [`FabricError::ClearancePoints`] for more control points than are measured, [`FabricError::Tension`] for
/// a tension outside \[0, 1), [`FabricError::OutOfMemory`].
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// // Two straight yarns of radius 0.1, crossing 0.15 apart: they pierce.
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|y| ControlPoint::new(0.5, y, 0.15, 0.1)));
/// let clearance = texere_fabric::clearance(&yarns.build()?, 0.0)?;
/// assert!((clearance.min - 0.75).abs() < 1e-6);
/// assert_eq!((clearance.below_one, clearance.worst[0].places[0].yarn), (1, 0));
/// assert!((clearance.worst[0].places[0].position[0] - 0.5).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn clearance(yarns: &Yarns, tension: f32) -> Result<Clearance, FabricError> {
    clearance_with_progress(yarns, tension, |_| ControlFlow::Continue(()))
}

/// [`clearance`] that tells how far it has come, from 0 to 1, from any thread; `Break` ends it.
///
/// **Errors**: those of [`clearance`]; [`FabricError::Cancelled`] where `progress` asked to stop.
///
/// ```
/// use std::ops::ControlFlow;
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_fabric::{FabricError, clearance_with_progress};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let mut told = 0.0;
/// clearance_with_progress(&yarns, 0.0, |done| {
///     told = done;
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(told, 1.0);
/// let stopped = clearance_with_progress(&yarns, 0.0, |_| ControlFlow::Break(()));
/// assert_eq!(stopped, Err(FabricError::Cancelled));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn clearance_with_progress(
    yarns: &Yarns,
    tension: f32,
    progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Clearance, FabricError> {
    if !(0.0..1.0).contains(&tension) {
        return Err(FabricError::Tension { tension });
    }
    let points = yarns.points().len();
    if points > POINTS_LIMIT {
        return Err(FabricError::ClearancePoints { points: points as u64, limit: POINTS_LIMIT as u64 });
    }
    let probe = Probe::new(yarns, tension);
    let spans = probe.spans(TASK);
    let grid = Grid::new(spans.len(), |span| {
        let line = &spans[span].line;
        spans[span].points.clone().map(|point| (point, line.bounds(point, CLEARANCE_NEAR)))
    })?;
    let work: u64 = (0..grid.len()).map(|cell| cell_work(grid.count_in(cell))).sum();
    let watch = Watch::new(work + points as u64, progress);
    let mut found = (0..grid.len().div_ceil(TASK))
        .into_par_iter()
        .map(|task| probe.search(&grid, task * TASK..grid.len().min((task + 1) * TASK), &watch))
        .try_reduce(Found::default, |one, other| Ok(one.joined(other)))?;
    found.keep_worst();
    let bend = spans
        .par_iter()
        .map(|span| {
            let bend = probe.tightest(span);
            watch.advance(span.points.len() as u64).map(|()| bend)
        })
        .try_reduce(|| (f64::INFINITY, None), |a, b| Ok(if b.0 < a.0 { b } else { a }))?;
    watch.advance(points as u64)?;
    let measured = found.worst.first().map_or(f64::INFINITY, |contact| contact.ratio);
    Ok(Clearance {
        min: found.crowd.map_or(measured, |crowd| measured.min(crowd.ratio_max())),
        contacts: found.histogram.iter().sum(),
        below_one: found.below_one,
        worst: found.worst,
        histogram: found.histogram,
        curvature_min: bend.0,
        curvature_at: bend.1,
        crowd: found.crowd,
        pairs: found.pairs,
    })
}

/// Makes sure that `list` can take `count` more.
fn room_for<T>(list: &mut Vec<T>, count: usize, what: &'static str) -> Result<(), FabricError> {
    let bytes = (count * size_of::<T>()) as u64;
    list.try_reserve(count).map_err(|_| FabricError::OutOfMemory { what, bytes })
}
