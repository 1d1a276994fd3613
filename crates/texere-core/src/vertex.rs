//! The vertex of a mesh.

use bytemuck::{Pod, Zeroable};

/// A vertex of a tube.
///
/// **Shape**: six `f32`, 24 bytes. **Units**: mm. The normal is a unit vector that points out of
/// the yarn.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Vertex {
    /// The position, mm.
    pub position: [f32; 3],
    /// The outward unit normal.
    pub normal: [f32; 3],
}

const _: () = assert!(size_of::<Vertex>() == 24 && std::mem::offset_of!(Vertex, normal) == 12);
