//! Attributes of vertices for shaders and textures, and lengths along yarns.

use std::iter::Sum;
use std::ops::Add;

use bytemuck::{Pod, Zeroable};

/// The attributes of a vertex for shaders and textures. Each [`Vertex`](crate::Vertex) of a chunk
/// has one, in the same order.
///
/// **Shape**: six 4-byte values, 24 bytes. **Units**: radians and mm.
///
/// A ring's first corner is not repeated, so between the last corner and the first the angle falls
/// back to 0. A shader that draws a texture there uses the corner's number, or interpolates sine
/// and cosine of the angle instead.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Attribute {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// The angle round the section from its first corner, rad. Corner k of n, with k counted from
    /// 0, has 2πk/n. The first corner turns with the yarn's twist.
    pub angle: f32,
    /// The length of the yarn from its start to the vertex's ring, mm.
    pub along: f32,
    /// The unit tangent of the yarn at the vertex's ring.
    pub tangent: [f32; 3],
}

const _: () = assert!(size_of::<Attribute>() == 24 && std::mem::offset_of!(Attribute, tangent) == 12);

/// The angle of corner number `corner`, counted from 0, of a section of `sides` corners, rad.
///
/// ```
/// assert_eq!(texere_core::definitions::corner_angle(2, 8), std::f32::consts::FRAC_PI_2);
/// ```
#[must_use]
#[inline]
pub fn corner_angle(corner: u32, sides: u32) -> f32 {
    corner as f32 * (std::f32::consts::TAU / sides as f32)
}

/// A length along a yarn in whole steps of 2⁻³² mm, so that a sum has the same bits in any order.
/// The longest length is 4,294 km. Longer sums wrap round to 0.
///
/// ```
/// use texere_core::ArcLength;
/// let quarter = ArcLength(1 << 30);
/// assert_eq!([quarter; 4].into_iter().sum::<ArcLength>().mm(), 1.0);
/// assert_eq!((quarter + ArcLength(3 << 32)).mm(), 3.25);
/// ```
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Pod, Zeroable)]
pub struct ArcLength(pub u64);

impl ArcLength {
    /// The length 0.
    pub const ZERO: Self = Self(0);

    /// Number of steps in a millimetre.
    pub const STEPS: f32 = 4_294_967_296.0;

    /// The largest number of whole millimetres: the greatest `f32` below 2³².
    pub const MM_MAX: f32 = 4_294_967_040.0;

    /// A length in mm, rounded down to a step. A negative length and NaN become 0.
    #[must_use]
    #[inline]
    pub(crate) fn from_mm(mm: f32) -> Self {
        let mm = mm.max(0.0);
        let whole = mm.floor();
        let part = ((mm - whole) * Self::STEPS) as u32;
        Self((whole.min(Self::MM_MAX) as u64) << 32 | u64::from(part))
    }

    /// The length in mm.
    #[must_use]
    #[inline]
    pub fn mm(self) -> f32 {
        (self.0 >> 32) as f32 + (self.0 as u32) as f32 / Self::STEPS
    }
}

impl Add for ArcLength {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sum for ArcLength {
    fn sum<I: Iterator<Item = Self>>(lengths: I) -> Self {
        lengths.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_keep_their_digits_and_odd_ones_do_no_harm() {
        for mm in [0.0, 1e-9, 0.1, 0.999_999_94, 1.0, 37.25, 16_777_216.0, 4e9] {
            let back = f64::from(ArcLength::from_mm(mm).mm());
            assert!((back - f64::from(mm)).abs() <= f64::from(mm) * 1e-7 + 1e-9, "{mm} {back}");
        }
        for odd in [-1.0, -0.5, f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(ArcLength::from_mm(odd), ArcLength::ZERO, "{odd}");
        }
        assert_eq!(ArcLength::from_mm(f32::INFINITY).0 >> 32, 4_294_967_040);
        // A million steps of a tenth of a micrometre are added. In f32 the sum would be 99.33.
        let sum: ArcLength = (0..1_000_000).map(|_| ArcLength::from_mm(1e-4)).sum();
        assert!((sum.mm() - 100.0).abs() < 1e-3, "{}", sum.mm());
    }
}
