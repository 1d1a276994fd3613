//! Counts of everything that a plan makes.

use crate::Vertex;

/// The counts of everything that a plan makes, before it is cut into chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Yarns.
    pub yarns: u64,
    /// Control points.
    pub control_points: u64,
    /// Rings of all yarns.
    pub rings: u64,
    /// Vertices, caps included.
    pub vertices: u64,
    /// Triangles that are drawn, caps included.
    pub triangles: u64,
    /// Indices that are stored. With [`Topology::Shared`](crate::Topology::Shared) they are far
    /// fewer than three per triangle.
    pub indices: u64,
}

impl Counts {
    /// The bytes of the mesh: 24 per vertex, 4 per index.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.vertices * size_of::<Vertex>() as u64 + self.indices * 4
    }
}
