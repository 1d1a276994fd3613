//! Clearance: how near yarns come to one another and to themselves, and how tightly they bend.

mod approach;
mod contact;
mod crowd;
mod curvature;
mod extent;
mod found;
mod interval;
mod line;
mod met;
mod nearer;
mod pair;
mod part;
mod passing;
mod rolls;
mod search;
mod support;
mod surface;
mod touch;
mod tubes;

use std::ops::ControlFlow;

use rayon::prelude::*;
use texere_core::definitions::Sampling;
use texere_core::{Settings, YarnPlace, Yarns};

pub use self::contact::{
    CLEAR, CLEARANCE_ACCURACY, CLEARANCE_BESIDE, CLEARANCE_BIN, CLEARANCE_NEAR, CLEARANCE_PAIRS,
    CONTACTS_LISTED, Contact,
};
pub use self::crowd::Crowd;

use self::found::Found;
use self::rolls::Rolls;
use self::search::{FULL, Probe, cell_work};
use crate::ContactError;
use crate::grid::Grid;
use crate::watch::{Report, Watch};

const _: () = assert!(FULL / 2 <= CLEARANCE_BESIDE);

/// The most control points whose clearance is measured.
const POINTS_LIMIT: usize = 1 << 29;

/// Cells, and intervals, that one task takes.
const TASK: usize = 1024;

/// How near yarns come to one another and to themselves.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    /// The least ratio of all contacts (see [`Contact::ratio`]); infinite where nothing comes
    /// within [`CLEARANCE_NEAR`]. Where there is a [`Clearance::crowd`] it is no more than its
    /// yarns have room for, which may be less than that of any contact.
    pub min: f64,
    /// All contacts within [`CLEARANCE_NEAR`]. Where two yarns run side by side each pair of
    /// control intervals may be one.
    pub contacts: u64,
    /// Contacts nearer than 1 by more than [`CLEARANCE_ACCURACY`]. Of threads that touch by
    /// construction many are, since splines between their control points come to 0.99.
    pub below_one: u64,
    /// Contacts that pierce: nearer than [`CLEAR`](crate::CLEAR).
    pub piercing: u64,
    /// The worst contacts, [`CONTACTS_LISTED`] at most, worst first.
    pub worst: Vec<Contact>,
    /// How many contacts have a ratio in \[0, 0.01), \[0.01, 0.02) and so on to [`CLEARANCE_NEAR`]
    /// (steps of [`CLEARANCE_BIN`]).
    pub histogram: Vec<u64>,
    /// The least radius of curvature over how far the section reaches into the bend: its radius, of
    /// round yarns; of those whose section turns, as far as it may reach whichever way it is
    /// turned. Below 1 the tube folds into itself. Infinite where all yarns are straight. It is
    /// exact to a thousandth.
    pub curvature_min: f64,
    /// Where that is.
    pub curvature_at: Option<YarnPlace>,
    /// The worst of the places that are too crowded to be measured: contacts there are missing
    /// above.
    pub crowd: Option<Crowd>,
    /// Pairs of control intervals that were looked at, the work that it took: [`CLEARANCE_PAIRS`] a
    /// control point at most.
    pub pairs: u64,
}

/// Measures how near yarns come to one another, to themselves, and how tightly they bend.
///
/// Surfaces are those that a mesh with `settings` is made of, but for the facets: the spline
/// itself, and on it sections with the roll that they have on its rings, flattened as the yarn is.
/// A ply that lies in another yarn's furrow touches where the surfaces do, not where their hulls
/// would. Of each pair of yarn parts within [`CLEARANCE_NEAR`] the nearest approach is found. Two
/// places of one yarn count from an arc length of π/2 times the sum of their radii on, by the
/// chords between control points: nearer ones can only meet in a bend tighter than the yarn is
/// thick (Schur's theorem: no curve with that curvature brings its ends closer than the circle
/// does), which shows in the curvature. So does a loop within one control interval, which is no
/// contact.
///
/// Where much more yarn lies than there is room for, no pairs are measured: yarns that are several
/// times as thick as they lie apart are reported as [`Clearance::crowd`] at once. So time grows
/// with the control points alone; flat sections take about seven times as long as round ones, those
/// with plies or twist ten to thirty times. Memory is about 9 bytes a control point beside the
/// yarns, and 4 more where a yarn's roll matters.
///
/// **Errors**: [`ContactError::ClearancePoints`] for more control points than are measured,
/// [`ContactError::Settings`] for points between control points that no mesh is made with,
/// [`ContactError::OutOfMemory`].
///
/// ```
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// // Two straight yarns of radius 0.125, crossing 0.1875 apart: they pierce.
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.125)));
/// yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|y| ControlPoint::new(0.5, y, 0.1875, 0.125)));
/// let clearance = texere_contact::clearance(&yarns.build()?, &Settings::default())?;
/// assert!((clearance.min - 0.75).abs() < 1e-6);
/// assert_eq!((clearance.below_one, clearance.worst[0].places[0].yarn), (1, 0));
/// assert!((clearance.worst[0].places[0].position[0] - 0.5).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn clearance(yarns: &Yarns, settings: &Settings) -> Result<Clearance, ContactError> {
    clearance_with_progress(yarns, settings, |_| ControlFlow::Continue(()))
}

/// [`clearance()`] that calls `progress` with the share of the work that is done, from 0 to 1, from
/// any thread. `Break` ends it.
///
/// **Errors**: those of [`clearance`]; [`ContactError::Cancelled`] where `progress` asked to stop.
///
/// ```
/// use std::ops::ControlFlow;
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// use texere_contact::{ContactError, clearance_with_progress};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let mut share = 0.0;
/// clearance_with_progress(&yarns, &Settings::default(), |done| {
///     share = done;
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(share, 1.0);
/// let stopped = clearance_with_progress(&yarns, &Settings::default(), |_| ControlFlow::Break(()));
/// assert_eq!(stopped, Err(ContactError::Cancelled));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn clearance_with_progress(
    yarns: &Yarns,
    settings: &Settings,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Clearance, ContactError> {
    measured(yarns, settings, [CLEARANCE_NEAR, f64::INFINITY], &|_| true, &mut progress)
}

/// [`clearance()`] of those intervals alone for which `fresh` holds, by the number of their first
/// control point, and of others with them: with all contacts up to a `ratio`, worst first, instead
/// of the worst [`CONTACTS_LISTED`], and none beyond `near`.
pub fn clearance_up_to(
    yarns: &Yarns,
    settings: &Settings,
    [near, ratio]: [f64; 2],
    fresh: impl Fn(usize) -> bool + Sync,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Clearance, ContactError> {
    measured(yarns, settings, [near, ratio], &fresh, &mut progress)
}

/// The intervals for which `fresh` holds and that bend more tightly than `ratio`, as
/// [`Clearance::curvature_min`] has it, with where they do most.
///
/// **Errors**: [`ContactError::Settings`], [`ContactError::OutOfMemory`].
pub fn bends_up_to(
    yarns: &Yarns,
    settings: &Settings,
    ratio: f64,
    fresh: impl Fn(usize) -> bool + Sync,
) -> Result<Vec<(f64, YarnPlace)>, ContactError> {
    let sampling = Sampling::new(yarns.layout(), settings.subdivisions)?;
    let mut unheard = |_| ControlFlow::Continue(());
    let watch = Watch::new(0, &mut unheard);
    let rolls = Rolls::new(yarns, sampling, settings.frame, &watch)?;
    let probe = Probe::new(yarns, sampling, CLEARANCE_NEAR);
    let spans = probe.spans(TASK);
    Ok(spans.par_iter().flat_map_iter(|span| probe.bends(span, &rolls, ratio, &fresh)).collect())
}

/// The clearance of `yarns` where `fresh` holds, of contacts within `near`; all up to a ratio are
/// kept, or else the worst.
fn measured(
    yarns: &Yarns,
    settings: &Settings,
    [near, ratio]: [f64; 2],
    fresh: &(dyn Fn(usize) -> bool + Sync),
    progress: &mut Report<'_>,
) -> Result<Clearance, ContactError> {
    let sampling = Sampling::new(yarns.layout(), settings.subdivisions)?;
    let points = yarns.points().len();
    if points > POINTS_LIMIT {
        return Err(ContactError::ClearancePoints { points: points as u64, limit: POINTS_LIMIT as u64 });
    }
    let watch = Watch::new(points as u64, progress);
    let rolls = Rolls::new(yarns, sampling, settings.frame, &watch)?;
    let nothing = || if ratio.is_finite() { Found::up_to(ratio) } else { Found::worst() };
    let probe = Probe::new(yarns, sampling, near);
    let spans = probe.spans(TASK);
    let grid = Grid::new(spans.len(), |span| {
        let line = &spans[span].line;
        spans[span].points.clone().map(|point| (point, line.bounds(point, near)))
    })?;
    watch.expect((0..grid.len()).map(|cell| cell_work(grid.count_in(cell))).sum());
    let mut found = (0..grid.len().div_ceil(TASK))
        .into_par_iter()
        .map(|task| {
            let cells = task * TASK..grid.len().min((task + 1) * TASK);
            probe.search(&grid, &rolls, cells, fresh, nothing(), &watch)
        })
        .try_reduce(&nothing, |one, other| Ok(one.joined(other)))?;
    found.keep_worst();
    let bend = spans
        .par_iter()
        .map(|span| {
            let bend = probe.tightest(span, &rolls);
            watch.advance(span.points.len() as u64).map(|()| bend)
        })
        .try_reduce(|| (f64::INFINITY, None), |a, b| Ok(if b.0 < a.0 { b } else { a }))?;
    watch.advance(points as u64)?;
    Ok(Clearance {
        min: found.crowd.map_or(found.least, |crowd| found.least.min(crowd.ratio_max())),
        contacts: found.histogram.iter().sum(),
        below_one: found.below_one,
        piercing: found.piercing,
        worst: found.worst,
        histogram: found.histogram,
        curvature_min: bend.0,
        curvature_at: bend.1,
        crowd: found.crowd,
        pairs: found.pairs,
    })
}
