//! Clearance: how near yarns come to one another and to themselves, and how tightly they bend.

mod approach;
mod curvature;
mod grid;
mod interval;
mod support;

use std::cell::OnceCell;
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use texere_core::Yarns;

pub(crate) use self::interval::neighbours;

use self::approach::{Side, refine};
use self::grid::{Bounds, Grid};
use self::interval::{Chords, Cubic, Intervals, SAGITTA, closest};
use self::support::Support;
use crate::FabricError;

/// Contacts further apart than this factor are not looked for.
pub const CLEARANCE_NEAR: f64 = 1.1;

/// How exact a ratio is where both yarns are round: yarns at 0.999 of touching count as touching.
///
/// Of flat yarns it is 0.01: their sections' frames and tangents count, but not how these change along a section's
/// reach.
pub const CLEARANCE_ACCURACY: f64 = 1e-3;

/// The most contacts that are listed one by one.
pub const CONTACTS_LISTED: usize = 100;

/// Width of a bin of the histogram.
pub const CLEARANCE_BIN: f64 = 0.01;

/// Bins from 0 to [`CLEARANCE_NEAR`].
const BINS: usize = 110;

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
    /// Below 1 the tube folds into itself. Infinite where all yarns are straight.
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
/// Time grows with the number of near pairs; beside the yarns it takes about 16 bytes a control point.
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
    let probe = Probe {
        intervals: Intervals::new(yarns, tension),
        supports: yarns.layout().sections().iter().map(Support::new).collect(),
    };
    let grid = Grid::new(points, |point| probe.bounds(point))?;
    let mut found = (0..grid.len().div_ceil(TASK))
        .into_par_iter()
        .map(|task| {
            let mut found = Found::default();
            for cell in task * TASK..grid.len().min((task + 1) * TASK) {
                probe.search(&grid, cell, &mut found);
            }
            found
        })
        .reduce(Found::default, Found::joined);
    found.keep_worst();
    let bend = (0..points.div_ceil(TASK))
        .into_par_iter()
        .map(|task| probe.tightest(task * TASK..points.min((task + 1) * TASK)))
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

/// What one task has found.
struct Found {
    below_one: u64,
    histogram: Vec<u64>,
    worst: Vec<Contact>,
    /// A ratio above which a contact is not among the worst.
    bar: f64,
}

impl Default for Found {
    fn default() -> Self {
        Self { below_one: 0, histogram: vec![0; BINS], worst: Vec::new(), bar: f64::INFINITY }
    }
}

impl Found {
    fn add(&mut self, ratio: f64, contact: impl FnOnce() -> Contact) {
        self.below_one += u64::from(ratio < 1.0 - CLEARANCE_ACCURACY);
        if let Some(bin) = self.histogram.get_mut((ratio / CLEARANCE_BIN) as usize) {
            *bin += 1;
        }
        if ratio <= self.bar {
            self.worst.push(contact());
        }
        if self.worst.len() > 2 * CONTACTS_LISTED {
            self.keep_worst();
        }
    }

    fn keep_worst(&mut self) {
        self.worst.sort_by(by_ratio);
        if self.worst.len() >= CONTACTS_LISTED {
            self.worst.truncate(CONTACTS_LISTED);
            self.bar = self.worst.last().map_or(f64::INFINITY, |contact| contact.ratio);
        }
    }

    fn joined(mut self, other: Self) -> Self {
        self.below_one += other.below_one;
        for (bin, more) in self.histogram.iter_mut().zip(&other.histogram) {
            *bin += more;
        }
        self.worst.extend(other.worst);
        self.keep_worst();
        self
    }
}

/// Worst first; of two alike the one that comes first along the yarns, whatever order they were found in.
fn by_ratio(a: &Contact, b: &Contact) -> Ordering {
    let place = |contact: &Contact| contact.places.map(|place| (place.yarn, place.interval));
    a.ratio.total_cmp(&b.ratio).then_with(|| place(a).cmp(&place(b)))
}

/// One interval in a cell.
struct Part {
    point: usize,
    yarn: usize,
    bounds: Bounds,
    cubic: Cubic,
    chords: OnceCell<Chords>,
}

struct Probe<'a> {
    intervals: Intervals<'a>,
    supports: Vec<Support>,
}

impl Probe<'_> {
    fn support(&self, yarn: usize) -> &Support {
        &self.supports[self.intervals.yarns.layout().yarns()[yarn].section as usize]
    }

    /// The box that holds what lies within [`CLEARANCE_NEAR`] of interval `point`'s centreline; none for an open yarn's last point.
    fn bounds(&self, point: usize) -> Option<Bounds> {
        let yarn = self.intervals.yarn(point);
        let (first, count, _) = self.intervals.of(yarn);
        (point < first + count).then(|| self.bounds_of(yarn, &self.intervals.cubic(yarn, point)))
    }

    fn bounds_of(&self, yarn: usize, cubic: &Cubic) -> Bounds {
        Bounds::around(&cubic.hull(), CLEARANCE_NEAR * cubic.radius_bound() * self.support(yarn).extent())
    }

    /// All contacts of intervals that meet in `cell`.
    fn search(&self, grid: &Grid, cell: usize, found: &mut Found) {
        let mut points: Vec<usize> = grid.entries(cell).collect();
        points.sort_unstable();
        let parts: Vec<Part> = points
            .into_iter()
            .map(|point| {
                let yarn = self.intervals.yarn(point);
                let cubic = self.intervals.cubic(yarn, point);
                Part { point, yarn, bounds: self.bounds_of(yarn, &cubic), cubic, chords: OnceCell::new() }
            })
            .collect();
        for (second, other) in parts.iter().enumerate() {
            for one in &parts[..second] {
                let meets = one.bounds.meets(&other.bounds) && grid.counts(cell, &one.bounds, &other.bounds);
                if meets && !self.leads_on(one, other) {
                    self.pair(one, other, found);
                }
            }
        }
    }

    /// Whether two intervals follow one another so straight that they meet at their common knot alone.
    fn leads_on(&self, one: &Part, other: &Part) -> bool {
        if one.yarn != other.yarn || other.point - one.point > 1 {
            return false;
        }
        let (a, b) = (one.cubic.hull(), other.cubic.hull());
        let forward = (b[3] - a[0]).normalize_or_zero();
        let steps = [a[1] - a[0], a[2] - a[1], a[3] - a[2], b[1] - b[0], b[2] - b[1], b[3] - b[2]];
        // Within 45 degrees of one direction, so that any two of its steps add up and none leads back.
        steps.iter().all(|step| step.dot(forward) >= std::f64::consts::FRAC_1_SQRT_2 * step.length())
    }

    /// Whether one of two round yarns of even radius goes towards the other, or away from it, all along its interval: then
    /// they come nearest in another pair of intervals.
    fn pass_by(&self, one: &Part, other: &Part) -> bool {
        if !one.cubic.is_even() || !other.cubic.is_even() {
            return false;
        }
        // Both curves lie within balls round the middles of their hulls' corners.
        let balls = [one, other].map(|part| {
            let hull = part.cubic.hull();
            let middle = hull.iter().sum::<DVec3>() / 4.0;
            (middle, hull.iter().map(|corner| corner.distance_squared(middle)).fold(0.0, f64::max).sqrt())
        });
        let (apart, spread) = (balls[0].0 - balls[1].0, balls[0].1 + balls[1].1);
        [(one, apart), (other, -apart)].into_iter().any(|(part, apart)| {
            let (first, count, closed) = self.intervals.of(part.yarn);
            let velocities = part.cubic.velocities();
            let goes = |sign: f64| velocities.iter().all(|v| sign * apart.dot(*v) > spread * v.length());
            // Away from its beginning on: nearest where it begins, unless the yarn is cut off there.
            let (cut_before, cut_after) =
                (!closed && part.point == first, !closed && part.point + 1 == first + count);
            (!cut_before && goes(1.0)) || (!cut_after && goes(-1.0))
        })
    }

    fn pair(&self, one: &Part, other: &Part, found: &mut Found) {
        let supports = [self.support(one.yarn), self.support(other.yarn)];
        let reach = one.cubic.radius_bound() * supports[0].extent()
            + other.cubic.radius_bound() * supports[1].extent();
        let straight = [one, other].map(|part| [part.cubic.position(0.0), part.cubic.position(1.0)]);
        let bends = one.cubic.bend() + other.cubic.bend();
        let within = CLEARANCE_NEAR * reach;
        if closest(straight[0], straight[1]).0 > (within + bends).powi(2) {
            return;
        }
        if supports.iter().all(|support| support.is_circle()) && self.pass_by(one, other) {
            return;
        }
        let chords = [one, other].map(|part| part.chords.get_or_init(|| part.cubic.chords()));
        let [a, b] = [(one, supports[0]), (other, supports[1])].map(|(part, support)| {
            let (first, count, closed) = self.intervals.of(part.yarn);
            let cut = [!closed && part.point == first, !closed && part.point + 1 == first + count];
            Side { cubic: &part.cubic, support, cut }
        });
        // Chords may be further from one another than the curves are.
        let within = within + SAGITTA * reach;
        let mut seen: Vec<DVec2> = Vec::new();
        chords[0].approaches(chords[1], within, |s, t| {
            let Some((place, ratio)) = refine(a, b, DVec2::new(s, t)) else { return };
            let again = seen.iter().any(|other| (*other - place).abs().max_element() < 0.01);
            if ratio > CLEARANCE_NEAR || again || self.too_close(one, other, place) {
                return;
            }
            seen.push(place);
            found.add(ratio, || Contact {
                places: [self.place(one, place.x), self.place(other, place.y)],
                ratio,
            });
        });
    }

    /// Whether two places of one yarn are so close along it that only a fold could make them meet.
    fn too_close(&self, one: &Part, other: &Part, place: DVec2) -> bool {
        if one.yarn != other.yarn {
            return false;
        }
        let (first, count, closed) = self.intervals.of(one.yarn);
        let points = self.intervals.yarns.yarn_points(one.yarn).unwrap_or(&[]);
        let radii = one.cubic.at(place.x).radius[0] + other.cubic.at(place.y).radius[0];
        let window = FRAC_PI_2 * radii * self.support(one.yarn).extent();
        // Forward from `from` to `to`, by chords; given up as soon as it is far enough.
        let near = |from: &Part, s: f64, to: &Part, t: f64| {
            let mut left = window - from.cubic.position(s).distance(from.cubic.position(1.0));
            let mut at = (from.point - first + 1) % count.max(1);
            while left > 0.0 && at != to.point - first {
                let next = (at + 1) % points.len();
                left -= f64::from(points[at].position().distance(points[next].position()));
                if next == 0 && !closed {
                    return false;
                }
                at = next;
            }
            left > to.cubic.position(0.0).distance(to.cubic.position(t))
        };
        near(one, place.x, other, place.y) || (closed && near(other, place.y, one, place.x))
    }

    fn place(&self, part: &Part, t: f64) -> YarnPlace {
        let (first, count, closed) = self.intervals.of(part.yarn);
        let interval = part.point - first;
        let nearer = match (t < 0.5, closed && interval + 1 == count) {
            (true, _) => interval,
            (false, true) => 0,
            (false, false) => interval + 1,
        };
        let source = self.intervals.yarns.sources().and_then(|sources| sources.get(first + nearer)).copied();
        YarnPlace { yarn: part.yarn, interval, t, position: part.cubic.position(t).to_array(), source }
    }

    /// The tightest bend of the intervals `points`.
    fn tightest(&self, points: std::ops::Range<usize>) -> (f64, Option<YarnPlace>) {
        let mut best = (f64::INFINITY, None);
        for point in points {
            let yarn = self.intervals.yarn(point);
            let (first, count, _) = self.intervals.of(yarn);
            if point >= first + count {
                continue;
            }
            let cubic = self.intervals.cubic(yarn, point);
            if let Some((ratio, t)) = curvature::tightest(&cubic, self.support(yarn), best.0) {
                let bounds = self.bounds_of(yarn, &cubic);
                best = (
                    ratio,
                    Some(self.place(&Part { point, yarn, bounds, cubic, chords: OnceCell::new() }, t)),
                );
            }
        }
        best
    }
}
