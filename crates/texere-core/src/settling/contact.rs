//! Where two intervals come near one another.

use glam::{IVec3, Vec3};

use super::{Interval, Scale};

/// A straight piece of an interval, by which neighbours are found.
#[derive(Debug, Clone, Copy)]
pub struct Chord {
    /// Where it begins, units.
    pub at: IVec3,
    /// From its beginning to its end, mm.
    pub span: Vec3,
}

impl Chord {
    /// Chord `piece` of `pieces` of an interval.
    #[must_use]
    #[inline]
    pub fn new(interval: &Interval, piece: u32, pieces: u32, scale: &Scale) -> Self {
        let offset = |piece: u32| interval.offset(piece as f32 / pieces as f32);
        let from = offset(piece);
        Self { at: interval.start.wrapping_add(scale.step(from)), span: offset(piece + 1) - from }
    }

    /// Its middle, units.
    #[must_use]
    #[inline]
    pub fn middle(&self, scale: &Scale) -> IVec3 {
        self.at.wrapping_add(scale.step(self.span * 0.5))
    }

    /// Where this chord and one that begins `way` from its beginning come nearest to one another:
    /// shares of both.
    #[must_use]
    #[inline]
    pub fn nearest(&self, other: &Self, way: Vec3) -> [f32; 2] {
        let (a, e) = (self.span.length_squared().max(SHORT), other.span.length_squared().max(SHORT));
        let b = self.span.dot(other.span);
        let (c, f) = (-self.span.dot(way), -other.span.dot(way));
        let determinant = a * e - b * b;
        // Of parallel chords one place does as well as another.
        let first = if determinant > PARALLEL * (a * e) { share((b * f - c * e) / determinant) } else { 0.5 };
        let second = share((b * first + f) / e);
        [share((b * second - c) / a), second]
    }
}

/// The least squared length that a chord or a velocity is taken to have, mm²: its square is still a
/// normal number.
pub const SHORT: f32 = 1e-15;

/// The squared sine of the angle below which two chords are parallel.
pub const PARALLEL: f32 = 1e-6;

/// The least that Newton's method takes the second derivative of the squared distance for, over the
/// squared velocity; and the least of the determinant, over the product of both.
pub const STIFF: f32 = 0.2;
/// See [`STIFF`].
pub const SKEW: f32 = 0.05;

/// Up to that distance two places are one, mm.
pub const ONE_PLACE: f32 = 1e-9;

/// Within 0 and 1; -0 becomes 0, as it does in vectors.
#[allow(clippy::manual_clamp, reason = "clamp keeps -0")]
#[inline]
pub(super) fn share(value: f32) -> f32 {
    value.max(0.0).min(1.0)
}

/// How much further than where they touch two yarns may be from one another for their nearest
/// places to be worked out.
pub const NEAR: f32 = 1.1;

/// How much thicker than they are yarns come to rest, so that they are clear when settling ends.
pub const MARGIN: f32 = 1.002;

/// Where two intervals come near one another.
#[derive(Debug, Clone, Copy)]
pub struct Approach {
    /// Places on either interval.
    pub at: [f32; 2],
    /// The way from the first interval's place to the other's, mm.
    pub way: Vec3,
    /// Its length, mm.
    pub distance: f32,
}

/// Two intervals, the second of which begins `way` from where the first does.
#[derive(Debug, Clone, Copy)]
pub struct Pair<'a> {
    /// Both intervals.
    pub intervals: [&'a Interval; 2],
    /// From the first one's beginning to the second one's, mm.
    pub way: Vec3,
}

impl Pair<'_> {
    fn at(&self, at: [f32; 2]) -> Approach {
        let [one, other] = self.intervals;
        let way = self.way + other.offset(at[1]) - one.offset(at[0]);
        Approach { at, way, distance: way.length_squared().sqrt() }
    }

    /// The exact places near `at`: one step of Newton's method of at most `stride`, where that
    /// comes nearer.
    ///
    /// On chords alone yarns seem clear that are not: 0.998 of what they need where the spline has
    /// 0.92.
    #[must_use]
    #[inline]
    pub fn refined(&self, at: [f32; 2], stride: [f32; 2]) -> Approach {
        let start = self.at(at);
        let [one, other] = self.intervals;
        let velocities = [one.velocity(at[0]), other.velocity(at[1])];
        let squares = velocities.map(|velocity| velocity.length_squared());
        let slopes = [-start.way.dot(velocities[0]), start.way.dot(velocities[1])];
        let bends = [-start.way.dot(one.acceleration(at[0])), start.way.dot(other.acceleration(at[1]))];
        let h = [0, 1].map(|side| (squares[side] + bends[side]).max(STIFF * squares[side]).max(SHORT));
        let mixed = -velocities[0].dot(velocities[1]);
        let determinant = (h[0] * h[1] - mixed * mixed).max(SKEW * (h[0] * h[1]));
        let step = [
            (mixed * slopes[1] - h[1] * slopes[0]) / determinant,
            (mixed * slopes[0] - h[0] * slopes[1]) / determinant,
        ];
        let next = [0, 1].map(|side| share(at[side] + step[side].max(-stride[side]).min(stride[side])));
        let found = self.at(next);
        if found.distance < start.distance { found } else { start }
    }
}

impl Approach {
    /// The direction from the first interval's place to the other's. Where both are one, it is
    /// square to both yarns: the other's view of it is then the opposite one.
    #[must_use]
    #[inline]
    pub fn direction(&self, velocities: [Vec3; 2]) -> Vec3 {
        let square = velocities[0].cross(velocities[1]);
        let way = if self.distance > ONE_PLACE { self.way } else { square };
        let length = way.length_squared();
        if length > 0.0 { way * (1.0 / length.sqrt()) } else { Vec3::Z }
    }
}
