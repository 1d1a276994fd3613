//! Starts of warp knits: loops that the guides of one or two bars lay round needles.
//!
//! For a lap `a-b` of the chain, guide j of the bar stands in space j + a. It goes round the needle
//! between the spaces j + a and j + b, and waits in space j + b for the next course. The loop is
//! thus on needle j + min(a, b). It comes through the loops of the course below, from the back to
//! the face (+z). The underlap, from needle to needle, lies on the back.
//!
//! With two bars each needle has loops of two yarns. Both come through both loops of the course
//! below. The legs of each loop lie in front of the heads of both. The front bar is named first.
//! Its loops are foremost on the face, and its underlaps hindmost on the back.

use glam::DVec3;

use super::{Ends, Length, Start, StartYarn};

/// Distance of neighbouring wales, mm.
const WALE: f64 = 1.0;

/// Distance of neighbouring courses, mm.
const COURSE: f64 = 0.75 * WALE;

/// Height of a loop from foot to head, mm.
const HEIGHT: f64 = 1.6 * COURSE;

/// Half the distance of a loop's feet, mm.
const FOOT: f64 = 0.14 * WALE;

/// The length of an underlap's pieces, mm.
const PIECE: f64 = 0.4 * WALE;

/// Distance of an underlap behind its feet, in diameters.
const UNDERLAP: f64 = 0.6;

/// The number of wales of a repeat.
const WALES: i32 = 4;

/// The fewest courses of a repeat. Chains are repeated until they fill it.
const COURSES: usize = 4;

/// A lapping: the chains of its bars, and the diameter of their yarn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lapping<'a> {
    /// The chain of each bar, such as `1-0/1-2`, the front bar first.
    pub bars: &'a [&'a str],
    /// Diameter of the yarn, mm. Wales are 1 mm apart.
    pub diameter: f64,
    /// The distance by which each leg lies further in below, where it comes through another loop,
    /// and further out above, in diameters.
    pub bulge: f64,
    /// The height by which a loop begins below its course and ends above it, in courses.
    pub slant: f64,
}

/// Four wales of `lapping`, with every guide threaded.
///
/// # Panics
///
/// If a chain is not valid.
#[must_use]
pub fn warp_knit(name: &str, lapping: Lapping<'_>) -> Start {
    let chains: Vec<_> = lapping.bars.iter().map(|bar| chain(bar)).collect();
    let longest = chains.iter().map(Vec::len).max().unwrap_or(1);
    let courses = COURSES.next_multiple_of(longest);
    let guides =
        chains.iter().enumerate().flat_map(|(bar, chain)| (0..WALES).map(move |guide| (bar, chain, guide)));
    let height = DVec3::new(0.0, courses as f64 * COURSE, 0.0);
    let yarns = guides.map(|(bar, chain, guide)| {
        let loops = (0..courses)
            .flat_map(|course| loop_points(lapping, bar, course, guide, chain[course % chain.len()]));
        StartYarn {
            points: with_underlaps(&loops.collect::<Vec<_>>(), height, UNDERLAP * lapping.diameter),
            radius: lapping.diameter / 2.0,
            ends: Ends::Repeats([0, 1]),
        }
    });
    Start {
        name: name.to_owned(),
        yarns: yarns.collect(),
        repeat: [f64::from(WALES) * WALE, courses as f64 * COURSE],
        pinned: Vec::new(),
        length: Length::Held,
    }
}

/// Adds points to underlaps, so that none of their pieces is much longer than those of a loop: a
/// spline turns sharply where a long piece follows a short one. The added points lie further back
/// by `behind` than the line from foot to foot, because other yarns of the same bar have their feet
/// near that line. After the last point of `points` the first one follows, moved by `on`.
fn with_underlaps(points: &[DVec3], on: DVec3, behind: f64) -> Vec<DVec3> {
    let next = points[1..].iter().copied().chain([points[0] + on]);
    let pieces = points.iter().zip(next).flat_map(|(&from, to)| {
        let parts = (from.distance(to) / PIECE).round().max(1.0);
        let at = move |part: usize| {
            from.lerp(to, part as f64 / parts) - DVec3::Z * if part > 0 { behind } else { 0.0 }
        };
        (0..parts as usize).map(at)
    });
    pieces.collect()
}

/// The spaces of a guide before and after each lap.
fn chain(text: &str) -> Vec<[i32; 2]> {
    let lap = |lap: &str| {
        let (from, to) = lap.split_once('-')?;
        Some([from.parse().ok()?, to.parse().ok()?])
    };
    let laps: Option<Vec<[i32; 2]>> = text.split('/').map(lap).collect();
    let laps = laps.unwrap_or_else(|| panic!("no chain: {text}"));
    assert!(laps.iter().all(|[from, to]| from.abs_diff(*to) == 1), "{text} does not go round one needle");
    laps
}

/// One loop, from the foot at which the yarn comes in to the foot at which it goes out.
fn loop_points(
    lapping: Lapping<'_>,
    bar: usize,
    course: usize,
    guide: i32,
    [from, to]: [i32; 2],
) -> Vec<DVec3> {
    let Lapping { bars, diameter, bulge, slant } = lapping;
    let (last, front_most) = (bars.len() - 1, 0.5 * (bars.len() - 1) as f64 - bar as f64);
    // Legs of each bar lie in front of heads of both bars. This takes more depth than the bars are
    // apart.
    let (forward, tilt) = if last == 0 { (0.9, 0.0) } else { (1.0, 0.3) };
    let layer = 0.7 * front_most;
    let behind = if last == 0 { 2.2 } else { 2.0 + 1.8 * (last - bar) as f64 };
    // If both bars lap alike, their loops are set side by side. Otherwise they would lie in one
    // another.
    let beside = if last > 0 && bars.iter().all(|other| *other == bars[0]) { front_most } else { 0.0 };

    let side = f64::from(to - from);
    let middle = (f64::from(guide + from.min(to)) + 0.5) * WALE;
    let place = |x: f64, y: f64, z: f64| DVec3::new(x, course as f64 * COURSE + y, z * diameter);
    let leg = |hand: f64| {
        let at = |width: f64, y: f64, z: f64| place(middle + hand * width + beside * diameter, y, z + layer);
        [
            at(WALE / 4.0 - bulge * diameter, (HEIGHT - COURSE) / 2.0, tilt),
            at(WALE / 4.0, HEIGHT / 2.0, forward),
            at(WALE / 4.0 + bulge * diameter, (HEIGHT + COURSE) / 2.0, -tilt),
        ]
    };
    let foot = |hand: f64, up: f64| {
        place(
            middle + hand * (FOOT + front_most * diameter) + beside * diameter,
            up * slant * COURSE,
            -behind,
        )
    };
    let mut points = vec![foot(-side, -1.0)];
    points.extend(leg(-side));
    points.push(place(middle, HEIGHT, layer - forward));
    points.extend(leg(side).into_iter().rev());
    points.push(foot(side, 1.0));
    points
}
