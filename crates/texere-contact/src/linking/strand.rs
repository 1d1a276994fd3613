//! One yarn in one of its shapes: a curve that ends, closes up or goes on as the yarn's [`Ends`]
//! say.

use glam::{DVec3, Vec3A};
use texere_core::{ControlPoint, Ends};

/// One yarn in one of its shapes. If the yarn is closed or repeats, its intervals are counted on
/// past its last control point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strand<'a> {
    pub(super) points: &'a [ControlPoint],
    pub(super) ends: Ends,
    /// The vector from a control point to its copy in the yarn's next round, mm.
    pub(super) onward: DVec3,
    /// The factor of the spline's tangents.
    pub(super) s: f64,
}

/// The corners of an interval's Bézier polygon, whose hull holds the centreline. They are in single
/// precision, which is enough for finding out what may have passed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hull([Vec3A; 4]);

impl Strand<'_> {
    fn point(&self, index: i64) -> DVec3 {
        let count = self.points.len() as i64;
        let own = |index: i64| self.points[index as usize].position().as_dvec3();
        match self.ends {
            _ if (0..count).contains(&index) => own(index),
            Ends::Open if index < 0 => 2.0 * own(0) - own(1),
            Ends::Open => 2.0 * own(count - 1) - own(count - 2),
            Ends::Closed | Ends::Repeats(_) => {
                own(index.rem_euclid(count)) + self.onward * index.div_euclid(count) as f64
            }
        }
    }

    /// The four control points that an interval depends on.
    fn window(&self, interval: i64) -> [DVec3; 4] {
        [-1, 0, 1, 2].map(|step| self.point(interval + step))
    }

    pub(super) fn hull(&self, interval: usize) -> Hull {
        let [before, start, end, after] =
            match self.points.get(interval.wrapping_sub(1)..interval.wrapping_add(3)) {
                Some(&[before, start, end, after]) => {
                    [before, start, end, after].map(|point| point.position().into())
                }
                _ => self.window(interval as i64).map(DVec3::as_vec3a),
            };
        let third = self.s as f32 / 3.0;
        Hull([start, start + (end - before) * third, end - (after - start) * third, end])
    }

    /// The larger of an interval's half widths and half heights at its ends, mm.
    pub(super) fn half(&self, interval: usize) -> f32 {
        let ends = [interval, (interval + 1) % self.points.len()].map(|index| self.points[index]);
        ends.iter().map(|point| point.half_width().max(point.half_height())).fold(0.0, f32::max)
    }

    /// The centreline at `way` intervals from the first control point. An open yarn stops at its
    /// ends.
    pub(super) fn at(&self, way: f64) -> DVec3 {
        let last = match self.ends {
            Ends::Open => self.points.len() as f64 - 2.0,
            Ends::Closed | Ends::Repeats(_) => f64::INFINITY,
        };
        let interval = way.floor().min(last);
        let ([before, start, end, after], t) = (self.window(interval as i64), way - interval);
        let (leaving, arriving, span) = ((end - before) * self.s, (after - start) * self.s, end - start);
        let bend = 3.0 * span - 2.0 * leaving - arriving;
        start + (leaving + (bend + (leaving + arriving - 2.0 * span) * t) * t) * t
    }

    /// The length of the chords from one control point to a later one, mm.
    pub(super) fn way(&self, from: i64, to: i64) -> f64 {
        (from..to).map(|index| self.point(index).distance(self.point(index + 1))).sum()
    }

    /// Number of intervals from `from` to `to` along one yarn, by the shorter way round a closed
    /// yarn. `to` is on a copy of the yarn that is moved by `moved` whole repeats. None if that
    /// copy is not a continuation of the yarn, but counts as another yarn.
    pub(super) fn gap(&self, from: usize, to: usize, moved: [f64; 2]) -> Option<f64> {
        let (ahead, count) = (to as f64 - from as f64, self.points.len() as f64);
        match self.ends {
            Ends::Open => (moved == [0.0; 2]).then_some(ahead.abs()),
            Ends::Closed => (moved == [0.0; 2]).then(|| ahead.abs().min(count - ahead.abs())),
            Ends::Repeats(step) => {
                let step = step.map(f64::from);
                let rounds = if step[0] == 0.0 { moved[1] / step[1] } else { moved[0] / step[0] };
                let along = rounds.fract() == 0.0 && step.map(|each| each * rounds) == moved;
                along.then(|| (ahead + rounds * count).abs())
            }
        }
    }
}

impl Hull {
    /// The lowest and the highest coordinates of the hull.
    pub(super) fn bounds(&self) -> [Vec3A; 2] {
        let [a, b, c, d] = self.0;
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    }

    /// The interval's start, middle and end: the corners of two chords that represent the interval.
    pub(super) fn chords(&self) -> [Vec3A; 3] {
        let [start, leaving, arriving, end] = self.0;
        [start, (start + end + (leaving + arriving) * 3.0) / 8.0, end]
    }

    /// Upper bound of the centreline's distance from [`Self::chords`], mm: an eighth of the largest
    /// second derivative, times the square of half the interval.
    pub(super) fn sagitta(&self) -> f32 {
        let [start, leaving, arriving, end] = self.0;
        let bend = |a: Vec3A, b: Vec3A, c: Vec3A| (a - 2.0 * b + c).length_squared();
        6.0 / 32.0 * bend(start, leaving, arriving).max(bend(leaving, arriving, end)).sqrt()
    }
}
