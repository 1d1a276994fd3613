//! Measures of cloth at rest: clearance, bends, lengths and thickness.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::Start;
use super::chords::{Chord, Chords, PARTS};
use super::curve::{Curve, Piece};
use super::segments::closest;

/// An interval of a yarn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// The number of the yarn.
    pub yarn: usize,
    /// The number of the control point at which the interval begins.
    pub interval: usize,
}

/// The result of [`check`].
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The least distance between two centrelines, divided by the sum of their radii. Copies of the
    /// cloth in the repeats beside it count, too. Two places of one yarn count only if the yarn
    /// between them is at least pi/2 times the sum of the radii long. That is half the length of
    /// the smallest ring into which the yarn can be bent before it touches itself. A straight yarn
    /// therefore has a clearance of about pi/2 from itself, so no clearance is much larger.
    pub clearance: f64,
    /// The two places of the least distance. None if no two places count.
    pub nearest: Option<[Place; 2]>,
    /// The least radius of curvature, in diameters of the yarn. If it is below a half, the yarn
    /// folds into itself.
    pub bend: f64,
    /// The interval with the least radius of curvature.
    pub sharpest: Place,
    /// Growth of the yarn whose length changed most, as a share of its length at the start. It is
    /// negative if the yarn is shorter.
    pub stretch: f64,
    /// The number of the yarn whose length changed most.
    pub stretched: usize,
    /// Growth of all yarns together, as a share of their length at the start.
    pub growth: f64,
    /// Distance from the lowest surface to the highest, mm.
    pub thickness: f64,
}

/// Measures `settled`, the control points of `start` after settling, in f64 and with no code of
/// texere's crates.
///
/// # Panics
///
/// If `settled` has other yarns or other counts of points than `start`, or points that are not
/// finite.
#[must_use]
pub fn check(start: &Start, settled: &[Vec<DVec3>]) -> Report {
    assert_eq!(settled.len(), start.yarns.len(), "{}: yarns", start.name);
    assert!(settled.iter().flatten().all(|point| point.is_finite()), "{}: a point is not finite", start.name);
    let at_start = start.points();
    let curves: Vec<_> = (0..settled.len()).map(|yarn| Curve::new(start, yarn, &settled[yarn])).collect();
    let (clearance, nearest) = clearance(start, &curves);
    let (bend, sharpest) = bend(start, &curves);

    let length = |curve: &Curve<'_>| curve.pieces().map(|piece| piece.lengths(PARTS)[PARTS - 1]).sum::<f64>();
    let lengths: Vec<_> = curves.iter().map(length).collect();
    let before: Vec<_> =
        (0..settled.len()).map(|yarn| length(&Curve::new(start, yarn, &at_start[yarn]))).collect();
    let stretches = lengths.iter().zip(&before).map(|(now, before)| now / before - 1.0);
    let (stretched, stretch) = stretches
        .enumerate()
        .max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))
        .expect("a cloth has yarns");
    Report {
        clearance,
        nearest,
        bend,
        sharpest,
        stretch,
        stretched,
        growth: lengths.iter().sum::<f64>() / before.iter().sum::<f64>() - 1.0,
        thickness: thickness(start, &curves),
    }
}

/// The ends of an interval's parts, in \[0, 1\].
fn parts() -> impl Iterator<Item = f64> {
    (0..=PARTS).map(|part| part as f64 / PARTS as f64)
}

fn thickness(start: &Start, curves: &[Curve<'_>]) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (yarn, curve) in start.yarns.iter().zip(curves) {
        for z in curve.pieces().flat_map(|piece| parts().map(move |u| piece.at(u).z)) {
            (low, high) = (low.min(z - yarn.radius), high.max(z + yarn.radius));
        }
    }
    high - low
}

/// The least radius of curvature in diameters, and its place.
fn bend(start: &Start, curves: &[Curve<'_>]) -> (f64, Place) {
    let intervals = curves.iter().enumerate().flat_map(|(yarn, curve)| {
        let diameter = 2.0 * start.yarns[yarn].radius;
        curve
            .pieces()
            .enumerate()
            .map(move |(interval, piece)| (least_radius(&piece) / diameter, Place { yarn, interval }))
    });
    intervals.min_by(|one, other| one.0.total_cmp(&other.0)).expect("a yarn has intervals")
}

/// The least radius of curvature of an interval. It is searched first at the ends of the interval's
/// parts, and then in smaller and smaller steps around the place of the least.
fn least_radius(piece: &Piece) -> f64 {
    let mut step = 1.0 / PARTS as f64;
    let least = |places: &mut dyn Iterator<Item = f64>| {
        let radii = places.map(|u| (piece.radius(u), u));
        radii.min_by(|one, other| one.0.total_cmp(&other.0)).expect("there are places")
    };
    let (mut radius, mut at) = least(&mut parts());
    for _ in 0..4 {
        step /= 4.0;
        (radius, at) = least(&mut (-4..=4).map(|k| (at + f64::from(k) * step).clamp(0.0, 1.0)));
    }
    radius
}

/// The least distance of two places that count, divided by the sum of the radii, and the two
/// places.
fn clearance(start: &Start, curves: &[Curve<'_>]) -> (f64, Option<[Place; 2]>) {
    let chords = Chords::new(start, curves);
    let thickest = start.yarns.iter().map(|yarn| yarn.radius).fold(0.0, f64::max);
    let mut reach = 2.2 * thickest;
    loop {
        let (ratio, places) = nearest(start, curves, &chords, reach);
        // Nothing beyond the reach is nearer, or the reach covers everything. A smaller first reach
        // would only need more rounds.
        if ratio * 2.0 * thickest <= reach || reach > chords.widest() {
            return (ratio, places);
        }
        reach *= 2.0;
    }
}

/// The least ratio of all places at most `reach` apart. Places further apart may or may not be
/// included.
fn nearest(start: &Start, curves: &[Curve<'_>], chords: &Chords, reach: f64) -> (f64, Option<[Place; 2]>) {
    let mut least = (f64::INFINITY, None);
    chords.each_pair(reach, |one, other, image| {
        let both = start.yarns[one.place.yarn].radius + start.yarns[other.place.yarn].radius;
        let shift = start.shift(image);
        let way = one.middle().distance(other.middle() + shift) - one.reach() - other.reach();
        if way >= least.0 * both || chords.arc_between(one, other, image) < FRAC_PI_2 * both {
            return;
        }
        let (u, v) = closest([one.from, one.to], [other.from + shift, other.to + shift]);
        let way = one.at(u).distance(other.at(v) + shift) - one.sag - other.sag;
        if way < least.0 * both {
            let ratio = refined(curves, one, other, shift, [u, v]) / both;
            if ratio < least.0 {
                least = (ratio, Some([one.place, other.place]));
            }
        }
    });
    least
}

/// The least distance between the curves over two chords. The search starts at `places`, in \[0,
/// 1\] along the chords, and takes the closest points of the tangents there, repeatedly.
fn refined(curves: &[Curve<'_>], one: &Chord, other: &Chord, shift: DVec3, places: [f64; 2]) -> f64 {
    let piece = |chord: &Chord| curves[chord.place.yarn].piece(chord.place.interval as isize);
    let (first, second) = (piece(one), piece(other));
    let step = 1.0 / PARTS as f64;
    let [mut u, mut v] = places;
    let mut least = f64::INFINITY;
    for _ in 0..6 {
        let (s, t) = (one.start + u * step, other.start + v * step);
        let (here, there) = (first.at(s), second.at(t) + shift);
        least = least.min(here.distance(there));
        let tangent =
            |at: DVec3, slope: DVec3, w: f64| [at - slope * (w * step), at + slope * ((1.0 - w) * step)];
        (u, v) = closest(tangent(here, first.slope(s), u), tangent(there, second.slope(t), v));
    }
    least
}
