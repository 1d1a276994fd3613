//! The cubic cardinal spline through the control points (the paper's equations 1 to 4).
//!
//! Everything is evaluated on differences from the interval's first point, which is added last: from absolute
//! coordinates the tangent of a yarn ten metres from the origin would be off by 3e-3 rad.

use std::ops::{Add, Mul, Sub};

use glam::Vec3;

use crate::ControlPoint;

/// The spline between `P[j]` and `P[j+1]`, as polynomials of t in \[0, 1\] relative to `P[j]`.
///
/// ```
/// use texere_core::{ControlPoint, Segment};
/// // Four points on a line, s = 1/2 (Catmull-Rom): the middle of the segment is the middle of the line.
/// let line = [0.0, 1.0, 2.0, 3.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
/// let sample = Segment::new(&line, 0.5).sample(0.5);
/// assert_eq!(sample.centre, [1.5, 0.0, 0.0].into());
/// assert_eq!(sample.tangent, [1.0, 0.0, 0.0].into());
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    start: Vec3,
    /// `P[j+1] - P[j]`: the offset at t = 1, free of rounding.
    span: Vec3,
    /// Coefficients of t, t², t³.
    position: [Vec3; 3],
    half_width: Size,
    half_height: Size,
    /// A squared velocity up to this counts as zero.
    at_rest: f32,
}

/// The spline at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Centre relative to the segment's first control point, mm.
    pub offset: Vec3,
    /// Centre, mm.
    pub centre: Vec3,
    /// Half the width, mm; always positive.
    pub half_width: f32,
    /// Half the height, mm; always positive.
    pub half_height: f32,
    /// Unit tangent.
    pub tangent: Vec3,
    /// The growth of the half width along the yarn (mm per mm), within ±[`SLOPE_LIMIT`].
    pub width_growth: f32,
    /// The growth of the half height, likewise.
    pub height_growth: f32,
}

/// A velocity whose square is below this share of the segment's squared size counts as zero.
///
/// Repeated points and cusps give exact zeros; the share (a millionth of the size) catches those that rounding moves a
/// little off zero, whose direction would be noise.
pub const ZERO_VELOCITY: f32 = 1e-12;

/// The squared length, mm², up to which a length counts as zero whatever the segment's size: 1e-15 mm. The squares of much
/// shorter ones leave the normal range of `f32`, and some devices flush them to zero.
pub const NO_LENGTH: f32 = 1e-30;

/// The steepest growth of a half width or half height that tilts a normal. At 1e4 the normal is within 1e-4 rad of the
/// axis, and the square of anything steeper would start to leave the range of `f32`.
pub const SLOPE_LIMIT: f32 = 1e4;

/// Half width and half height between two control points never fall below this share of the smaller one.
///
/// A spline overshoots: between a slub and a thin place it can dip below zero, where there is no tube.
pub const RADIUS_FLOOR: f32 = 0.5;

impl Segment {
    /// The segment between `points[1]` and `points[2]`, with `s = (1 - tension) / 2` (the paper's equation 2).
    #[must_use]
    #[inline]
    pub fn new(points: &[ControlPoint; 4], s: f32) -> Self {
        let [before, start, end, after] = points;
        let origin = start.position();
        let (a, b, c) = (before.position() - origin, end.position() - origin, after.position() - origin);
        let size = |half: fn(&ControlPoint) -> f32| Size::new([before, start, end, after].map(half), s);
        Self {
            start: origin,
            span: b,
            position: coefficients(a, b, c, s),
            half_width: size(ControlPoint::half_width),
            half_height: size(ControlPoint::half_height),
            at_rest: (ZERO_VELOCITY * (a.length_squared() + b.length_squared() + c.length_squared()))
                .max(NO_LENGTH),
        }
    }

    /// `P[j+1] - P[j]`, mm: the offset at the segment's end.
    #[must_use]
    #[inline]
    pub const fn span(&self) -> Vec3 {
        self.span
    }

    /// The spline at `t` in \[0, 1\].
    ///
    /// Where the velocity vanishes the tangent is the direction that the yarn takes right after (right before, at
    /// t = 1, a yarn's end): the first derivative that does not vanish, and +x where all do.
    #[must_use]
    #[inline]
    pub fn sample(&self, t: f32) -> Sample {
        let [c1, c2, c3] = self.position;
        let offset = (c1 + (c2 + c3 * t) * t) * t;
        let velocity = c1 + (c2 * 2.0 + c3 * (3.0 * t)) * t;
        let speed_squared = velocity.length_squared();
        let (tangent, inverse) = if speed_squared > self.at_rest {
            let inverse = 1.0 / speed_squared.sqrt();
            (velocity * inverse, inverse)
        } else {
            // Where the yarn does not move nothing grows along it.
            (self.direction_at_rest(t), 0.0)
        };
        let (half_width, width_growth) = self.half_width.sample(t, inverse);
        let (half_height, height_growth) = self.half_height.sample(t, inverse);
        Sample {
            offset,
            centre: self.start + offset,
            half_width,
            half_height,
            tangent,
            width_growth,
            height_growth,
        }
    }

    /// The tangent where the velocity vanishes: the limit from the right, or from the left at t = 1.
    fn direction_at_rest(&self, t: f32) -> Vec3 {
        let [_, c2, c3] = self.position;
        let acceleration = (c2 + c3 * (3.0 * t)) * 2.0;
        let jerk = c3 * 6.0;
        let side = if t < 1.0 { 1.0 } else { -1.0 };
        if acceleration.length_squared() > self.at_rest {
            acceleration * (side / acceleration.length_squared().sqrt())
        } else if jerk.length_squared() > self.at_rest {
            jerk * (1.0 / jerk.length_squared().sqrt())
        } else {
            Vec3::X
        }
    }
}

/// What goes with t, t² and t³ between a point and the next, at `b` from it, with the one before at `a` and the one after
/// next at `c`.
#[inline]
pub(crate) fn coefficients<T>(a: T, b: T, c: T, s: f32) -> [T; 3]
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>,
{
    [(b - a) * s, a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s, (c - a) * s + b * (s - 2.0)]
}

/// A half width or half height between two control points, as a polynomial of t.
#[derive(Debug, Clone, Copy)]
struct Size {
    start: f32,
    /// Coefficients of t, t², t³.
    terms: [f32; 3],
    floor: f32,
}

impl Size {
    #[inline]
    fn new([before, start, end, after]: [f32; 4], s: f32) -> Self {
        let (a, b, c) = (before - start, end - start, after - start);
        Self { start, terms: coefficients(a, b, c, s), floor: start.min(end) * RADIUS_FLOOR }
    }

    /// The size at `t` and its growth along the yarn, where `inverse` is one over the spline's speed.
    #[inline]
    fn sample(&self, t: f32, inverse: f32) -> (f32, f32) {
        let [r1, r2, r3] = self.terms;
        let size = self.start + (r1 + (r2 + r3 * t) * t) * t;
        let growth = (r1 + (r2 * 2.0 + r3 * (3.0 * t)) * t) * inverse;
        if size < self.floor { (self.floor, 0.0) } else { (size, growth.clamp(-SLOPE_LIMIT, SLOPE_LIMIT)) }
    }
}
