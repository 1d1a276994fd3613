//! The settings of a mesh.

use crate::{Frame, Quantum, Topology};

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
