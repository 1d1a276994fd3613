//! Control points that are spread evenly along their yarn. This is done for yarns that go round:
//! yarns that close, or go on in another repeat.
//!
//! An interval keeps its length while yarns relax, so where it is long at the start, the spline
//! stays coarse. A loop with short and long intervals bends less easily than a loop with equal
//! ones: with 12 points to a loop, slack jersey at rest got 3 to 7 % wider than with 48 points,
//! depending on the gauge at the start. With equal intervals it gets 0.7 % wider
//! (`jersey_forgets_the_gauge_of_its_needles`).

use glam::DVec3;

use super::node::{GAUSS, Node, blend};

/// Number of intervals over which lengths are averaged: those of a loop of a weft knit. Loops of
/// warp knits have somewhat fewer. Floats have much longer intervals, which stay longer. With half
/// the value, and with twice, no test is red.
const LOOP: usize = 12;

/// The rounds of Newton's method that find a place by its distance along an interval. Three are
/// enough where speeds differ little, and five where a loop's arc meets a float. With half the
/// value, and with twice, no test is red.
const ROUNDS: u32 = 5;

/// The parts of an interval whose lengths are added. With one part, places on an interval and on
/// its mirror image are not equal enough for tuck to be found symmetrical. With half the value, and
/// with twice, no test is red.
const PIECES: u32 = 6;

/// Lengths averaged over a loop of a yarn that goes round. Their sum stays.
pub(super) fn averaged(lengths: &[f64]) -> Vec<f64> {
    let count = lengths.len();
    let half = LOOP.min(count) / 2;
    let mean = |at: usize| {
        let within = |offset: usize| lengths[(at + count - half + offset) % count];
        let inner: f64 = (1..2 * half).map(within).sum();
        (inner + 0.5 * (within(0) + within(2 * half))) / (2 * half) as f64
    };
    (0..count).map(mean).collect()
}

/// Places on a yarn that goes round, one for each control point, with the distances `even` along
/// the yarn. `lengths` are those of the yarn's intervals. `window` gives the four control points of
/// an interval by its number, in the rounds before and after, too. In the mean, the places lie as
/// far along the yarn as the control points. `s` is that of [`Node::new`].
pub(super) fn spread(
    s: f64,
    lengths: &[f64],
    even: &[f64],
    window: impl Fn(i64) -> [DVec3; 4],
) -> Vec<DVec3> {
    let length = |at: i64| lengths[at.rem_euclid(lengths.len() as i64) as usize];
    let (mut behind, mut sum) = (0.0, 0.0);
    for (length, even) in lengths.iter().zip(even) {
        sum += behind;
        behind += length - even;
    }
    let mut target = sum / lengths.len() as f64;
    // The interval in which the target lies, and the distance along the yarn to its start.
    let (mut at, mut start) = (0_i64, 0.0);
    while target < start {
        at -= 1;
        start -= length(at);
    }
    let mut places = Vec::with_capacity(lengths.len());
    for even in even {
        while target >= start + length(at) {
            start += length(at);
            at += 1;
        }
        places.push(place(s, &window(at), target - start, length(at)));
        target += even;
    }
    places
}

/// The place at a distance from the start of an interval of this length.
fn place(s: f64, window: &[DVec3; 4], distance: f64, length: f64) -> DVec3 {
    let speed = |u: f64| blend(&Node::new(u, s).velocity, window).length();
    let piece = |from: f64, to: f64| {
        let nodes = GAUSS.iter().map(|(node, weight)| weight * speed(from + (to - from) * node));
        nodes.sum::<f64>() * (to - from)
    };
    let arc = |to: f64| {
        (0..PIECES)
            .map(|at| [at, at + 1].map(|at| to * f64::from(at) / f64::from(PIECES)))
            .map(|[from, to]| piece(from, to))
            .sum::<f64>()
    };
    // The interval's length was measured in one piece.
    let distance = distance * arc(1.0) / length;
    let mut u = (distance / length).clamp(0.0, 1.0);
    for _ in 0..ROUNDS {
        u = (u + (distance - arc(u)) / speed(u).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    }
    blend(&Node::new(u, s).position, window)
}
