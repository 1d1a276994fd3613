//! The ring: one sample of a yarn's centreline, the element of a trajectory.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::{Basis, Sample, SectionPoint, Turn, Vertex};

/// One sample of a yarn's centreline: all that places a section there, except the slope of the radius.
///
/// **Shape**: eight 4-byte values, 32 bytes. **Units**: mm; `roll` in 2⁻³² turns.
///
/// ```
/// use texere_core::Ring;
/// assert_eq!(size_of::<Ring>(), 32);
/// ```
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Ring {
    /// Centre, mm.
    pub centre: [f32; 3],
    /// Radius, mm.
    pub radius: f32,
    /// Unit tangent, the spline's own derivative.
    pub tangent: [f32; 3],
    /// Turn of the section about the tangent, against the upright frame.
    pub roll: Turn,
}

const _: () = assert!(
    size_of::<Ring>() == 32
        && std::mem::offset_of!(Ring, radius) == 12
        && std::mem::offset_of!(Ring, tangent) == 16
        && std::mem::offset_of!(Ring, roll) == 28
);

impl Ring {
    /// The ring at `sample` with `roll`.
    #[must_use]
    #[inline]
    pub fn new(sample: &Sample, roll: Turn) -> Self {
        Self {
            centre: sample.centre.to_array(),
            radius: sample.radius,
            tangent: sample.tangent.to_array(),
            roll,
        }
    }

    /// Side and up of the section here.
    #[must_use]
    #[inline]
    pub fn basis(&self) -> Basis {
        let upright = Basis::upright(Vec3::from_array(self.tangent));
        if self.roll == Turn::ZERO { upright } else { upright.rolled(self.roll) }
    }

    /// The vertex at `point` of the section that stands here with `basis`, where the radius grows by `slope` (dr/ds).
    ///
    /// The normal of a section that grows by r' along the axis leans back by r' times the section point's reach: it is
    /// at right angles both to the outline and to the line along the surface.
    #[must_use]
    #[inline]
    pub fn vertex(&self, basis: &Basis, slope: f32, point: &SectionPoint) -> Vertex {
        let outward = basis.side * point.x + basis.up * point.y;
        let position = Vec3::from_array(self.centre) + outward * self.radius;
        let across = basis.side * point.normal_x + basis.up * point.normal_y;
        let normal = if slope == 0.0 {
            across
        } else {
            let lean = slope * point.reach();
            (across - Vec3::from_array(self.tangent) * lean) * (1.0 / (1.0 + lean * lean).sqrt())
        };
        Vertex { position: position.to_array(), normal: normal.to_array() }
    }
}

/// The centrelines of a fabric: rings of all yarns one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// All rings, yarn after yarn.
    pub rings: Vec<Ring>,
    /// Where each yarn's rings start, and their total last (the paper's Ωp): yarns + 1 values.
    pub offsets: Vec<u64>,
}

impl Trajectory {
    /// The rings of `yarn`, or `None` past the last yarn.
    #[must_use]
    pub fn yarn(&self, yarn: usize) -> Option<&[Ring]> {
        let (first, end) = (*self.offsets.get(yarn)?, *self.offsets.get(yarn + 1)?);
        self.rings.get(usize::try_from(first).ok()?..usize::try_from(end).ok()?)
    }
}
