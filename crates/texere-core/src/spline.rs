//! The cubic cardinal spline through the control points (the paper's equations 1 to 4).
//!
//! Everything is evaluated on differences from the interval's first point, and that point is added
//! last. With absolute coordinates, the tangent of a yarn ten metres from the origin would be off
//! by 3e-3 rad.

use std::ops::{Add, Div, Mul, Sub};

use glam::Vec3;

use crate::ControlPoint;

/// The spline between `P[j]` and `P[j+1]`, as polynomials of t in \[0, 1\] relative to `P[j]`.
///
/// ```
/// use texere_core::definitions::Segment;
/// use texere_core::ControlPoint;
/// // Four points on a line, s = 1/2 (Catmull-Rom): the middle of the segment is the middle of the line.
/// let line = [0.0, 1.0, 2.0, 3.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
/// let sample = Segment::new(&line, 0.5).sample(0.5);
/// assert_eq!(sample.centre, [1.5, 0.0, 0.0].into());
/// assert_eq!(sample.tangent, [1.0, 0.0, 0.0].into());
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    start: Vec3,
    /// `P[j+1] - P[j]`: the offset at t = 1, without rounding.
    span: Vec3,
    /// Coefficients of t, t² and t³ in the offset.
    position: [Vec3; 3],
    half_width: Size,
    half_height: Size,
    /// The largest difference between any of the four control points and the start along an axis,
    /// mm.
    largest: f32,
    /// The largest squared velocity that counts as zero.
    at_rest: f32,
}

/// Bounds of a stretch of a [`Segment`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hull {
    /// The least coordinates of the stretch's centreline, mm.
    pub(crate) low: Vec3,
    /// The greatest coordinates of the stretch's centreline, mm.
    pub(crate) high: Vec3,
    /// The largest half width in the stretch, mm.
    pub(crate) half_width: f32,
    /// The largest half height in the stretch, mm.
    pub(crate) half_height: f32,
}

/// The spline at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The centre relative to `P[j]`, mm.
    pub offset: Vec3,
    /// The centre, mm.
    pub centre: Vec3,
    /// Half the width, mm. It is always positive.
    pub half_width: f32,
    /// Half the height, mm. It is always positive.
    pub half_height: f32,
    /// The unit tangent.
    pub tangent: Vec3,
    /// The growth of the half width along the yarn (mm per mm), within ±[`SLOPE_LIMIT`].
    pub width_growth: f32,
    /// The growth of the half height along the yarn (mm per mm), within ±[`SLOPE_LIMIT`].
    pub height_growth: f32,
}

/// The share of the segment's squared size up to which a squared velocity counts as zero.
///
/// Repeated points and cusps give exact zeros. With this share (a millionth of the size), zeros
/// that rounding changes a little also count. The direction of such a velocity would be noise.
pub const ZERO_VELOCITY: f32 = 1e-12;

/// The square, mm², of the length up to which a length counts as zero, whatever the segment's size.
/// That length is 1e-15 mm. The squares of much shorter lengths leave the normal range of `f32`,
/// and some devices round them to zero.
pub const NO_LENGTH: f32 = 1e-30;

/// The steepest growth of a half width or half height that tilts a normal. At 1e4 the normal is
/// within 1e-4 rad of the axis. Without a limit, the square of a growth could leave the range of
/// `f32`.
pub const SLOPE_LIMIT: f32 = 1e4;

/// The least half width and half height between two control points, as a share of the smaller value
/// at the two points.
///
/// A spline overshoots. Between a slub and a thin place it can fall below zero, where there is no
/// tube.
pub const RADIUS_FLOOR: f32 = 0.5;

/// The four positive nodes of Gauss and Legendre's rule with eight points, for functions between -1
/// and 1. The other four nodes are their negatives.
///
/// **Source**: Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, table 25.4.
pub const ARC_NODES: [f32; 4] = [0.183_434_64, 0.525_532_4, 0.796_666_5, 0.960_289_84];

/// The weight of each node and of its negative.
pub const ARC_WEIGHTS: [f32; 4] = [0.362_683_8, 0.313_706_64, 0.222_381_03, 0.101_228_54];

/// The least evenness at which the rule is applied once to the whole length. Evenness is the speed
/// at the slowest node divided by that at the fastest. Below this value the spline's speed may
/// almost reach zero between nodes and have a kink there. Then the length is divided into
/// [`ARC_PANELS`] parts, and the rule is applied to each.
pub const ARC_EVEN: f32 = 0.5;

/// Number of parts into which a length is divided if the spline's speed is uneven.
pub const ARC_PANELS: u32 = 16;

/// s = (1 - tension) / 2, the factor of the spline's tangents (the paper's equation 2), in the
/// precision of `T`.
///
/// ```
/// use texere_core::definitions::tangent_factor;
/// assert_eq!(tangent_factor::<f32>(0.0), 0.5); // Catmull-Rom
/// assert_eq!(tangent_factor::<f64>(0.75), 0.125);
/// ```
#[must_use]
#[inline]
pub fn tangent_factor<T: From<f32> + Sub<Output = T> + Div<Output = T>>(tension: f32) -> T {
    (T::from(1.0) - T::from(tension)) / T::from(2.0)
}

impl Segment {
    /// The segment between `points[1]` and `points[2]`, with the [factor of
    /// tangents](tangent_factor) `s`.
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
            largest: a.abs().max(b.abs()).max(c.abs()).max_element(),
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
    /// If the velocity at `t` is zero, the tangent is the direction of the yarn just after that
    /// place (just before it at t = 1, a yarn's end). The lowest derivative that is not zero gives
    /// this direction. If all derivatives are zero, the tangent is +x.
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
            // If the velocity is zero, growth along the yarn counts as zero.
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

    /// The speed of the centre at `t`, mm per unit of the parameter.
    #[inline]
    fn speed(&self, t: f32) -> f32 {
        let [c1, c2, c3] = self.position;
        (c1 + (c2 * 2.0 + c3 * (3.0 * t)) * t).length_squared().sqrt()
    }

    /// The length of the spline between two parameters in \[0, 1\], mm, by Gauss and Legendre's
    /// rule with eight points. If its speed is [uneven](ARC_EVEN), the rule is applied in
    /// [`ARC_PANELS`] parts.
    ///
    /// ```
    /// use texere_core::definitions::Segment;
    /// use texere_core::ControlPoint;
    /// let line = [0.0, 1.0, 2.0, 3.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
    /// assert!((Segment::new(&line, 0.5).length(0.0, 0.5) - 0.5).abs() < 1e-6);
    /// ```
    #[must_use]
    #[inline]
    pub fn length(&self, from: f32, to: f32) -> f32 {
        let (length, is_even) = self.length_by_rule(from, to);
        if is_even {
            return length;
        }
        let part = (to - from) / ARC_PANELS as f32;
        (0..ARC_PANELS).fold(0.0, |sum, panel| {
            let start = from + panel as f32 * part;
            sum + self.length_by_rule(start, start + part).0
        })
    }

    /// The length by one application of the rule, and whether the speed is [even](ARC_EVEN).
    #[inline]
    fn length_by_rule(&self, from: f32, to: f32) -> (f32, bool) {
        let (middle, half) = ((from + to) * 0.5, (to - from) * 0.5);
        let speed = self.speed(middle);
        let (mut sum, mut slowest, mut fastest) = (0.0, speed, speed);
        for (node, weight) in ARC_NODES.iter().zip(ARC_WEIGHTS) {
            let reach = half * node;
            let (before, behind) = (self.speed(middle - reach), self.speed(middle + reach));
            sum += weight * (before + behind);
            slowest = slowest.min(before).min(behind);
            fastest = fastest.max(before).max(behind);
        }
        (sum * half, slowest >= ARC_EVEN * fastest)
    }

    /// A box that holds the spline's samples between `from` and `to`, and upper bounds of its
    /// sizes. Both come from the Bézier control points of that stretch, and are enlarged by the
    /// rounding that samples may have.
    pub(crate) fn hull(&self, from: f32, to: f32) -> Hull {
        let [low, high] = extremes(self.position, Vec3::ZERO, from, to, [Vec3::min, Vec3::max]);
        // Coefficients are up to 3.5 times the largest difference, and each is rounded some ten
        // times here and in `sample`. Together that is less than 50 units in the last place of that
        // difference.
        let slack = Vec3::splat(64.0 * f32::EPSILON * self.largest);
        let size = |size: &Size| {
            let [_, most] = extremes(size.terms, size.start, from, to, [f32::min, f32::max]);
            let slack = size.terms.iter().fold(size.start.abs(), |sum, term| sum + term.abs());
            (most + 16.0 * f32::EPSILON * slack).max(size.floor)
        };
        Hull {
            low: self.start + (low - slack),
            high: self.start + (high + slack),
            half_width: size(&self.half_width),
            half_height: size(&self.half_height),
        }
    }

    /// The tangent at a `t` with zero velocity: the limit from the right, or from the left at t =
    /// 1.
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

/// The coefficients of t, t² and t³ of the spline from a control point to the next. Relative to
/// this point, the point before it lies at `a`, the next at `b`, and the one after the next at `c`.
#[inline]
pub(crate) fn coefficients<T>(a: T, b: T, c: T, s: f32) -> [T; 3]
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>,
{
    [(b - a) * s, a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s, (c - a) * s + b * (s - 2.0)]
}

/// The least and the greatest Bézier control point, by the functions `least` and `most`, of the
/// curve `start + (c1 + (c2 + c3 t) t) t` between `from` and `to`. The curve stays between them.
fn extremes<T>(
    [c1, c2, c3]: [T; 3],
    start: T,
    from: f32,
    to: f32,
    [least, most]: [fn(T, T) -> T; 2],
) -> [T; 2]
where
    T: Copy + Add<Output = T> + Mul<f32, Output = T>,
{
    // The polynomial is rewritten as a function of the share of the stretch, from 0 to 1.
    let along = to - from;
    let first = start + (c1 + (c2 + c3 * from) * from) * from;
    let (c1, c2, c3) = (
        (c1 + (c2 * 2.0 + c3 * (3.0 * from)) * from) * along,
        (c2 + c3 * (3.0 * from)) * (along * along),
        c3 * (along * along * along),
    );
    let others = [first + c1 * THIRD, first + (c1 * 2.0 + c2) * THIRD, first + (c1 + c2 + c3)];
    others.into_iter().fold([first, first], |[low, high], point| [least(low, point), most(high, point)])
}

const THIRD: f32 = 1.0 / 3.0;

/// A half width or half height between two control points, as a polynomial of t.
#[derive(Debug, Clone, Copy)]
struct Size {
    start: f32,
    /// Coefficients of t, t² and t³.
    terms: [f32; 3],
    floor: f32,
}

impl Size {
    #[inline]
    fn new([before, start, end, after]: [f32; 4], s: f32) -> Self {
        let (a, b, c) = (before - start, end - start, after - start);
        Self { start, terms: coefficients(a, b, c, s), floor: start.min(end) * RADIUS_FLOOR }
    }

    /// The size at `t` and its growth along the yarn. `inverse` is one over the spline's speed.
    #[inline]
    fn sample(&self, t: f32, inverse: f32) -> (f32, f32) {
        let [r1, r2, r3] = self.terms;
        let size = self.start + (r1 + (r2 + r3 * t) * t) * t;
        let growth = (r1 + (r2 * 2.0 + r3 * (3.0 * t)) * t) * inverse;
        if size < self.floor { (self.floor, 0.0) } else { (size, growth.clamp(-SLOPE_LIMIT, SLOPE_LIMIT)) }
    }
}
