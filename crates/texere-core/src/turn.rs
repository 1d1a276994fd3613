//! Angles as fractions of a full turn, and the sine, cosine and arctangent that all CPU backends
//! share.
//!
//! A roll adds up over millions of rings. In `f32` radians it would lose digits as it grows, and a
//! sum would depend on its order. Addition of `u32` fractions of a turn wraps and is associative to
//! the bit, so serial, parallel, chunked and GPU scans agree whatever their order.
//!
//! The polynomials are those of Moshier's Cephes library (`sinf`, `cosf`, `atanf`, single
//! precision, 1992). The arctangent's coefficients are divided by 2π so that the result is in
//! turns. The polynomials are written out here because the last bit of the standard library's `sin`
//! differs from platform to platform.

use bytemuck::{Pod, Zeroable};

/// An angle, stored as a fraction of a full turn: `u32` steps of 2π / 2³² rad (1.5e-9 rad).
///
/// ```
/// use texere_core::definitions::Turn;
/// let quarter = Turn::from_turns(0.25);
/// assert_eq!(quarter + quarter + quarter + quarter, Turn::ZERO);
/// let (sin, cos) = quarter.sin_cos();
/// assert!((sin - 1.0).abs() < 1e-6 && cos.abs() < 1e-6);
/// ```
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Pod, Zeroable)]
pub struct Turn(pub u32);

/// The sine's coefficients of x³, x⁵ and x⁷, for x within an eighth of a turn.
pub const SINE: [f32; 3] = [-1.666_665_5e-1, 8.332_161e-3, -1.951_529_6e-4];

/// The cosine's coefficients of x⁴, x⁶ and x⁸, for x within an eighth of a turn.
pub const COSINE: [f32; 3] = [4.166_664_6e-2, -1.388_731_6e-3, 2.443_315_7e-5];

/// The arctangent's coefficients of q, q³ and so on to q⁹, in turns, for q up to [`TAN_EIGHTH`].
pub const ARCTANGENT: [f32; 5] =
    [0.159_154_94, -5.305_101_6e-2, 3.179_573e-2, -2.208_701_8e-2, 1.281_793_2e-2];

/// tan(π/8), where the arctangent's range is split in two.
pub const TAN_EIGHTH: f32 = 0.414_213_57;

impl Turn {
    /// Number of steps in a full turn.
    pub const STEPS: f32 = 4_294_967_296.0;

    /// Radians in one step.
    pub const RADIANS_PER_STEP: f32 = (std::f64::consts::TAU / 4_294_967_296.0) as f32;

    /// The turn 0.
    pub const ZERO: Self = Self(0);

    /// `turns` full turns, reduced to within one turn and rounded to the nearest step.
    #[must_use]
    #[inline]
    pub fn from_turns(turns: f32) -> Self {
        // Below 2²³ turns the value lies in [-1/2, 1/2]. From there on, the sum may be rounded up,
        // and `max` keeps the value from falling below -1/2.
        let wrapped = (turns - (turns + 0.5).floor()).max(-0.5);
        Self(((wrapped * Self::STEPS + 0.5).floor() as i32).cast_unsigned())
    }

    /// The angle as a signed fraction of a turn, in \[-1/2, 1/2).
    #[must_use]
    #[inline]
    pub fn turns(self) -> f32 {
        self.0.cast_signed() as f32 / Self::STEPS
    }

    /// The angle in radians, in \[-π, π).
    #[must_use]
    pub fn radians(self) -> f64 {
        f64::from(self.0.cast_signed()) * (std::f64::consts::TAU / f64::from(Self::STEPS))
    }

    /// Sine and cosine, each within 1.2e-7 of the exact value.
    #[must_use]
    #[inline]
    pub fn sin_cos(self) -> (f32, f32) {
        // The nearest quarter turn, and the rest, at most an eighth of a turn either way. Both are
        // exact in integers.
        let quarter = self.0.wrapping_add(1 << 29) >> 30;
        let rest = self.0.wrapping_sub(quarter << 30).cast_signed();
        let x = rest as f32 * Self::RADIANS_PER_STEP;
        let z = x * x;
        let ([s1, s2, s3], [c1, c2, c3]) = (SINE, COSINE);
        let sin = ((s3 * z + s2) * z + s1) * z * x + x;
        let cos = ((c3 * z + c2) * z + c1) * z * z - 0.5 * z + 1.0;
        // Written without a branch, so that loops over many turns can be vectorised.
        let (sin, cos) = if quarter & 1 == 0 { (sin, cos) } else { (cos, sin) };
        (if quarter & 2 == 0 { sin } else { -sin }, if (quarter + 1) & 2 == 0 { cos } else { -cos })
    }

    /// The turn scaled by `part / whole`, rounded to the nearest step. In this way the total turn
    /// of a closed yarn is spread over its rings.
    #[must_use]
    #[inline]
    pub fn share(self, part: u32, whole: u32) -> Self {
        let steps = self.0.cast_signed() as f32 * (part as f32 / whole as f32);
        Self(((steps + 0.5).floor() as i32).cast_unsigned())
    }
}

impl std::ops::Add for Turn {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl std::ops::Sub for Turn {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl std::iter::Sum for Turn {
    fn sum<I: Iterator<Item = Self>>(turns: I) -> Self {
        turns.fold(Self::ZERO, |sum, turn| sum + turn)
    }
}

/// The angle of (`x`, `y`) from the x axis as a fraction of a turn, in \[-1/2, 1/2\], exact to 3e-8
/// turns. It is 0 for (0, 0).
#[must_use]
#[inline]
pub(crate) fn atan2_turns(y: f32, x: f32) -> f32 {
    let (along, across) = (x.abs(), y.abs());
    let (low, high) = if across > along { (along, across) } else { (across, along) };
    let (numerator, denominator, eighth) =
        if low > TAN_EIGHTH * high { (low - high, low + high, 0.125) } else { (low, high, 0.0) };
    let q = numerator / denominator;
    let z = q * q;
    let [a1, a3, a5, a7, a9] = ARCTANGENT;
    let series = ((a9 * z + a7) * z + a5) * z + a3;
    let octant = eighth + (series * z * q + a1 * q);
    let quadrant = if across > along { 0.25 - octant } else { octant };
    let half = if x < 0.0 { 0.5 - quadrant } else { quadrant };
    let signed = if y < 0.0 { -half } else { half };
    // At (0, 0) `signed` is NaN, from 0/0.
    if high == 0.0 { 0.0 } else { signed }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_stay_within_their_bound_all_the_way_round() {
        for step in 0..100_000u32 {
            let turn = Turn(step.wrapping_mul(42_949).wrapping_add(step));
            let (sin, cos) = turn.sin_cos();
            let angle = turn.radians();
            assert!((f64::from(sin) - angle.sin()).abs() < 1.2e-7, "sin of {angle}");
            assert!((f64::from(cos) - angle.cos()).abs() < 1.2e-7, "cos of {angle}");
        }
    }

    #[test]
    fn arctangent_stays_within_its_bound_all_the_way_round() {
        for step in 0..100_000 {
            let angle = std::f64::consts::TAU * (f64::from(step) / 100_000.0 - 0.5);
            let (y, x) = ((angle.sin() * 3.0) as f32, (angle.cos() * 3.0) as f32);
            let truth = f64::from(y).atan2(f64::from(x)) / std::f64::consts::TAU;
            assert!((f64::from(atan2_turns(y, x)) - truth).abs() < 3e-8, "atan2 at {angle}");
        }
    }

    #[test]
    fn small_angles_keep_their_relative_accuracy() {
        for exponent in 1..30 {
            let y = 0.5f32.powi(exponent);
            let truth = f64::from(y).atan2(1.0) / std::f64::consts::TAU;
            assert!((f64::from(atan2_turns(y, 1.0)) / truth - 1.0).abs() < 3e-7, "atan2 of {y}");
        }
    }

    #[test]
    fn turns_wrap_and_round() {
        assert_eq!(Turn::from_turns(1.0), Turn::ZERO);
        assert_eq!(Turn::from_turns(0.5), Turn(1 << 31));
        assert_eq!(Turn::from_turns(-0.25), Turn(3 << 30));
        assert_eq!(Turn::from_turns(7.125), Turn(1 << 29));
        assert_eq!(Turn::from_turns(0.499_999_97).turns(), -0.5);
        assert_eq!(Turn(1 << 30).share(1, 4), Turn(1 << 28));
        assert_eq!(Turn(3 << 30).share(2, 2), Turn(3 << 30));
    }
}
