//! Frames: the orientation of sections on the centreline.

use glam::Vec3;

use crate::definitions::{NO_LENGTH, Turn};
use crate::turn::atan2_turns;

/// The orientation of sections along a yarn. Twist turns them further in either frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Frame {
    /// The section's side lies level (at right angles to z), and its up points out of the fabric.
    /// This suits flat yarns in cloth. The frame is that of the paper's equation 7, turned by half
    /// a turn. It would flip where a yarn passes through the vertical. A yarn that is
    /// [steep](crate::Layout::is_steep) anywhere therefore has the rotation minimising frame
    /// instead, and the outline of a flattened yarn [leans](crate::Layout::ups).
    #[default]
    Upright,
    /// The section is carried along without turning about the yarn. The frame has no twist of its
    /// own, and does not flip where the tangent passes z. It is computed by double reflection
    /// (Wang, Jüttler, Zheng and Liu, 2008), and stored as a turn against the upright frame.
    RotationMinimizing,
}

/// The two unit vectors across a yarn. With the tangent they make a right-handed frame (side, up,
/// tangent).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Basis {
    /// The direction of the section's x axis.
    pub side: Vec3,
    /// The direction of the section's y axis.
    pub up: Vec3,
}

/// The squared sine of the angle to z, 1e-6 rad, below which a tangent counts as parallel to z.
pub const VERTICAL: f32 = 1e-12;

/// The squared length below which the second reflection's mirror has no direction. The yarn then
/// makes a hairpin, to within a milliradian.
///
/// On a smooth curve the mirror's length is about 2. At a hairpin's tip it is 0, apart from the
/// rounding of the last chord. With K rings between two control points, that chord's direction is
/// off by some (K + 1)² units in the last place. Up to K = 90 the bound lies above that error.
pub const NO_MIRROR: f32 = 1e-6;

impl Basis {
    /// The upright basis for a unit `tangent`: side = z × t, normalised (+y where t is within 1e-6
    /// of z), up = t × side.
    ///
    /// ```
    /// use texere_core::definitions::Basis;
    /// use glam::Vec3;
    /// let basis = Basis::upright(Vec3::X);
    /// assert_eq!((basis.side, basis.up), (Vec3::Y, Vec3::Z));
    /// ```
    #[must_use]
    #[inline]
    pub fn upright(tangent: Vec3) -> Self {
        let level = tangent.x * tangent.x + tangent.y * tangent.y;
        let side = if level < VERTICAL {
            Vec3::Y
        } else {
            let inverse = 1.0 / level.sqrt();
            Vec3::new(-tangent.y * inverse, tangent.x * inverse, 0.0)
        };
        let up = Vec3::new(-tangent.z * side.y, tangent.z * side.x, tangent.x * side.y - tangent.y * side.x);
        Self { side, up }
    }

    /// This basis turned by `roll` about the tangent, right-handed: side towards up.
    #[must_use]
    #[inline]
    pub fn rolled(&self, roll: Turn) -> Self {
        let (sin, cos) = roll.sin_cos();
        Self { side: self.side * cos + self.up * sin, up: self.up * cos - self.side * sin }
    }
}

impl Frame {
    /// The change of roll from a ring to the next. It is the twist `turns_per_mm` times the length
    /// of `chord`. A rotation minimising frame adds the turn, against the upright frame, that keeps
    /// the section from turning about the yarn.
    ///
    /// `chord` (mm) leads from one ring's centre to the next. Tangents are unit vectors.
    /// **Source**: Wang, Jüttler, Zheng and Liu, "Computation of rotation minimizing frames", ACM
    /// TOG 27(1), 2008, table I.
    #[must_use]
    #[inline]
    pub fn step(self, tangent: Vec3, next_tangent: Vec3, chord: Vec3, turns_per_mm: f32) -> Turn {
        let turns = match self {
            Self::Upright => 0.0,
            Self::RotationMinimizing => transport_turns(tangent, next_tangent, chord),
        };
        Turn::from_turns(turns + turns_per_mm * chord.length_squared().sqrt())
    }

    /// The frame of a yarn that is [steep](crate::Layout::is_steep) or not. A steep yarn has the
    /// rotation minimising frame, because an upright one would twist its tube sharply.
    #[must_use]
    #[inline]
    pub const fn of(self, steep: bool) -> Self {
        if steep { Self::RotationMinimizing } else { self }
    }

    /// Whether every roll of a yarn with this twist (in any unit) is zero, so that there is nothing
    /// to scan.
    #[must_use]
    #[inline]
    pub fn is_level(self, twist: f32) -> bool {
        self == Self::Upright && twist == 0.0
    }
}

/// The angle, as a fraction of a turn, from the next ring's upright side to this ring's upright
/// side as it is carried to the next ring.
#[inline]
fn transport_turns(tangent: Vec3, next_tangent: Vec3, chord: Vec3) -> f32 {
    let side = Basis::upright(tangent).side;
    // If two rings coincide, the tangent is used as the chord. The two reflections are then the
    // smallest turn from one tangent to the next.
    let length_squared = chord.length_squared();
    let (mirror, mirror_squared) =
        if length_squared > NO_LENGTH { (chord, length_squared) } else { (tangent, 1.0) };
    let side = reflect(side, mirror, mirror_squared);
    let reflected_tangent = reflect(tangent, mirror, mirror_squared);
    // At a hairpin the second reflection is the identity.
    let mirror = next_tangent - reflected_tangent;
    let mirror_squared = mirror.length_squared();
    let side = if mirror_squared > NO_MIRROR { reflect(side, mirror, mirror_squared) } else { side };
    let next = Basis::upright(next_tangent);
    atan2_turns(side.dot(next.up), side.dot(next.side))
}

/// `v` mirrored in the plane at right angles to `mirror`.
#[inline]
fn reflect(v: Vec3, mirror: Vec3, mirror_squared: f32) -> Vec3 {
    v - mirror * (2.0 * v.dot(mirror) / mirror_squared)
}
