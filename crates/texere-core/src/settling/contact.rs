//! The nearest places of two intervals.

use glam::{IVec3, Vec3};

use super::{Interval, Scale};

/// A chord: a straight piece of an interval. The search for neighbours compares chords.
#[derive(Debug, Clone, Copy)]
pub struct Chord {
    /// The chord's start, units.
    pub at: IVec3,
    /// The vector from the chord's start to its end, mm.
    pub span: Vec3,
}

impl Chord {
    /// Chord number `piece`, counted from 0, of the `pieces` chords of an interval.
    #[must_use]
    #[inline]
    pub fn new(interval: &Interval, piece: u32, pieces: u32, scale: &Scale) -> Self {
        let offset = |piece: u32| interval.offset(piece as f32 / pieces as f32);
        let from = offset(piece);
        Self { at: interval.start.wrapping_add(scale.step(from)), span: offset(piece + 1) - from }
    }

    /// The chord's middle, units.
    #[must_use]
    #[inline]
    pub fn middle(&self, scale: &Scale) -> IVec3 {
        self.at.wrapping_add(scale.step(self.span * 0.5))
    }

    /// The nearest places of this chord and the `other`, as shares of both chords. `way` is the
    /// vector from the start of this chord to that of the other, mm.
    #[must_use]
    #[inline]
    pub fn nearest(&self, other: &Self, way: Vec3) -> [f32; 2] {
        let (a, e) = (self.span.length_squared().max(SHORT), other.span.length_squared().max(SHORT));
        let b = self.span.dot(other.span);
        let (c, f) = (-self.span.dot(way), -other.span.dot(way));
        let determinant = a * e - b * b;
        // On parallel chords many places are equally near, so the middle is tried.
        let first = if determinant > PARALLEL * (a * e) { share((b * f - c * e) / determinant) } else { 0.5 };
        let second = share((b * first + f) / e);
        [share((b * second - c) / a), second]
    }
}

/// The least squared length of a chord or a velocity, mm². Shorter ones count as this long. The
/// square of this number is still a normal number.
pub const SHORT: f32 = 1e-15;

/// The squared sine of the angle below which two chords count as parallel.
pub const PARALLEL: f32 = 1e-6;

/// The least second derivative of the squared distance in Newton's method, as a share of the
/// squared velocity.
pub const STIFF: f32 = 0.2;
/// The least determinant in Newton's method, as a share of the product of both second derivatives.
/// With twice the value, `a_settled_repeat_fits_its_copies` is red; with half, no test is.
pub const SKEW: f32 = 0.05;

/// The distance up to which two places count as one, mm. With half the value, and with twice, no
/// test is red.
pub const ONE_PLACE: f32 = 1e-9;

/// The value clamped to between 0 and 1. -0 becomes 0, as it does in vector code.
#[allow(clippy::manual_clamp, reason = "clamp keeps -0")]
#[inline]
pub(super) fn share(value: f32) -> f32 {
    value.max(0.0).min(1.0)
}

/// The distance of two chords up to which the nearest places on the splines are worked out, as a
/// multiple of the distance at which the two yarns touch. With half its difference to 1,
/// `copies_of_a_repeat_that_settled_are_clear` is red; with twice, no test is.
pub const NEAR: f32 = 1.1;

/// The factor by which yarns count as thicker while they settle, so that they are clear when
/// settling ends. With half its difference to 1, and with twice, `a_settled_repeat_fits_its_copies`
/// is red.
pub const MARGIN: f32 = 1.002;

/// The nearest places of two intervals.
#[derive(Debug, Clone, Copy)]
pub(super) struct Approach {
    /// The parameters of the places on both intervals.
    pub(super) at: [f32; 2],
    /// The vector from the first interval's place to the second's, mm.
    pub(super) way: Vec3,
    /// The length of `way`, mm.
    pub(super) distance: f32,
}

/// Two intervals. The second begins `way` from the start of the first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<'a> {
    /// Both intervals.
    pub(super) intervals: [&'a Interval; 2],
    /// The vector from the start of the first interval to that of the second, mm.
    pub(super) way: Vec3,
}

impl Pair<'_> {
    fn at(&self, at: [f32; 2]) -> Approach {
        let [one, other] = self.intervals;
        let way = self.way + other.offset(at[1]) - one.offset(at[0]);
        Approach { at, way, distance: way.length_squared().sqrt() }
    }

    /// The nearest places on the splines near `at`, by one step of Newton's method of at most
    /// `stride`. If the step does not come nearer, the places are `at`.
    ///
    /// Chords alone make yarns seem clear that are not. They showed 0.998 of the distance that
    /// yarns need where the splines had 0.92.
    #[must_use]
    #[inline]
    pub(super) fn refined(&self, at: [f32; 2], stride: [f32; 2]) -> Approach {
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
    /// The direction from the first interval's place to the second's. If both places are one, the
    /// direction is at right angles to both yarns, and with the two intervals exchanged it is the
    /// opposite one. If the yarns are also parallel there, the direction is +z.
    #[must_use]
    #[inline]
    pub(super) fn direction(&self, velocities: [Vec3; 2]) -> Vec3 {
        let square = velocities[0].cross(velocities[1]);
        let way = if self.distance > ONE_PLACE { self.way } else { square };
        let length = way.length_squared();
        if length > 0.0 { way * (1.0 / length.sqrt()) } else { Vec3::Z }
    }
}
