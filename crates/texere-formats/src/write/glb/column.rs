//! Properties of vertices, and their bytes in a GLB file.

use texere_core::Vertex;

use super::grid::{packed_direction, packed_position};
use super::meshopt::octahedral;
use super::schema::{BYTE, FLOAT, SHORT};
use crate::write::corners::{Batch, Surface};

/// A property of vertices, as accessors describe it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// The name by which primitives refer to the property.
    pub(super) semantic: &'static str,
    /// Bytes of the property of one vertex, with padding: a multiple of four.
    pub(super) bytes: u64,
    /// The kind of numbers.
    pub(super) kind: u32,
    /// Whether whole numbers stand for shares of 1. None for floats, and for whole numbers that are
    /// steps of a grid.
    pub(super) normalized: Option<bool>,
    pub(super) shape: &'static str,
    /// The filter of the compressed property.
    pub(super) filter: Option<&'static str>,
    /// Appends the bytes of the property.
    pub(super) write: fn(&Corner<'_>, &mut Vec<u8>),
}

/// A vertex with everything that a file may hold of it.
#[derive(Debug)]
pub(super) struct Corner<'a> {
    /// The vertex. If positions are packed, its position is in steps of the yarn's grid.
    pub(super) vertex: &'a Vertex,
    pub(super) surface: Surface,
    pub(super) yarn: u32,
}

/// Positions, mm.
pub(super) const POSITIONS: Column = Column {
    semantic: "POSITION",
    bytes: 12,
    kind: FLOAT,
    normalized: None,
    shape: "VEC3",
    filter: None,
    write: |corner, bytes| floats(&corner.vertex.position, bytes),
};

/// Positions in steps of a grid.
pub(super) const PACKED_POSITIONS: Column = Column {
    bytes: 8,
    kind: SHORT,
    write: |corner, bytes| bytes.extend(packed_position(corner.vertex.position)),
    ..POSITIONS
};

pub(super) const NORMALS: Column =
    Column { semantic: "NORMAL", write: |corner, bytes| floats(&corner.vertex.normal, bytes), ..POSITIONS };

/// Normals in steps of 1/127.
pub(super) const PACKED_NORMALS: Column = Column {
    bytes: 4,
    kind: BYTE,
    normalized: Some(true),
    write: |corner, bytes| bytes.extend(packed_direction(corner.vertex.normal, 0)),
    ..NORMALS
};

/// Packed normals before the filter of the extension.
pub(super) const OCTAHEDRAL_NORMALS: Column = Column {
    filter: Some("OCTAHEDRAL"),
    write: |corner, bytes| bytes.extend(octahedral(corner.vertex.normal, 0)),
    ..PACKED_NORMALS
};

/// Texture coordinates.
pub(super) const COORDINATES: Column = Column {
    semantic: "TEXCOORD_0",
    bytes: 8,
    shape: "VEC2",
    write: |corner, bytes| floats(&corner.surface.uv, bytes),
    ..POSITIONS
};

/// Tangents, and the sign of bitangents.
pub(super) const TANGENTS: Column = Column {
    semantic: "TANGENT",
    bytes: 16,
    shape: "VEC4",
    write: |corner, bytes| {
        floats(&corner.surface.tangent, bytes);
        floats(&[corner.surface.sign], bytes);
    },
    ..POSITIONS
};

/// Tangents in steps of 1/127.
pub(super) const PACKED_TANGENTS: Column = Column {
    bytes: 4,
    kind: BYTE,
    normalized: Some(true),
    write: |corner, bytes| bytes.extend(packed_direction(corner.surface.tangent, sign(&corner.surface))),
    ..TANGENTS
};

/// Packed tangents before the filter of the extension.
pub(super) const OCTAHEDRAL_TANGENTS: Column = Column {
    filter: Some("OCTAHEDRAL"),
    write: |corner, bytes| bytes.extend(octahedral(corner.surface.tangent, sign(&corner.surface))),
    ..PACKED_TANGENTS
};

/// Numbers of yarns. glTF has no vertices with 32-bit whole numbers. Floats number 16,777,216 yarns
/// without gaps, and the nodes of that many take more than the 4 GiB of a file.
pub(super) const YARNS: Column = Column {
    semantic: "_YARN",
    bytes: 4,
    shape: "SCALAR",
    write: |corner, bytes| floats(&[corner.yarn as f32], bytes),
    ..POSITIONS
};

/// The `vertices` of a batch with their attributes.
pub(super) fn corners<'a>(vertices: &'a [Vertex], batch: &'a Batch<'_>) -> impl Iterator<Item = Corner<'a>> {
    let with = |(vertex, surface)| Corner { vertex, surface, yarn: batch.yarn };
    vertices.iter().zip(batch.surfaces()).map(with)
}

fn floats(floats: &[f32], bytes: &mut Vec<u8>) {
    floats.iter().for_each(|float| bytes.extend(float.to_le_bytes()));
}

/// The sign of a bitangent in steps of 1/127.
fn sign(surface: &Surface) -> i8 {
    if surface.sign < 0.0 { -127 } else { 127 }
}
