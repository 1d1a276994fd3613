//! The control point: the one thing a structure has to produce.

use bytemuck::{Pod, Zeroable};

/// A point that a yarn's centreline passes through, with the yarn's radius there.
///
/// **Shape**: four `f32`, 16 bytes, 16-byte stride. **Units**: millimetres. The spline interpolates all four
/// components, so a slub (a thick place) or a thick-and-thin yarn is made by the radius alone.
///
/// ```
/// use texere_core::ControlPoint;
/// let point = ControlPoint::new(1.0, 2.0, 0.25, 0.1);
/// assert_eq!(bytemuck::bytes_of(&point).len(), 16);
/// ```
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct ControlPoint {
    /// Along the weft or the course, mm.
    pub x: f32,
    /// Along the warp or the wale, mm.
    pub y: f32,
    /// Out of the technical face, mm.
    pub z: f32,
    /// Radius of the yarn, mm.
    pub radius: f32,
}

const _: () = assert!(size_of::<ControlPoint>() == 16 && align_of::<ControlPoint>() == 4);

/// The furthest that a coordinate may lie from the origin, mm (a thousand kilometres).
///
/// Beyond it the squares and cubes that the spline forms could leave the range of `f32`.
pub const COORDINATE_LIMIT: f32 = 1e9;

/// The thinnest radius that is taken for a yarn, mm: a nanometre, a thousandth of the thinnest spun fibre.
pub const RADIUS_MIN: f32 = 1e-6;

/// The thickest radius that is taken for a yarn, mm: a kilometre.
pub const RADIUS_MAX: f32 = 1e6;

impl ControlPoint {
    /// A control point at (`x`, `y`, `z`) with `radius`, all in mm.
    #[must_use]
    pub const fn new(x: f32, y: f32, z: f32, radius: f32) -> Self {
        Self { x, y, z, radius }
    }

    /// The position without the radius, mm.
    #[must_use]
    pub const fn position(&self) -> glam::Vec3 {
        glam::Vec3::new(self.x, self.y, self.z)
    }

    /// `2 self - other` in all four components: the paper's virtual ends (equations 3 and 4).
    ///
    /// The radius of a virtual end may be negative; it only steers the spline's slope.
    #[must_use]
    pub fn reflected(&self, other: &Self) -> Self {
        Self {
            x: 2.0 * self.x - other.x,
            y: 2.0 * self.y - other.y,
            z: 2.0 * self.z - other.z,
            radius: 2.0 * self.radius - other.radius,
        }
    }
}
