//! Half floats (IEEE 754 binary16) as bits: the sizes of control points.

/// The nearest half float, ties to even. Values from 65,520 on become infinity.
pub(crate) const fn from_f32(value: f32) -> u16 {
    let bits = value.to_bits();
    let (sign, size) = ((bits >> 16 & 0x8000) as u16, bits & 0x7fff_ffff);
    let magnitude = if size > 0x7f80_0000 {
        // A quiet NaN.
        0x7e00 | size >> 13 & 0x3ff
    } else if size >= 65_536_f32.to_bits() {
        0x7c00
    } else if size >= LEAST_NORMAL.to_bits() {
        // The exponent's bias becomes 15 instead of 127, and 13 bits are rounded away. A carry of
        // the rounding correctly goes into the exponent.
        (size - (112 << 23) + 0xfff + (size >> 13 & 1)) >> 13
    } else {
        // Floats from 0.5 to 1 have the steps of the smallest half floats, so the sum is rounded to
        // such a step.
        (f32::from_bits(size) + 0.5).to_bits() - 0.5_f32.to_bits()
    };
    sign | magnitude as u16
}

/// The exact value of a half float.
#[inline]
pub(crate) const fn to_f32(bits: u16) -> f32 {
    let (sign, size) = ((bits as u32 & 0x8000) << 16, bits as u32 & 0x7fff);
    let magnitude = if size > 0x7c00 {
        0x7fc0_0000 | size << 13
    } else if size == 0x7c00 {
        f32::INFINITY.to_bits()
    } else if size >= 0x400 {
        (size << 13) + (112 << 23)
    } else {
        (size as f32 * STEP).to_bits()
    };
    f32::from_bits(sign | magnitude)
}

/// The smallest half float with all its digits, 2⁻¹⁴.
const LEAST_NORMAL: f32 = 1.0 / 16_384.0;

/// The distance of neighbouring half floats below [`LEAST_NORMAL`], 2⁻²⁴.
const STEP: f32 = 1.0 / 16_777_216.0;

#[cfg(test)]
mod tests {
    use half::f16;

    use super::*;

    #[test]
    fn all_half_floats_have_the_values_of_the_crate_half() {
        for bits in 0..=u16::MAX {
            assert_eq!(to_f32(bits).to_bits(), f16::from_bits(bits).to_f32_const().to_bits(), "{bits:#06x}");
        }
    }

    /// Checks each half float, the middle between it and the next, and the floats beside both. Then
    /// checks floats of all exponents.
    #[test]
    fn floats_are_rounded_as_the_crate_half_does() {
        let check = |bits: u32| {
            let value = f32::from_bits(bits);
            assert_eq!(from_f32(value), f16::from_f32_const(value).to_bits(), "{value:e} {bits:#010x}");
        };
        for half in 0..=u16::MAX {
            let bits = f16::from_bits(half).to_f32_const().to_bits();
            let middle = if half & 0x7c00 == 0 {
                // Below the least normal half float all steps are equal.
                (f32::from_bits(bits).abs() + STEP / 2.0).to_bits() | bits & 0x8000_0000
            } else {
                bits.wrapping_add(1 << 12)
            };
            for at in [bits, middle] {
                (0..3).for_each(|step| check(at.wrapping_add(step).wrapping_sub(1)));
            }
        }
        for bits in (0..=u32::MAX).step_by(9_973) {
            check(bits);
        }
    }
}
