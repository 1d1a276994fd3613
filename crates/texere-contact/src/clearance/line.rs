//! The control intervals of yarns.

use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::Range;

use glam::{DVec3, Vec3, Vec3A, Vec4};
use rayon::prelude::*;
use texere_core::definitions::neighbours;
use texere_core::{ControlPoint, YarnPlace, Yarns};

use super::contact::CLEARANCE_NEAR;
use super::interval::Cubic;
use super::support::Support;
use crate::grid::Bounds;

/// The most intervals ahead for which a yarn is tested to lead straight on.
const LEAD: usize = 3;

/// Number of control points from one entry of [`ways`] to the next: a stride. With half the value,
/// and with twice, no test is red.
const STRIDE: usize = 64;

const _: () = assert!(FRAC_1_SQRT_2 * std::f64::consts::FRAC_PI_2 > CLEARANCE_NEAR);

/// One yarn. An interval's number is that of the control point that it starts from, counted over
/// the fabric.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) yarn: usize,
    pub(super) support: &'a Support,
    /// Number of the yarn's first control point in the fabric.
    first: usize,
    points: &'a [ControlPoint],
    /// Up directions of the control points, if the yarn has any.
    ups: Option<&'a [Vec3]>,
    closed: bool,
    /// The factor of the spline's tangents.
    s: f64,
    ways: &'a [f64],
}

/// Way along the chords from the fabric's first control point to every 64th control point, mm. The
/// ways of consecutive yarns are added as if they were one yarn. The way between two points of a
/// yarn is the difference of two entries, plus a few chords.
pub(super) fn ways(points: &[ControlPoint]) -> Vec<f64> {
    let stride = |start: usize| -> f64 {
        let chords = points[start..points.len().min(start + STRIDE + 1)].windows(2);
        chords.map(|ends| f64::from(ends[0].position().distance(ends[1].position()))).sum()
    };
    let mut ways: Vec<f64> =
        (0..points.len().div_ceil(STRIDE)).into_par_iter().map(|k| stride(k * STRIDE)).collect();
    let mut way = 0.0;
    for stride in &mut ways {
        (way, *stride) = (way + *stride, way);
    }
    ways
}

/// Consecutive intervals of one yarn.
#[derive(Debug, Clone)]
pub(super) struct Span<'a> {
    pub(super) line: Line<'a>,
    pub(super) points: Range<usize>,
}

impl<'a> Line<'a> {
    /// Yarn number `yarn`, whose section reaches as far as `support` says. `s` is the factor of the
    /// spline's tangents, and `ways` are those of the fabric, from [`ways`].
    pub(super) fn new(yarns: &'a Yarns, yarn: usize, support: &'a Support, s: f64, ways: &'a [f64]) -> Self {
        let own = yarns.range(yarn).unwrap_or_default();
        Self {
            yarn,
            support,
            first: own.start,
            ups: yarns.layout().ups(yarn),
            points: yarns.yarn_points(yarn).unwrap_or(&[]),
            closed: yarns.layout().yarns()[yarn].closed,
            s,
            ways,
        }
    }

    /// Numbers of all intervals of the yarn.
    pub(super) fn intervals(&self) -> Range<usize> {
        let count = self.points.len();
        self.first..self.first + if self.closed { count } else { count.saturating_sub(1) }
    }

    /// All intervals of the yarn in order, in spans of `most` at most.
    pub(super) fn spans(self, most: usize) -> impl Iterator<Item = Span<'a>> {
        let all = self.intervals();
        let starts = all.clone().step_by(most);
        starts.map(move |start| Span { line: self, points: start..(start + most).min(all.end) })
    }

    /// Whether control point `point` belongs to the yarn.
    pub(super) fn holds(&self, point: usize) -> bool {
        (self.first..self.first + self.points.len()).contains(&point)
    }

    /// Whether an interval begins at the cut end of an open yarn, and whether it ends at one.
    pub(super) fn cut(&self, point: usize) -> [bool; 2] {
        let all = self.intervals();
        [!self.closed && point == all.start, !self.closed && point + 1 == all.end]
    }

    /// The four control points of an interval.
    pub(super) fn window(&self, point: usize) -> [ControlPoint; 4] {
        neighbours(self.points, self.closed, point - self.first)
    }

    /// The four control points of the interval after interval `point`, if the yarn goes on.
    pub(super) fn window_after(&self, point: usize) -> Option<[ControlPoint; 4]> {
        let ends = !self.closed && point + 1 == self.intervals().end;
        (!ends).then(|| neighbours(self.points, self.closed, point + 1 - self.first))
    }

    pub(super) fn cubic(&self, point: usize) -> Cubic {
        let cubic = Cubic::new(self.window(point), self.s);
        let Some(ups) = self.ups else { return cubic };
        let own = point - self.first;
        cubic.with_ups([own, (own + 1) % ups.len()].map(|point| ups[point]))
    }

    /// A box that holds all places no further from an interval than `margin` times the section's
    /// reach.
    ///
    /// The box serves to find neighbours. It is in single precision, and a little too large.
    #[inline]
    pub(super) fn bounds(&self, point: usize, margin: f64) -> Bounds {
        let [before, start, end, after] = neighbours(self.points, self.closed, point - self.first);
        // The points are converted one by one, because a map over the array is not inlined in this
        // innermost loop.
        let whole = |point: ControlPoint| Vec4::new(point.x, point.y, point.z, point.half_width());
        let heights = [before, start, end, after].map(|point| point.half_height());
        let (before, start, end, after) = (whole(before), whole(start), whole(end), whole(after));
        // The Bézier polygon holds the curve and its half widths. The polygon's inner two corners
        // may lie outside the box of its ends, on any side.
        let s = self.s as f32 / 3.0;
        let (leaving, arriving) = (start + (end - before) * s, end - (after - start) * s);
        let (low, high) =
            (start.min(end).min(leaving).min(arriving), start.max(end).max(leaving).max(arriving));
        let [before, start, end, after] = heights;
        let highest = start.max(end).max(start + (end - before) * s).max(end - (after - start) * s);
        let margin =
            (margin * self.support.extent()) as f32 * high.w.max(highest) * (1.0 + 8.0 * f32::EPSILON);
        let margin = Vec4::splat(margin) + 8.0 * f32::EPSILON * low.abs().max(high.abs());
        Bounds { low: Vec3A::from_vec4(low - margin), high: Vec3A::from_vec4(high + margin) }
    }

    /// Whether the yarn leads on so straight from one interval to a later one that the two touch at
    /// most at a common control point.
    ///
    /// The test is whether the tangents lie within 45 degrees of one direction. Then no part of the
    /// yarn leads back. Two places that lie π/2 times their reach apart along the yarn are more
    /// than [`CLEARANCE_NEAR`] times their reach apart in space, whatever the section.
    pub(super) fn leads_on(&self, from: usize, to: usize) -> bool {
        if to - from > LEAD {
            return false;
        }
        let cubics: [Option<Cubic>; LEAD + 1] =
            std::array::from_fn(|step| (from + step <= to).then(|| self.cubic(from + step)));
        let cubics = cubics.iter().flatten();
        let forward: DVec3 = cubics.clone().map(|cubic| cubic.position(1.0) - cubic.position(0.0)).sum();
        let forward = forward.normalize_or_zero();
        let onward = |step: DVec3| step.dot(forward) >= FRAC_1_SQRT_2 * step.length();
        cubics.flat_map(Cubic::velocities).all(onward)
    }

    /// Whether two places of the yarn are less than `window` apart along its chords: `s` of
    /// interval `from`, and `t` of a later interval `to`.
    pub(super) fn within(&self, window: f64, (from, s): (usize, f64), (to, t): (usize, f64)) -> bool {
        let forward = |(from, s): (usize, f64), (to, t): (usize, f64)| {
            let (cubic, count, to_own) = (self.cubic(from), self.points.len(), to - self.first);
            let mut left = window - cubic.position(s).distance(cubic.position(1.0));
            let mut at = (from - self.first + 1) % count.max(1);
            // The sum ends as soon as it is large enough.
            while left > 0.0 && at != to_own {
                // The stride stops at the yarn's last point.
                let ahead = if at < to_own { to_own } else { count - 1 };
                if let Some((way, stride_end)) = self.strides(at, ahead) {
                    left -= way;
                    at = stride_end;
                    continue;
                }
                let next = (at + 1) % count;
                left -= f64::from(self.points[at].position().distance(self.points[next].position()));
                if next == 0 && !self.closed {
                    return false;
                }
                at = next;
            }
            let cubic = self.cubic(to);
            left > cubic.position(0.0).distance(cubic.position(t))
        };
        forward((from, s), (to, t)) || (self.closed && forward((to, t), (from, s)))
    }

    /// The way over whole strides from the yarn's point `at` towards its point `ahead`, and the
    /// point at which the strides end. None if no whole stride begins at `at`.
    fn strides(&self, at: usize, ahead: usize) -> Option<(f64, usize)> {
        let (from, to) = (self.first + at, (self.first + ahead) / STRIDE);
        let starts = from % STRIDE == 0 && from / STRIDE < to;
        starts.then(|| (self.ways[to] - self.ways[from / STRIDE], to * STRIDE - self.first))
    }

    /// The place at `t` of an interval. `sources` are the sources of the fabric's control points.
    pub(super) fn place(&self, point: usize, t: f64, sources: Option<&[u32]>) -> YarnPlace {
        let interval = point - self.first;
        let nearer = if t < 0.5 { interval } else { (interval + 1) % self.points.len() };
        let source = sources.and_then(|sources| sources.get(self.first + nearer)).copied();
        let position = self.cubic(point).position(t).to_array();
        YarnPlace { yarn: self.yarn, interval, t, position, source }
    }
}
