//! One control interval of a yarn: its cubic in double precision.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3};
use texere_core::ControlPoint;
use texere_core::definitions::{RADIUS_FLOOR, up_between};

use super::support::upright;

/// The spline between two control points, as polynomials of t in \[0, 1\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubic {
    position: [DVec3; 4],
    /// Half width and half height.
    halves: [[f64; 4]; 2],
    floors: [f64; 2],
    /// The up directions of both ends, and the tangents there. None if the yarn has no up
    /// directions.
    ups: Option<[[DVec3; 2]; 2]>,
}

/// The cubic at one parameter: position, half width and half height, each with its first and second
/// derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    pub(super) position: DVec3,
    pub(super) velocity: DVec3,
    pub(super) acceleration: DVec3,
    pub(super) halves: [[f64; 3]; 2],
}

impl At {
    /// Half width and half height.
    pub(super) fn sizes(&self) -> DVec2 {
        DVec2::new(self.halves[0][0], self.halves[1][0])
    }

    /// The radius of a round yarn, with its derivatives.
    pub(super) const fn radius(&self) -> [f64; 3] {
        self.halves[0]
    }
}

impl Cubic {
    /// The interval between the middle two of four control points, with the factor `s` of the
    /// spline's tangents.
    pub(super) fn new([before, start, end, after]: [ControlPoint; 4], s: f64) -> Self {
        let place = |point: ControlPoint| point.position().as_dvec3();
        let (p, q, r, u) = (place(before), place(start), place(end), place(after));
        let (m0, m1) = ((r - p) * s, (u - q) * s);
        let sizes = [ControlPoint::half_width, ControlPoint::half_height]
            .map(|half| [before, start, end, after].map(|point| f64::from(half(&point))));
        Self {
            position: [q, m0, 3.0 * (r - q) - 2.0 * m0 - m1, 2.0 * (q - r) + m0 + m1],
            halves: sizes.map(|[p, q, r, u]| {
                let (m0, m1) = ((r - p) * s, (u - q) * s);
                [q, m0, 3.0 * (r - q) - 2.0 * m0 - m1, 2.0 * (q - r) + m0 + m1]
            }),
            floors: sizes.map(|[_, start, end, _]| start.min(end) * f64::from(RADIUS_FLOOR)),
            ups: None,
        }
    }

    /// This interval with the up directions of both ends.
    pub(super) fn with_ups(self, ups: [Vec3; 2]) -> Self {
        let tangents = [0.0, 1.0].map(|t| self.path(t)[1].normalize_or(DVec3::X));
        Self { ups: Some([ups.map(Vec3::as_dvec3), tangents]), ..self }
    }

    /// Side and up of the frame along which the yarn is flattened at `t`. `tangent` is the tangent
    /// at `t`.
    pub(super) fn frame(&self, t: f64, tangent: DVec3) -> [DVec3; 2] {
        let up = self.ups.map(|[ups, tangents]| up_between(ups, tangents, tangent, t.clamp(0.0, 1.0)));
        match up.filter(|up| *up != DVec3::ZERO) {
            Some(up) => [up.cross(tangent), up],
            None => upright(tangent),
        }
    }

    /// The angle from the upright frame at `t` to the interval's own frame at `t`, turns.
    pub(super) fn lean(&self, t: f64, tangent: DVec3) -> f64 {
        if self.ups.is_none() {
            return 0.0;
        }
        let ([side, up], [own, _]) = (upright(tangent), self.frame(t, tangent));
        own.dot(up).atan2(own.dot(side)) / TAU
    }

    pub(super) fn position(&self, t: f64) -> DVec3 {
        let [c0, c1, c2, c3] = self.position;
        c0 + (c1 + (c2 + c3 * t) * t) * t
    }

    /// Position, first and second derivative.
    pub(super) fn path(&self, t: f64) -> [DVec3; 3] {
        let [_, c1, c2, c3] = self.position;
        [self.position(t), c1 + (2.0 * c2 + 3.0 * c3 * t) * t, 2.0 * c2 + 6.0 * c3 * t]
    }

    /// Half width and half height.
    pub(super) fn sizes(&self, t: f64) -> DVec2 {
        let half = |[r0, r1, r2, r3]: [f64; 4]| r0 + (r1 + (r2 + r3 * t) * t) * t;
        DVec2::from_array(self.halves.map(half)).max(DVec2::from_array(self.floors))
    }

    pub(super) fn at(&self, t: f64) -> At {
        let half = |side: usize| {
            let ([r0, r1, r2, r3], floor) = (self.halves[side], self.floors[side]);
            let half = r0 + (r1 + (r2 + r3 * t) * t) * t;
            if half < floor {
                [floor, 0.0, 0.0]
            } else {
                [half, r1 + (2.0 * r2 + 3.0 * r3 * t) * t, 2.0 * r2 + 6.0 * r3 * t]
            }
        };
        let [position, velocity, acceleration] = self.path(t);
        At { position, velocity, acceleration, halves: [half(0), half(1)] }
    }

    /// The interval's Bézier polygon, whose hull holds the curve.
    pub(super) fn hull(&self) -> [DVec3; 4] {
        let [c0, c1, c2, c3] = self.position;
        let end = c0 + c1 + c2 + c3;
        [c0, c0 + c1 / 3.0, end - (c1 + 2.0 * c2 + 3.0 * c3) / 3.0, end]
    }

    /// The Bernstein coefficients of the velocity, which stays within the triangle of these three
    /// vectors.
    pub(super) fn velocities(&self) -> [DVec3; 3] {
        let [_, c1, c2, c3] = self.position;
        [c1, c1 + c2, c1 + 2.0 * c2 + 3.0 * c3]
    }

    /// Whether the yarn is round all along the interval.
    pub(super) fn is_round(&self) -> bool {
        self.halves[0] == self.halves[1]
    }

    /// Whether the yarn is round and of one radius all along the interval.
    pub(super) fn is_even(&self) -> bool {
        self.is_round() && self.halves[0][1..] == [0.0; 3]
    }

    /// Half width and half height as Bernstein coefficients, before they are held at
    /// [`Self::floors`].
    pub(super) fn half_bounds(&self) -> [[f64; 4]; 2] {
        self.halves.map(|[r0, r1, r2, r3]| {
            let end = r0 + r1 + r2 + r3;
            [r0, r0 + r1 / 3.0, end - (r1 + 2.0 * r2 + 3.0 * r3) / 3.0, end]
        })
    }

    /// The least half width and half height that the interval may have.
    pub(super) const fn floors(&self) -> [f64; 2] {
        self.floors
    }

    /// Upper bound of half width and half height in the interval.
    pub(super) fn half_bound(&self) -> f64 {
        self.half_bounds().into_iter().flatten().chain(self.floors).fold(0.0, f64::max)
    }

    /// An upper bound of the interval's length, mm: the length of its Bézier polygon.
    pub(super) fn length(&self) -> f64 {
        self.hull().windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    }

    /// Upper bound of the interval's distance from the straight line between its ends, mm.
    pub(super) fn bend(&self) -> f64 {
        off_chord(self.hull())
    }

    /// Upper bound of the squared distance between the interval and `count` chords of equal steps
    /// of t, mm².
    pub(super) fn off_chords_squared(&self, count: usize) -> f64 {
        let [_, c1, c2, c3] = self.position;
        let step = 1.0 / count as f64;
        let mut most = 0.0_f64;
        let (mut start, mut leaving) = (self.position[0], c1 * step / 3.0);
        for k in 1..=count {
            let t = k as f64 * step;
            let (end, arriving) = (self.position(t), (c1 + (2.0 * c2 + 3.0 * c3 * t) * t) * step / 3.0);
            let chord = end - start;
            let apart = |corner: DVec3| {
                let along = share(corner.dot(chord), chord.length_squared());
                corner.distance_squared(chord * along)
            };
            most = most.max(apart(leaving)).max(apart(chord - arriving));
            (start, leaving) = (end, arriving);
        }
        // The inner two of the four Bézier weights add up to 3/4 at most; 0.5625 is the square of
        // 3/4.
        0.5625 * most
    }
}

/// Upper bound of the distance, at any parameter, between a curve of this Bézier polygon and the
/// chord between its ends, mm.
pub(super) fn off_chord([start, leaving, arriving, end]: [DVec3; 4]) -> f64 {
    // The inner two of the four Bézier weights add up to 3/4 at most.
    let one = (leaving - start.lerp(end, 1.0 / 3.0)).length_squared();
    let other = (arriving - start.lerp(end, 2.0 / 3.0)).length_squared();
    0.75 * one.max(other).sqrt()
}

/// Squared distance of two straight segments, and the parameters from 0 to 1 of their nearest
/// places.
///
/// **Source**: Ericson, "Real-time collision detection", Morgan Kaufmann 2005, section 5.1.9.
pub(super) fn closest([p, p_end]: [DVec3; 2], [q, q_end]: [DVec3; 2]) -> (f64, f64, f64) {
    let (along, other, apart) = (p_end - p, q_end - q, p - q);
    let (a, e, f) = (along.length_squared(), other.length_squared(), other.dot(apart));
    let (c, b) = (along.dot(apart), along.dot(other));
    let mut s = share(b * f - c * e, a * e - b * b);
    let mut t = share(b * s + f, e);
    // The best place on the other segment may lie beyond its end. Then the best place on the first
    // segment is the one for that end.
    s = share(b * t - c, a);
    t = share(b * s + f, e);
    ((p + along * s).distance_squared(q + other * t), s, t)
}

/// `over` / `under`, held between 0 and 1.
fn share(over: f64, under: f64) -> f64 {
    if under > 0.0 { (over / under).clamp(0.0, 1.0) } else { 0.0 }
}
