//! Counts of everything that a plan makes.

use crate::Vertex;

/// The counts of everything that a plan makes, before it is cut into chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of yarns.
    pub yarns: u64,
    /// Number of control points.
    pub control_points: u64,
    /// Number of rings of all yarns.
    pub rings: u64,
    /// Number of vertices, caps included.
    pub vertices: u64,
    /// Number of triangles that are drawn, caps included.
    pub triangles: u64,
    /// Number of indices that are stored. With [`Topology::Shared`](crate::Topology::Shared) it is
    /// usually far less than three per triangle.
    pub indices: u64,
}

impl Counts {
    /// The bytes of the mesh: 24 per vertex and 4 per index.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.vertices * size_of::<Vertex>() as u64 + self.indices * 4
    }
}
