//! One control interval of a yarn: the cubic in double precision, its box, and chords along it.

use std::ops::Range;

use glam::{DVec3, Vec3A, Vec4};
use texere_core::{ControlPoint, RADIUS_FLOOR, Yarns};

use super::grid::Bounds;

/// The most chords that stand for an interval.
const CHORDS_MAX: usize = 12;

/// How far an interval may lie from its chords, in radii of its yarn: so little that every approach of two yarns is one
/// of their chords too, and that refinement starts where it converges.
pub(super) const SAGITTA: f64 = 0.1;

/// The spline between two control points, as polynomials of t in \[0, 1\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubic {
    position: [DVec3; 4],
    radius: [f64; 4],
    radius_floor: f64,
}

/// The cubic at one parameter: position, first and second derivative, and the radius with its derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    pub(super) position: DVec3,
    pub(super) velocity: DVec3,
    pub(super) acceleration: DVec3,
    pub(super) radius: [f64; 3],
}

impl Cubic {
    /// The interval between the middle two of four control points, with the factor `s` of the spline's tangents.
    pub(super) fn new([before, start, end, after]: [ControlPoint; 4], s: f64) -> Self {
        let [p, q, r, u] = [before, start, end, after].map(|point| point.position().as_dvec3());
        let [pr, qr, rr, ur] = [before, start, end, after].map(|point| f64::from(point.radius));
        let (m0, m1) = ((r - p) * s, (u - q) * s);
        let (n0, n1) = ((rr - pr) * s, (ur - qr) * s);
        Self {
            position: [q, m0, 3.0 * (r - q) - 2.0 * m0 - m1, 2.0 * (q - r) + m0 + m1],
            radius: [qr, n0, 3.0 * (rr - qr) - 2.0 * n0 - n1, 2.0 * (qr - rr) + n0 + n1],
            radius_floor: qr.min(rr) * f64::from(RADIUS_FLOOR),
        }
    }

    pub(super) fn position(&self, t: f64) -> DVec3 {
        let [c0, c1, c2, c3] = self.position;
        c0 + (c1 + (c2 + c3 * t) * t) * t
    }

    pub(super) fn at(&self, t: f64) -> At {
        let [_, c1, c2, c3] = self.position;
        let [r0, r1, r2, r3] = self.radius;
        let radius = r0 + (r1 + (r2 + r3 * t) * t) * t;
        let radius = if radius < self.radius_floor {
            [self.radius_floor, 0.0, 0.0]
        } else {
            [radius, r1 + (2.0 * r2 + 3.0 * r3 * t) * t, 2.0 * r2 + 6.0 * r3 * t]
        };
        At {
            position: self.position(t),
            velocity: c1 + (2.0 * c2 + 3.0 * c3 * t) * t,
            acceleration: 2.0 * c2 + 6.0 * c3 * t,
            radius,
        }
    }

    /// The interval's Bézier polygon, whose hull holds the curve.
    pub(super) fn hull(&self) -> [DVec3; 4] {
        let [c0, c1, c2, c3] = self.position;
        let end = c0 + c1 + c2 + c3;
        [c0, c0 + c1 / 3.0, end - (c1 + 2.0 * c2 + 3.0 * c3) / 3.0, end]
    }

    /// Three vectors in whose triangle the velocity stays: its Bernstein coefficients.
    pub(super) fn velocities(&self) -> [DVec3; 3] {
        let [_, c1, c2, c3] = self.position;
        [c1, c1 + c2, c1 + 2.0 * c2 + 3.0 * c3]
    }

    /// Whether the radius stays what it is.
    pub(super) fn is_even(&self) -> bool {
        self.radius[1..] == [0.0; 3]
    }

    /// The radius as Bernstein coefficients, before it is held at [`Self::radius_floor`].
    pub(super) fn radii(&self) -> [f64; 4] {
        let [r0, r1, r2, r3] = self.radius;
        let end = r0 + r1 + r2 + r3;
        [r0, r0 + r1 / 3.0, end - (r1 + 2.0 * r2 + 3.0 * r3) / 3.0, end]
    }

    /// The least radius that the interval may have.
    pub(super) const fn radius_floor(&self) -> f64 {
        self.radius_floor
    }

    /// No less than the radius anywhere in the interval.
    pub(super) fn radius_bound(&self) -> f64 {
        self.radii().into_iter().fold(self.radius_floor, f64::max)
    }

    /// How far the interval lies from the straight line between its ends at most, mm.
    pub(super) fn bend(&self) -> f64 {
        let [start, leaving, arriving, end] = self.hull();
        // The inner two of the four Bézier weights add up to 3/4 at most.
        let one = (leaving - start.lerp(end, 1.0 / 3.0)).length_squared();
        let other = (arriving - start.lerp(end, 2.0 / 3.0)).length_squared();
        0.75 * one.max(other).sqrt()
    }

    /// The largest second derivative, mm.
    fn acceleration(&self) -> f64 {
        let [_, _, c2, c3] = self.position;
        (2.0 * c2).length_squared().max((2.0 * c2 + 6.0 * c3).length_squared()).sqrt()
    }

    /// Chords that lie within [`SAGITTA`] of the curve (as far as [`CHORDS_MAX`] of them do).
    pub(super) fn chords(&self) -> Chords {
        // A curve lies within an eighth of its largest second derivative of its chord, n chords within 1/n² of that.
        let wanted =
            (self.acceleration() / 8.0 / (SAGITTA * self.radius_floor.max(f64::MIN_POSITIVE))).sqrt().ceil();
        let count = (wanted as usize).clamp(1, CHORDS_MAX);
        let mut corners = [self.position[0]; CHORDS_MAX + 1];
        for (k, corner) in corners.iter_mut().enumerate().take(count + 1).skip(1) {
            *corner = self.position(k as f64 / count as f64);
        }
        Chords { corners, count }
    }
}

/// A polygon along an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chords {
    corners: [DVec3; CHORDS_MAX + 1],
    count: usize,
}

impl Chords {
    /// Calls `start` with the parameters of two intervals at which their chords come nearest to one another, for each
    /// pair of chords nearer than all pairs beside it, and nearer than `within`.
    pub(super) fn approaches(&self, other: &Self, within: f64, mut start: impl FnMut(f64, f64)) {
        let (rows, columns) = (self.count, other.count);
        let mut near = [f64::INFINITY; CHORDS_MAX * CHORDS_MAX];
        for row in 0..rows {
            let one = self.chord(row);
            for column in 0..columns {
                let two = other.chord(column);
                // Twice the distance of the middles, and twice what both could reach from there.
                let apart = (one[0] + one[1] - two[0] - two[1]).length_squared();
                let reach = 2.0 * within + one[0].distance(one[1]) + two[0].distance(two[1]);
                if apart <= reach * reach {
                    near[row * columns + column] = closest(one, two).0;
                }
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let own = row * columns + column;
                if near[own] > within * within {
                    continue;
                }
                let beside = (row.saturating_sub(1)..(row + 2).min(rows)).flat_map(|r| {
                    (column.saturating_sub(1)..(column + 2).min(columns)).map(move |c| r * columns + c)
                });
                // Of two alike the first counts.
                if beside.into_iter().all(|place| (near[place], place) >= (near[own], own)) {
                    let (_, s, t) = closest(self.chord(row), other.chord(column));
                    start((row as f64 + s) / rows as f64, (column as f64 + t) / columns as f64);
                }
            }
        }
    }

    fn chord(&self, number: usize) -> [DVec3; 2] {
        [self.corners[number], self.corners[number + 1]]
    }
}

/// Squared distance of two straight segments, and where along each they are nearest, from 0 to 1.
///
/// **Source**: Ericson, "Real-time collision detection", Morgan Kaufmann 2005, section 5.1.9.
pub(super) fn closest([p, p_end]: [DVec3; 2], [q, q_end]: [DVec3; 2]) -> (f64, f64, f64) {
    let (along, other, apart) = (p_end - p, q_end - q, p - q);
    let (a, e, f) = (along.length_squared(), other.length_squared(), other.dot(apart));
    let share = |over: f64, under: f64| if under > 0.0 { (over / under).clamp(0.0, 1.0) } else { 0.0 };
    let (c, b) = (along.dot(apart), along.dot(other));
    let mut s = share(b * f - c * e, a * e - b * b);
    let mut t = share(b * s + f, e);
    // The other end's best place may lie off it; then the first one's best place for that end counts.
    s = share(b * t - c, a);
    t = share(b * s + f, e);
    ((p + along * s).distance_squared(q + other * t), s, t)
}

/// The four points that steer interval `first`, with the paper's virtual ends where an open yarn has none.
pub(crate) fn neighbours(points: &[ControlPoint], closed: bool, first: usize) -> [ControlPoint; 4] {
    if let Some(&[before, start, end, after]) = points.get(first.wrapping_sub(1)..first.wrapping_add(3)) {
        return [before, start, end, after];
    }
    let count = points.len();
    let at = |index: usize| points[index % count];
    let (start, end) = (at(first), at(first + 1));
    let before = if closed || first > 0 { at(first + count - 1) } else { start.reflected(&end) };
    let after = if closed || first + 2 < count { at(first + 2) } else { end.reflected(&start) };
    [before, start, end, after]
}

/// The box that holds whatever lies within `margin` radii of an interval's centreline.
///
/// It is for finding neighbours, in single precision and a little too large.
fn bounds(neighbours: [ControlPoint; 4], s: f32, margin: f32) -> Bounds {
    let [before, start, end, after] =
        neighbours.map(|point| Vec4::new(point.x, point.y, point.z, point.radius));
    // The Bézier polygon, of radii too; the inner two of its corners may lie on either side.
    let (leaving, arriving) = (start + (end - before) * (s / 3.0), end - (after - start) * (s / 3.0));
    let (low, high) = (start.min(end).min(leaving).min(arriving), start.max(end).max(leaving).max(arriving));
    let rounding = 8.0 * f32::EPSILON * low.abs().max(high.abs());
    let margin = Vec4::splat(margin * (1.0 + 4.0 * f32::EPSILON) * high.w) + rounding;
    Bounds { low: Vec3A::from_vec4(low - margin), high: Vec3A::from_vec4(high + margin) }
}

/// Intervals of one yarn that follow one another.
#[derive(Debug, Clone)]
pub(super) struct Span {
    pub(super) yarn: usize,
    /// Numbers of the control points that they start from.
    pub(super) points: Range<usize>,
}

/// All intervals of a fabric. An interval bears the number of the control point that it starts from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Intervals<'a> {
    pub(super) yarns: &'a Yarns,
    s: f64,
}

impl<'a> Intervals<'a> {
    pub(super) fn new(yarns: &'a Yarns, tension: f32) -> Self {
        Self { yarns, s: (1.0 - f64::from(tension)) / 2.0 }
    }

    /// All intervals in order, `most` at a time at most.
    pub(super) fn spans(&self, most: usize) -> Vec<Span> {
        let all = (0..self.yarns.layout().yarns().len()).flat_map(|yarn| {
            let (first, count, _) = self.of(yarn);
            let starts = (first..first + count).step_by(most);
            starts.map(move |start| Span { yarn, points: start..(start + most).min(first + count) })
        });
        all.collect()
    }

    /// The yarn that control point `point` belongs to, which is not before yarn `from`.
    pub(super) fn yarn(&self, point: usize, from: usize) -> usize {
        let offsets = self.yarns.layout().offsets();
        if offsets.get(from + 1).is_some_and(|&end| (point as u64) < end) {
            return from;
        }
        offsets.partition_point(|&start| start <= point as u64).saturating_sub(1)
    }

    /// A yarn's first control point, how many intervals it has, and whether it is closed.
    pub(super) fn of(&self, yarn: usize) -> (usize, usize, bool) {
        let range = self.yarns.range(yarn).unwrap_or(0..0);
        let closed = self.yarns.layout().yarns()[yarn].closed;
        (range.start, if closed { range.len() } else { range.len().saturating_sub(1) }, closed)
    }

    /// Interval `point`, which belongs to `yarn`.
    pub(super) fn cubic(&self, yarn: usize, point: usize) -> Cubic {
        Cubic::new(self.neighbours(yarn, point), self.s)
    }

    /// The box that holds whatever lies within `margin` radii of interval `point` of `yarn`.
    pub(super) fn bounds(&self, yarn: usize, point: usize, margin: f64) -> Bounds {
        bounds(self.neighbours(yarn, point), self.s as f32, margin as f32)
    }

    fn neighbours(&self, yarn: usize, point: usize) -> [ControlPoint; 4] {
        let closed = self.yarns.layout().yarns()[yarn].closed;
        let range = self.yarns.range(yarn).unwrap_or(0..0);
        neighbours(&self.yarns.points()[range.clone()], closed, point - range.start)
    }
}
