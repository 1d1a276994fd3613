//! Clearance: how near yarns come to one another and to themselves, and how tightly they bend.

mod approach;
mod curvature;
mod found;
mod grid;
mod interval;
mod line;
mod passing;
mod search;
mod support;

use rayon::prelude::*;
use texere_core::Yarns;

pub(crate) use self::line::neighbours;

use self::found::Found;
use self::grid::Grid;
use self::search::Probe;
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
}

/// Measures how near yarns come to one another, to themselves, and how tightly they bend.
///
/// Of each pair of yarn parts within [`CLEARANCE_NEAR`] the nearest approach is found on the spline itself, whose tension is
/// `tension`; sections stand upright, as untwisted ones do, and count with their hulls. Two places of one yarn count
/// from an arc length of π/2 times the sum of their radii on: nearer ones can only meet in a bend tighter than the yarn
/// is thick (Schur's theorem: no curve with that curvature brings its ends closer than the circle does), which the
/// curvature tells. A loop within one control interval is told by the curvature alone.
///
/// Time grows with the number of near pairs (flat sections take about five times as long as round ones); beside the yarns
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
    let mut found = (0..grid.len().div_ceil(TASK))
        .into_par_iter()
        .map(|task| probe.search(&grid, task * TASK..grid.len().min((task + 1) * TASK)))
        .reduce(Found::default, Found::joined);
    found.keep_worst();
    let bend = spans
        .par_iter()
        .map(|span| probe.tightest(span))
        .reduce(|| (f64::INFINITY, None), |a, b| if b.0 < a.0 { b } else { a });
    Ok(Clearance {
        min: found.worst.first().map_or(f64::INFINITY, |contact| contact.ratio),
        contacts: found.histogram.iter().sum(),
        below_one: found.below_one,
        worst: found.worst,
        histogram: found.histogram,
        curvature_min: bend.0,
        curvature_at: bend.1,
    })
}
