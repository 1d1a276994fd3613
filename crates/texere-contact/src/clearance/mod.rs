//! Clearance: how near yarns come to one another and to themselves, and how tightly they bend.

mod approach;
mod chords;
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

/// Number of cells in one task of the search, and of intervals in one task of the bends.
const TASK: usize = 1024;

/// How near yarns come to one another and to themselves.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    /// The least [ratio](Contact::ratio) of all contacts, infinite if nothing comes within
    /// [`CLEARANCE_NEAR`]. A [crowd](Clearance::crowd) bounds this ratio from above by the room
    /// that the yarns there have. That bound may be less than the ratio of any contact.
    pub min: f64,
    /// Number of contacts within [`CLEARANCE_NEAR`]. Two yarns side by side may make a contact in
    /// each pair of control intervals.
    pub contacts: u64,
    /// Number of contacts whose ratio is below 1 by more than [`CLEARANCE_ACCURACY`]. Threads that
    /// touch by construction have many such contacts, since the ratio falls to 0.99 between the
    /// control points of their splines.
    pub below_one: u64,
    /// Number of contacts that pierce: their ratio is below [`CLEAR`].
    pub piercing: u64,
    /// The worst contacts, [`CONTACTS_LISTED`] at most, worst first.
    pub worst: Vec<Contact>,
    /// Numbers of contacts by ratio, in steps of [`CLEARANCE_BIN`]: in \[0, 0.01), \[0.01, 0.02)
    /// and so on to [`CLEARANCE_NEAR`].
    pub histogram: Vec<u64>,
    /// The least radius of curvature, divided by the section's reach into the bend. A round section
    /// reaches as far as its radius. A section that turns counts with its furthest reach at any
    /// roll. Below 1 the tube folds into itself. The value is infinite if all yarns are straight,
    /// and exact to a thousandth.
    pub curvature_min: f64,
    /// The place of the tightest bend.
    pub curvature_at: Option<YarnPlace>,
    /// The worst of the places that are too crowded to be measured. The numbers above leave out
    /// some or all contacts there.
    pub crowd: Option<Crowd>,
    /// Pairs of control intervals that were compared, a measure of the work: [`CLEARANCE_PAIRS`]
    /// for each control point at most.
    pub pairs: u64,
}

/// Measures how near yarns come to one another and to themselves, and how tightly they bend.
///
/// Surfaces are those of a mesh with `settings`, without its facets: sections stand on the spline
/// with the roll and the flattening that they have on its rings. A ply that lies in another yarn's
/// furrow touches where the surfaces do, not where their hulls would. A contact is a place where
/// two yarns, or two parts of one, are nearer to one another than anywhere close by. Contacts up to
/// the ratio [`CLEARANCE_NEAR`] count.
///
/// Two places of one yarn count if they are at least π/2 times the sum of their radii apart along
/// the chords between control points. Nearer places can only meet in a bend tighter than the yarn
/// is thick, which shows in the curvature (Schur's theorem: a curve that nowhere bends more tightly
/// than a circle brings its ends no closer than an arc of that circle of the same length does). A
/// loop within one control interval shows in the curvature too, and is no contact.
///
/// Yarns that are several times as thick as they lie apart are not compared in pairs, but reported
/// as [`Clearance::crowd`]. Time therefore grows with the control points alone. Flat sections take
/// about seven times as long as round ones, sections with plies or twist ten to thirty times.
/// Memory is about 9 bytes a control point beside the yarns, and 4 more if a yarn's roll matters.
///
/// **Errors**: [`ContactError::ClearancePoints`] for more control points than are measured,
/// [`ContactError::Settings`] for more points between control points, or more rings of a yarn, than
/// a mesh may have, and [`ContactError::OutOfMemory`].
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

/// Measures as [`clearance()`] does, and calls `progress` with the share of the work done, from 0
/// to 1, from any thread. `Break` ends the measurement.
///
/// **Errors**: the errors of [`clearance`], and [`ContactError::Cancelled`] if `progress` asks to
/// stop.
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

/// Measures the [`clearance()`] of the intervals for which `fresh` holds, among themselves and from
/// all other intervals. The curvature is that of all intervals. `fresh` gets the number of an
/// interval's first control point. `[near, ratio]` are limits. No contact beyond `near` is looked
/// for. If `ratio` is finite, all contacts up to `ratio` are listed, worst first, instead of the
/// worst [`CONTACTS_LISTED`].
///
/// **Errors**: the errors of [`clearance_with_progress`].
pub fn clearance_up_to(
    yarns: &Yarns,
    settings: &Settings,
    [near, ratio]: [f64; 2],
    fresh: impl Fn(usize) -> bool + Sync,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Clearance, ContactError> {
    measured(yarns, settings, [near, ratio], &fresh, &mut progress)
}

/// The intervals for which `fresh` holds and that bend more tightly than `ratio`, in the measure of
/// [`Clearance::curvature_min`]. Each comes with its ratio and the place of its tightest bend.
///
/// **Errors**: [`ContactError::Settings`] as for [`clearance()`], and
/// [`ContactError::OutOfMemory`].
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

/// The clearance of the intervals of `yarns` for which `fresh` holds, by their contacts within
/// `near`, and the curvature of all intervals. The worst contacts are listed if `ratio` is
/// infinite, and all contacts up to `ratio` if it is finite.
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
    let grid = Grid::new(spans.len(), &watch, |span| {
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
