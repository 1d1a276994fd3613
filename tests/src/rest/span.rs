//! Loops of a piece of cloth as chains of chords, and the yarns that pass through the surface that
//! a loop spans.

use glam::DVec3;
use texere_core::Yarns;
use texere_fabric::Piece;

use super::{Ends, Length, Start, StartYarn};

/// The control points of each yarn.
///
/// # Panics
///
/// If a yarn has no points. [`Yarns`] refuses such a yarn.
#[must_use]
pub fn piece_points(yarns: &Yarns) -> Vec<Vec<DVec3>> {
    let position = |yarn| yarns.yarn_points(yarn).expect("a yarn").iter().map(|at| at.position().as_dvec3());
    (0..yarns.layout().yarns().len()).map(|yarn| position(yarn).collect()).collect()
}

/// A piece as a start for the checks. All of its yarns have one radius.
#[must_use]
pub fn piece_start(name: &str, piece: &Piece, radius: f64) -> Start {
    let ends = piece.boundary.ends().iter().map(|ends| match ends {
        texere_core::Ends::Open => Ends::Open,
        texere_core::Ends::Closed => Ends::Closed,
        texere_core::Ends::Repeats(shift) => Ends::Repeats(*shift),
    });
    let yarns = piece_points(&piece.yarns).into_iter().zip(ends);
    Start {
        name: name.to_owned(),
        yarns: yarns.map(|(points, ends)| StartYarn { points, radius, ends }).collect(),
        repeat: piece.boundary.repeat().map(f64::from),
        pinned: Vec::new(),
        length: Length::Free,
    }
}

/// The spline of a yarn that goes on in another repeat, in `parts` chords per control interval. The
/// last chord ends at the first point of that repeat. `yarns` are the yarns of `piece`, possibly
/// moved.
///
/// # Panics
///
/// For a yarn that does not go on in another repeat.
#[must_use]
pub fn piece_curve(piece: &Piece, yarns: &Yarns, yarn: usize, parts: usize) -> Vec<DVec3> {
    let points: Vec<_> =
        yarns.yarn_points(yarn).expect("a yarn").iter().map(|point| point.position().as_dvec3()).collect();
    let texere_core::Ends::Repeats(_) = piece.boundary.ends()[yarn] else { panic!("a yarn that goes on") };
    let (count, [x, y]) = (points.len() as isize, piece.boundary.onward_mm(yarn));
    let at = |number: isize| {
        points[number.rem_euclid(count) as usize] + DVec3::new(x, y, 0.0) * number.div_euclid(count) as f64
    };
    let sample = |number: usize| {
        let (interval, t) = ((number / parts) as isize, (number % parts) as f64 / parts as f64);
        let [a, b, c, d] = [-1, 0, 1, 2].map(|step| at(interval + step));
        let [t2, t3] = [t * t, t * t * t];
        0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t2 + (3.0 * (b - c) + d - a) * t3)
    };
    (0..=points.len() * parts).map(sample).collect()
}

/// A surface that a loop spans: triangles from a point between its feet from which the whole loop
/// is seen.
#[derive(Debug, Clone, Copy)]
pub struct Span<'a> {
    ring: &'a [DVec3],
    middle: DVec3,
    low: DVec3,
    high: DVec3,
}

impl<'a> Span<'a> {
    /// The surface of a chain from foot to foot, which has `parts` chords per control interval.
    ///
    /// # Panics
    ///
    /// For a chain of less than two intervals.
    #[must_use]
    pub fn new(ring: &'a [DVec3], parts: usize) -> Self {
        let fold = |fold: fn(DVec3, DVec3) -> DVec3| ring.iter().copied().reduce(fold).expect("points");
        let last = ring.len() - 1;
        let feet = [1, 2].map(|point| ring[point * parts] + ring[last - point * parts]);
        let middle = (feet[0] + feet[1]) / 4.0;
        Self { ring, middle, low: fold(DVec3::min), high: fold(DVec3::max) }
    }

    /// Number of times that a chain goes through the surface, less the number of times that it
    /// comes back.
    #[must_use]
    pub fn through(&self, chain: &[DVec3]) -> i32 {
        let mut count = 0;
        for chord in chain.windows(2) {
            let (from, to) = (chord[0], chord[1]);
            if from.max(to).cmplt(self.low).any() || from.min(to).cmpgt(self.high).any() {
                continue;
            }
            for (k, &one) in self.ring.iter().enumerate() {
                let other = self.ring[(k + 1) % self.ring.len()];
                let sides = [from, to].map(|point| volume(self.middle, one, other, point) > 0.0);
                let corners = [[self.middle, one], [one, other], [other, self.middle]];
                let inside = corners.map(|[one, other]| volume(from, to, one, other) > 0.0);
                if sides[0] != sides[1] && inside.iter().all(|side| *side == inside[0]) {
                    count += if sides[0] { 1 } else { -1 };
                }
            }
        }
        count
    }
}

/// Six times the volume of a tetrahedron, with its sign.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}
