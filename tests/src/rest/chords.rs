//! The yarns of a repeat as chords, and the chords that lie near one another.

use glam::DVec3;

use super::cells::Cells;
use super::check::Place;
use super::curve::Curve;
use super::{Ends, Start};

/// Number of chords per interval.
pub(super) const PARTS: usize = 16;

/// A straight piece of a centreline.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    pub(super) place: Place,
    /// The beginning of the chord within its interval, from 0 to 1.
    pub(super) start: f64,
    pub(super) from: DVec3,
    pub(super) to: DVec3,
    /// Largest distance of the curve from the chord: an eighth of the largest second derivative,
    /// times the square of the step.
    pub(super) sag: f64,
    /// Length of the yarn from its first point to each end of the chord.
    arc: [f64; 2],
}

impl Chord {
    pub(super) fn middle(&self) -> DVec3 {
        (self.from + self.to) / 2.0
    }

    pub(super) fn at(&self, along: f64) -> DVec3 {
        self.from.lerp(self.to, along)
    }

    /// The greatest distance of the chord's curve from the chord's middle.
    pub(super) fn reach(&self) -> f64 {
        self.from.distance(self.to) / 2.0 + self.sag
    }
}

/// The chords of a repeat.
pub(super) struct Chords<'a> {
    start: &'a Start,
    all: Vec<Chord>,
    /// Length of each yarn in one repeat.
    lengths: Vec<f64>,
}

impl<'a> Chords<'a> {
    pub(super) fn new(start: &'a Start, curves: &[Curve<'_>]) -> Self {
        let (mut all, mut lengths) = (Vec::new(), Vec::new());
        for (yarn, curve) in curves.iter().enumerate() {
            let mut length = 0.0;
            for (interval, piece) in curve.pieces().enumerate() {
                let sharpest = piece.bend(0.0).length().max(piece.bend(1.0).length());
                let arcs = piece.lengths(PARTS);
                let mut before = 0.0;
                for (part, &arc) in arcs.iter().enumerate() {
                    let [u, v] = [part, part + 1].map(|part| part as f64 / PARTS as f64);
                    all.push(Chord {
                        place: Place { yarn, interval },
                        start: u,
                        from: piece.at(u),
                        to: piece.at(v),
                        sag: sharpest / (8 * PARTS * PARTS) as f64,
                        arc: [length + before, length + arc],
                    });
                    before = arc;
                }
                length += before;
            }
            lengths.push(length);
        }
        Self { start, all, lengths }
    }

    /// An upper bound of the distance from any place to the nearest image of another place, mm.
    pub(super) fn widest(&self) -> f64 {
        let ends = || self.all.iter().flat_map(|chord| [chord.from, chord.to]);
        let low = ends().reduce(DVec3::min).unwrap_or_default();
        let high = ends().reduce(DVec3::max).unwrap_or_default();
        low.distance(high) + self.start.repeat.iter().sum::<f64>()
    }

    /// Length of yarn between the near ends of two chords, of which the second is moved by `image`.
    /// It is infinite for chords of two yarns.
    pub(super) fn arc_between(&self, one: &Chord, other: &Chord, image: [i32; 2]) -> f64 {
        if one.place.yarn != other.place.yarn {
            return f64::INFINITY;
        }
        let length = self.lengths[one.place.yarn];
        let gap =
            |further: f64| (one.arc[0] - other.arc[1] - further).max(other.arc[0] + further - one.arc[1]);
        match self.start.yarns[one.place.yarn].ends {
            Ends::Open if image == [0; 2] => gap(0.0),
            Ends::Closed if image == [0; 2] => {
                [-length, 0.0, length].map(gap).into_iter().fold(f64::INFINITY, f64::min)
            }
            Ends::Repeats(advance) => {
                let [x, y] = advance;
                let times = if x != 0 { image[0] / x } else { image[1] / y };
                if image == [times * x, times * y] { gap(f64::from(times) * length) } else { f64::INFINITY }
            }
            Ends::Open | Ends::Closed => f64::INFINITY,
        }
    }

    /// Calls `visit` once with every two chords that may come nearer than `reach`, and with the
    /// repeats by which the second one is moved.
    pub(super) fn each_pair(&self, reach: f64, mut visit: impl FnMut(&Chord, &Chord, [i32; 2])) {
        let longest = self.all.iter().map(Chord::reach).fold(0.0, f64::max);
        let middles: Vec<_> = self.all.iter().map(Chord::middle).collect();
        Cells::new(&middles, self.start.repeat, reach + 2.0 * longest)
            .each_pair(|one, other, image| visit(&self.all[one], &self.all[other], image));
    }
}
