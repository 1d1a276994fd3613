//! The settings of a mesh.

use super::PlanError;
use crate::definitions::SIDES_MAX;
use crate::section::SIDES_MIN;
use crate::{Frame, Quantum, Section, Topology};

/// The choices that a mesh is made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Number of points inserted between two control points (the paper's K).
    pub subdivisions: u32,
    /// Number of sides of the tube (the paper's nc).
    pub sides: u32,
    /// The orientation of sections.
    pub frame: Frame,
    /// The encoding of triangles.
    pub topology: Topology,
    /// Whether the ends of open yarns are closed with caps, which make every yarn watertight.
    pub caps: bool,
    /// The step of the grid that [packed](crate::PackedVertex) positions lie on.
    pub quantum: Quantum,
}

impl Default for Settings {
    /// The settings of the paper: K = 1, nc = 6, no caps. Packed positions lie on a grid of 2⁻¹²
    /// mm.
    fn default() -> Self {
        Self {
            subdivisions: 1,
            sides: 6,
            frame: Frame::Upright,
            topology: Topology::Indexed,
            caps: false,
            quantum: Quantum::USUAL,
        }
    }
}

/// Checks whether yarns with these `sections` can be meshed as tubes with so many `sides`.
/// [`Plan::new`](crate::backend::Plan::new) makes this check, too. A program can call the function
/// earlier, before cloth comes to rest.
///
/// ```
/// use texere_core::{PlanError, Section, check_sides};
/// let square = Section::Polygon([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]].into());
/// assert!(check_sides(4, &[Section::Circle, square.clone()]).is_ok());
/// let refused = check_sides(6, &[Section::Circle, square]);
/// assert_eq!(refused, Err(PlanError::PolygonSides { section: 1, corners: 4, sides: 6 }));
/// ```
///
/// **Errors**: [`PlanError::Sides`] and [`PlanError::PolygonSides`].
pub fn check_sides(sides: u32, sections: &[Section]) -> Result<(), PlanError> {
    if !(SIDES_MIN..=SIDES_MAX).contains(&sides) {
        return Err(PlanError::Sides { sides, low: SIDES_MIN, high: SIDES_MAX });
    }
    for (section, shape) in sections.iter().enumerate() {
        match shape {
            Section::Polygon(corners) if corners.len() != sides as usize => {
                return Err(PlanError::PolygonSides { section, corners: corners.len(), sides });
            }
            _ => {}
        }
    }
    Ok(())
}
