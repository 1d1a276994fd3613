//! Cross-sections: the outlines that stand on rings.

mod error;
mod outline;
mod triangulate;
mod validate;

pub use error::SectionError;
pub(crate) use triangulate::triangulate;

use bytemuck::{Pod, Zeroable};

/// The shape of a yarn's cross-section, in units of the yarn's radius.
///
/// Every shape but the polygon encloses the area of the unit circle, so that a yarn keeps its
/// volume, and with it its weight, whatever its shape. x is along the section's side (level in
/// cloth), and y along its up (out of the fabric).
///
/// **Source** of ellipse, power ellipse and lenticular: Sherburn, "Geometric and mechanical
/// modelling of textiles", PhD thesis, Nottingham, 2007 (the TexGen library).
///
/// ```
/// use texere_core::Section;
/// let flat = Section::Ellipse { aspect: 2.0 };
/// flat.validate()?;
/// assert!((flat.half_width() / flat.half_height() - 2.0).abs() < 1e-5);
/// assert_eq!(flat.outline(6).len(), 6);
/// # Ok::<(), texere_core::SectionError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub enum Section {
    /// A circle.
    #[default]
    Circle,
    /// An ellipse.
    Ellipse {
        /// Width over height.
        aspect: f32,
    },
    /// Two arcs that meet in two edges.
    Lenticular {
        /// Width over height.
        aspect: f32,
        /// The height of the edges above the middle, in half heights, from -0.9 to 0.9.
        distortion: f32,
    },
    /// An ellipse whose height at angle θ is in proportion to `|sin θ|^exponent` instead of
    /// `|sin θ|`.
    PowerEllipse {
        /// Width over height.
        aspect: f32,
        /// The exponent, from 0.1 to 4. With 1 the section is an ellipse. Below 1 it is closer to a
        /// box, and above 1 closer to a lens.
        exponent: f32,
    },
    /// The outline of plies that are twisted together ([`Section::plied`]).
    Lobed {
        /// Number of plies, from 2 to 12.
        plies: u32,
        /// Distance of the valley between two plies from the axis, as a share of the distance to
        /// which a ply reaches, from 0.5 to 1. With 1 the section is a circle. The valley is
        /// shallower, and the number larger, the more the plies are pressed into one another.
        valley: f32,
    },
    /// An outline of the caller's own: counter-clockwise corners, in radii of the yarn. A plan of
    /// yarns with this section must have one side per corner.
    Polygon(Vec<[f32; 2]>),
}

/// One point of a section's outline with its outward normal.
///
/// **Shape**: four `f32`, 16 bytes. **Units**: radii of the yarn. The normal is a unit vector.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct SectionPoint {
    /// Position along the section's side.
    pub x: f32,
    /// Position along the section's up.
    pub y: f32,
    /// The normal's component along the side.
    pub normal_x: f32,
    /// The normal's component along the up.
    pub normal_y: f32,
}

const _: () = assert!(size_of::<SectionPoint>() == 16);

impl SectionPoint {
    /// The dot product of position and normal. It says how far the surface moves along its normal
    /// at this point if the radius grows by 1. All round a circle it is 1.
    #[must_use]
    pub fn reach(&self) -> f32 {
        self.x * self.normal_x + self.y * self.normal_y
    }

    /// The point turned by a roll, given its sine and cosine.
    #[must_use]
    #[inline]
    pub fn rolled(&self, sin: f32, cos: f32) -> Self {
        let turned = |x: f32, y: f32| (cos * x - sin * y, sin * x + cos * y);
        let ((x, y), (normal_x, normal_y)) = (turned(self.x, self.y), turned(self.normal_x, self.normal_y));
        Self { x, y, normal_x, normal_y }
    }
}

/// The fewest and the most plies of a section.
const PLIES: [u32; 2] = [2, 12];

/// The fewest sides a tube can have.
pub(crate) const SIDES_MIN: u32 = 3;

/// The most sides a tube can have. These are far more than can be seen on a yarn a few pixels wide.
pub const SIDES_MAX: u32 = 256;
