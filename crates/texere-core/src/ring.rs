//! Rings: samples of a yarn's centreline, the elements of a trajectory.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::definitions::{Basis, Sample, Turn};
use crate::{SectionPoint, Vertex};

/// A sample of a yarn's centreline, with everything that the section at that place needs.
///
/// **Shape**: twelve 4-byte values, 48 bytes. **Units**: mm, growths in mm per mm, `roll` and
/// `lean` in 2⁻³² turns.
///
/// ```
/// use texere_core::definitions::Ring;
/// assert_eq!(size_of::<Ring>(), 48);
/// ```
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Ring {
    /// Centre, mm.
    pub centre: [f32; 3],
    /// Half the yarn's width, along the side of the upright frame turned by the lean, mm.
    pub half_width: f32,
    /// Unit tangent, the spline's own derivative.
    pub tangent: [f32; 3],
    /// Turn of the section about the tangent, against the upright frame.
    pub roll: Turn,
    /// Half the yarn's height, along the up of the upright frame turned by the lean, mm.
    pub half_height: f32,
    /// Growth of the half width along the yarn.
    pub width_growth: f32,
    /// Growth of the half height along the yarn.
    pub height_growth: f32,
    /// Turn of the yarn's outline about the tangent, against the upright frame. 0 unless the yarn
    /// has [up directions](crate::Layout::ups).
    pub lean: Turn,
}

const _: () = assert!(
    size_of::<Ring>() == 48
        && std::mem::offset_of!(Ring, half_width) == 12
        && std::mem::offset_of!(Ring, tangent) == 16
        && std::mem::offset_of!(Ring, roll) == 28
        && std::mem::offset_of!(Ring, half_height) == 32
        && std::mem::offset_of!(Ring, lean) == 44
);

impl Ring {
    /// The ring at `sample` with `roll`.
    #[must_use]
    #[inline]
    pub fn new(sample: &Sample, roll: Turn) -> Self {
        Self {
            centre: sample.centre.to_array(),
            half_width: sample.half_width,
            tangent: sample.tangent.to_array(),
            roll,
            half_height: sample.half_height,
            width_growth: sample.width_growth,
            height_growth: sample.height_growth,
            lean: Turn::ZERO,
        }
    }

    /// Whether the yarn is round at this ring and stays round: width and height are equal, and so
    /// are their growths.
    #[must_use]
    #[inline]
    pub fn is_round(&self) -> bool {
        self.half_width == self.half_height && self.width_growth == self.height_growth
    }

    /// The stance of the section on this ring.
    #[must_use]
    #[inline]
    pub fn stance(&self) -> Stance {
        let upright = Basis::upright(Vec3::from_array(self.tangent));
        if self.is_round() {
            let basis = if self.roll == Turn::ZERO { upright } else { upright.rolled(self.roll) };
            Stance::Round { basis }
        } else {
            let basis = if self.lean == Turn::ZERO { upright } else { upright.rolled(self.lean) };
            let (sin, cos) = (self.roll - self.lean).sin_cos();
            Stance::Flattened { basis, sin, cos }
        }
    }

    /// The vertex at `point` of the section with `stance`.
    ///
    /// The section is turned by the roll, then stretched to the half width along the side and to
    /// the half height along the up of the upright frame, which is turned by the lean. Its normal
    /// is stretched by the inverse transpose. If the section grows along the yarn, the normal leans
    /// back, so that it is at right angles both to the outline and to the line along the surface.
    #[must_use]
    #[inline]
    pub fn vertex(&self, stance: &Stance, point: &SectionPoint) -> Vertex {
        let (centre, tangent) = (Vec3::from_array(self.centre), Vec3::from_array(self.tangent));
        let (position, normal) = match stance {
            Stance::Round { basis } => {
                let outward = basis.side * point.x + basis.up * point.y;
                let across = basis.side * point.normal_x + basis.up * point.normal_y;
                let normal = if self.width_growth == 0.0 {
                    across
                } else {
                    let lean = self.width_growth * point.reach();
                    (across - tangent * lean) * (1.0 / (1.0 + lean * lean).sqrt())
                };
                (centre + outward * self.half_width, normal)
            }
            Stance::Flattened { basis: Basis { side, up }, sin, cos } => {
                let SectionPoint { x, y, normal_x, normal_y } = point.rolled(*sin, *cos);
                let (wide, high) = (self.half_width, self.half_height);
                let at = |x: f32, y: f32| *side * x + *up * y;
                // Each component is multiplied by the other component's half. That is the inverse
                // transpose, times the product of both halves.
                let (normal_x, normal_y) = (normal_x * high, normal_y * wide);
                let lean = self.width_growth * x * normal_x + self.height_growth * y * normal_y;
                let inverse = 1.0 / (normal_x * normal_x + normal_y * normal_y + lean * lean).sqrt();
                let normal = at(normal_x * inverse, normal_y * inverse) - tangent * (lean * inverse);
                // Zero is added so that no sum is -0. The vertex is then the same to the bit
                // whether a lean or a roll of zero is computed or skipped, and opposite points have
                // opposite normals.
                (centre + Vec3::ZERO + at(x * wide, y * high), normal + Vec3::ZERO)
            }
        };
        Vertex { position: position.to_array(), normal: normal.to_array() }
    }
}

/// The stance of a section on a [`Ring`], common to all its vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stance {
    /// The stance in a round yarn. Its outline is a circle, so the frame may turn with the section.
    Round {
        /// The frame, turned by the roll.
        basis: Basis,
    },
    /// The stance in a flattened yarn, whose section turns inside an outline that does not turn.
    Flattened {
        /// The upright frame, turned by the lean.
        basis: Basis,
        /// The sine of the roll against this frame.
        sin: f32,
        /// The cosine of the roll against this frame.
        cos: f32,
    },
}

/// The centrelines of a fabric: the rings of all yarns, one yarn after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// All rings, yarn after yarn.
    pub rings: Vec<Ring>,
    /// The start of each yarn's rings, and the number of all rings last (the paper's Ωp). There is
    /// one value more than there are yarns.
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
