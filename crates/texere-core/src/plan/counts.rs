//! How many of everything a plan makes.

use crate::Vertex;

/// How many of everything a plan makes, uncut.
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
    /// Triangles that get drawn, caps included.
    pub triangles: u64,
    /// Indices that are stored; with [`Topology::Shared`](crate::Topology::Shared) far fewer than
    /// three a triangle.
    pub indices: u64,
}

impl Counts {
    /// Bytes of the mesh: 24 a vertex, 4 an index.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.vertices * size_of::<Vertex>() as u64 + self.indices * 4
    }
}
