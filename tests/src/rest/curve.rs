//! The centreline of a yarn: a cardinal spline of tension 0, in f64.

use glam::DVec3;

use super::{Ends, Start};

/// The centreline of a yarn of a start. Its points may have moved since.
pub(super) struct Curve<'a> {
    points: &'a [DVec3],
    ends: Ends,
    /// Vector from the first point to the point after the last one.
    advance: DVec3,
}

impl<'a> Curve<'a> {
    /// The centreline of yarn `yarn` of `start` through `points`.
    pub(super) fn new(start: &Start, yarn: usize, points: &'a [DVec3]) -> Self {
        let ends = start.yarns[yarn].ends;
        assert_eq!(points.len(), start.yarns[yarn].points.len(), "{}: points of yarn {yarn}", start.name);
        assert!(points.len() > 1, "{}: yarn {yarn} has no interval", start.name);
        let advance = match ends {
            Ends::Open | Ends::Closed => DVec3::ZERO,
            Ends::Repeats(repeats) => start.shift(repeats),
        };
        Self { points, ends, advance }
    }

    /// Number of intervals in one repeat.
    pub(super) fn intervals(&self) -> usize {
        if self.ends == Ends::Open { self.points.len() - 1 } else { self.points.len() }
    }

    /// Control point `index`. It may lie before the first one or after the last one.
    pub(super) fn control(&self, index: isize) -> DVec3 {
        let count = self.points.len() as isize;
        let last = self.points.len() - 1;
        match self.ends {
            Ends::Open if index == -1 => 2.0 * self.points[0] - self.points[1],
            Ends::Open if index == count => 2.0 * self.points[last] - self.points[last - 1],
            Ends::Open => self.points[index as usize],
            Ends::Closed | Ends::Repeats(_) => {
                self.points[index.rem_euclid(count) as usize] + index.div_euclid(count) as f64 * self.advance
            }
        }
    }

    /// The interval that begins at control point `index`.
    pub(super) fn piece(&self, index: isize) -> Piece {
        let [before, from, to, after] = [-1, 0, 1, 2].map(|step| self.control(index + step));
        Piece { from, to, leaving: (to - before) / 2.0, arriving: (after - from) / 2.0 }
    }

    /// All intervals of one repeat.
    pub(super) fn pieces(&self) -> impl Iterator<Item = Piece> {
        (0..self.intervals()).map(|index| self.piece(index as isize))
    }
}

/// An interval in Hermite's form: both ends, and the derivatives there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    from: DVec3,
    to: DVec3,
    leaving: DVec3,
    arriving: DVec3,
}

impl Piece {
    /// The point of the interval at `u` in \[0, 1\].
    pub(super) fn at(&self, u: f64) -> DVec3 {
        let v = 1.0 - u;
        self.from * (v * v * (1.0 + 2.0 * u))
            + self.leaving * (v * v * u)
            + self.to * (u * u * (1.0 + 2.0 * v))
            - self.arriving * (u * u * v)
    }

    /// The derivative at `u`.
    pub(super) fn slope(&self, u: f64) -> DVec3 {
        (self.to - self.from) * (6.0 * u * (1.0 - u))
            + self.leaving * ((1.0 - u) * (1.0 - 3.0 * u))
            + self.arriving * (u * (3.0 * u - 2.0))
    }

    /// The second derivative at `u`.
    pub(super) fn bend(&self, u: f64) -> DVec3 {
        (self.to - self.from) * (6.0 - 12.0 * u)
            + self.leaving * (6.0 * u - 4.0)
            + self.arriving * (6.0 * u - 2.0)
    }

    /// The radius of curvature at `u`; 0 if the curve stands still there.
    pub(super) fn radius(&self, u: f64) -> f64 {
        let (slope, bend) = (self.slope(u), self.bend(u));
        let speed = slope.length();
        if speed == 0.0 { 0.0 } else { speed.powi(3) / slope.cross(bend).length() }
    }

    /// The length from 0 to the end of each of `parts` equal steps of u, by Simpson's rule on each
    /// step.
    pub(super) fn lengths(&self, parts: usize) -> Vec<f64> {
        let step = 1.0 / parts as f64;
        let speed = |at: f64| self.slope(at * step).length();
        let part = |k: usize| {
            let k = k as f64;
            (speed(k) + 4.0 * speed(k + 0.5) + speed(k + 1.0)) * step / 6.0
        };
        let mut sum = 0.0;
        (0..parts)
            .map(|k| {
                sum += part(k);
                sum
            })
            .collect()
    }
}
