//! Control points: the only geometry that a structure has to produce.

use std::fmt;

use bytemuck::{Pod, Zeroable};

use crate::half;

/// A point that a yarn's centreline passes through, with the yarn's half width and half height at
/// that point.
///
/// The half width lies level in the cloth, and the half height points out of the cloth. Both are at
/// right angles to the yarn. They do not turn with the yarn's twist: yarns flatten where they cross
/// and spread where they float, while their fibres turn inside the outline. In a round yarn both
/// are the radius.
///
/// **Shape**: three `f32` and two half floats (IEEE 754 binary16), 16 bytes, 16-byte stride.
/// **Units**: millimetres. The spline interpolates all five components, so half width and half
/// height alone make slubs (thick places) and flat places. A half float has 11 significant bits, so
/// sizes are rounded by at most 1 in 2048.
///
/// ```
/// use texere_core::ControlPoint;
/// let round = ControlPoint::new(1.0, 2.0, 0.25, 0.125);
/// assert_eq!((round.half_width(), round.half_height()), (0.125, 0.125));
/// let flat = round.flattened(0.1875, 0.0625);
/// assert_eq!((flat.half_width(), flat.half_height()), (0.1875, 0.0625));
/// assert_eq!(bytemuck::bytes_of(&flat).len(), 16);
/// ```
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct ControlPoint {
    /// Position along the weft or the course, mm.
    pub x: f32,
    /// Position along the warp or the wale, mm.
    pub y: f32,
    /// Height out of the technical face, mm.
    pub z: f32,
    /// Half the yarn's width and half its height.
    pub halves: Halves,
}

/// Half width and half height of a yarn at a control point, mm, as two half floats.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct Halves([u16; 2]);

const _: () = assert!(
    size_of::<ControlPoint>() == 16
        && align_of::<ControlPoint>() == 4
        && std::mem::offset_of!(ControlPoint, halves) == 12
);

/// The largest coordinate on either side of the origin, mm (a thousand kilometres).
///
/// With larger coordinates, squares and cubes in the spline could leave the range of `f32`.
pub const COORDINATE_LIMIT: f32 = 1e9;

/// The least half width and half height of a yarn, mm: a tenth of a micrometre. The smallest number
/// that a half float holds with all its bits is 6.1e-5.
pub const RADIUS_MIN: f32 = 1e-4;

/// The largest half width and half height of a yarn, mm: thirty metres. The largest half float is
/// 65,504, and a virtual end may be twice as large as its neighbour.
pub const RADIUS_MAX: f32 = 3e4;

impl ControlPoint {
    /// A control point of a round yarn at (`x`, `y`, `z`) with `radius`, all in mm. The radius is
    /// rounded to the nearest half float, ties to even.
    #[must_use]
    #[inline]
    pub fn new(x: f32, y: f32, z: f32, radius: f32) -> Self {
        Self { x, y, z, halves: Halves::new(radius, radius) }
    }

    /// This point with another half width and half height, mm, for a flattened yarn. Both are
    /// rounded like the radius of [`ControlPoint::new`].
    #[must_use]
    #[inline]
    pub fn flattened(self, half_width: f32, half_height: f32) -> Self {
        Self { halves: Halves::new(half_width, half_height), ..self }
    }

    /// The position alone, mm.
    #[must_use]
    #[inline]
    pub const fn position(&self) -> glam::Vec3 {
        glam::Vec3::new(self.x, self.y, self.z)
    }

    /// Half the yarn's width, level in the cloth, mm.
    #[must_use]
    #[inline]
    pub fn half_width(&self) -> f32 {
        self.halves.width()
    }

    /// Half the yarn's height, out of the cloth, mm.
    #[must_use]
    #[inline]
    pub fn half_height(&self) -> f32 {
        self.halves.height()
    }

    /// Whether the yarn is as wide as it is high at this point.
    #[must_use]
    #[inline]
    pub const fn is_round(&self) -> bool {
        self.halves.0[0] == self.halves.0[1]
    }

    /// `2 self - other` in all five components: the paper's virtual ends (equations 3 and 4). Sizes
    /// are computed in `f32` and rounded to half floats.
    ///
    /// The sizes of a virtual end may be negative. They only affect the spline's slope.
    #[must_use]
    pub fn reflected(&self, other: &Self) -> Self {
        let far = |here: f32, there: f32| 2.0 * here - there;
        let (half_width, half_height) =
            (far(self.half_width(), other.half_width()), far(self.half_height(), other.half_height()));
        Self { x: far(self.x, other.x), y: far(self.y, other.y), z: far(self.z, other.z), ..*self }
            .flattened(half_width, half_height)
    }
}

impl Halves {
    /// Half `width` and half `height`, mm, rounded to the nearest half floats, ties to even.
    #[must_use]
    #[inline]
    pub fn new(width: f32, height: f32) -> Self {
        Self([half::from_f32(width), half::from_f32(height)])
    }

    /// Half the width, mm.
    #[must_use]
    #[inline]
    pub fn width(self) -> f32 {
        half::to_f32(self.0[0])
    }

    /// Half the height, mm.
    #[must_use]
    #[inline]
    pub fn height(self) -> f32 {
        half::to_f32(self.0[1])
    }

    /// Whether both sizes lie between [`RADIUS_MIN`] and [`RADIUS_MAX`]. Half floats above zero are
    /// in the order of their bits. The bits of infinity, NaN and negative numbers come after those
    /// of all others.
    pub(crate) const fn within_limits(self) -> bool {
        const LEAST: u16 = half::from_f32(RADIUS_MIN);
        const MOST: u16 = half::from_f32(RADIUS_MAX);
        let [width, height] = self.0;
        (width >= LEAST) & (width <= MOST) & (height >= LEAST) & (height <= MOST)
    }
}

impl fmt::Debug for Halves {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}", self.width(), self.height())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares all half floats with the limits by their values.
    #[test]
    fn limits_of_sizes_are_limits_of_their_bits() {
        for bits in 0..=u16::MAX {
            let size = half::to_f32(bits);
            let within = (RADIUS_MIN..=RADIUS_MAX).contains(&size);
            let fine = half::from_f32(1.0);
            assert_eq!(Halves([bits, fine]).within_limits(), within, "{size}");
            assert_eq!(Halves([fine, bits]).within_limits(), within, "{size}");
        }
    }
}
