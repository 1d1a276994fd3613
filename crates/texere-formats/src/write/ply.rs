//! Binary PLY: one list of vertices, one list of triangles.
//!
//! Source: Greg Turk, "The PLY Polygon File Format", 1994. Colours are the yarns' sRGB values, as readers expect them.

use std::borrow::Borrow;
use std::io::{Seek, Write};

use texere_core::{Chunk, Material, Plan, Vertex};

use super::WriteError;
use super::mesh_writer::{MeshWriter, yarn_runs};
use super::target::Target;

/// Six floats and three colour bytes.
const VERTEX_BYTES: usize = 27;

/// A count of corners in a byte, and three vertex numbers.
const FACE_BYTES: usize = 13;

/// Vertices that a `u32` numbers and counts.
const VERTICES_MAX: u64 = u32::MAX as u64;

/// A PLY file under way.
///
/// In the file all vertices come before all faces, but the mesh comes chunk by chunk. So the file grows in two places. To
/// write all faces at the end would be half of the work, without progress and without a chance to cancel.
#[derive(Debug)]
pub(super) struct PlyWriter<'a, W: Write + Seek> {
    target: Target<W>,
    plan: &'a Plan,
    materials: &'a [Material],
    pattern: Vec<u32>,
    vertices_at: u64,
    next_face_at: u64,
}

impl<'a, W: Write + Seek> PlyWriter<'a, W> {
    pub(super) fn start(
        mut target: Target<W>,
        plan: &'a Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &'a [Material],
    ) -> Result<Self, WriteError> {
        // First, since there may be millions of chunks to go through.
        check(plan.counts().vertices)?;
        let vertices = chunks.map(|chunk| u64::from(chunk.borrow().vertices())).sum();
        check(vertices)?;
        let header = header(vertices, plan.counts().triangles);
        target.write(header.as_bytes())?;
        let vertices_at = header.len() as u64;
        Ok(Self {
            target,
            plan,
            materials,
            pattern: plan.shared_indices(),
            vertices_at,
            next_face_at: vertices_at + vertices * VERTEX_BYTES as u64,
        })
    }

    fn faces(&mut self, chunk: &Chunk) -> Result<(), WriteError> {
        self.target.go_to(self.next_face_at)?;
        for draw in self.plan.draws(chunk) {
            let range = draw.indices.start as usize..draw.indices.end as usize;
            for corners in self.pattern[range].chunks_exact(3) {
                let mut face = [3; FACE_BYTES];
                for (bytes, corner) in face[1..].chunks_exact_mut(4).zip(corners) {
                    // Fits: all vertices together were checked to.
                    let vertex = (draw.base_vertex + u64::from(*corner)) as u32;
                    bytes.copy_from_slice(&vertex.to_le_bytes());
                }
                self.target.write(&face)?;
                self.next_face_at += FACE_BYTES as u64;
            }
        }
        Ok(())
    }
}

impl<W: Write + Seek> MeshWriter<W> for PlyWriter<'_, W> {
    fn vertices(&mut self, chunk: &Chunk, first: u32, vertices: &[Vertex]) -> Result<(), WriteError> {
        let number = chunk.first_vertex() + u64::from(first);
        self.target.go_to(self.vertices_at + number * VERTEX_BYTES as u64)?;
        for (yarn, run) in yarn_runs(chunk, self.plan.settings().sides, first, vertices.len()) {
            let colour = self.materials[self.plan.yarn(yarn as usize).material as usize].srgb;
            for vertex in &vertices[run] {
                let mut bytes = [0; VERTEX_BYTES];
                let floats: [f32; 6] = bytemuck::cast(*vertex);
                for (place, float) in bytes.chunks_exact_mut(4).zip(floats) {
                    place.copy_from_slice(&float.to_le_bytes());
                }
                bytes[24..].copy_from_slice(&colour);
                self.target.write(&bytes)?;
            }
        }
        if first as usize + vertices.len() == chunk.vertices() as usize {
            self.faces(chunk)?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError> {
        Ok(self.target)
    }
}

fn check(vertices: u64) -> Result<(), WriteError> {
    if vertices > VERTICES_MAX {
        return Err(WriteError::TooManyVertices { vertices, limit: VERTICES_MAX });
    }
    Ok(())
}

fn header(vertices: u64, faces: u64) -> String {
    // Some readers know no unsigned vertex numbers. Signed ones do where all numbers fit.
    let number = if vertices <= 1 << 31 { "int" } else { "uint" };
    format!(
        "ply\n\
         format binary_little_endian 1.0\n\
         comment texere {version}\n\
         comment unit mm; x along the weft or course, y along the warp or wale, z out of the face\n\
         element vertex {vertices}\n\
         property float x\n\
         property float y\n\
         property float z\n\
         property float nx\n\
         property float ny\n\
         property float nz\n\
         property uchar red\n\
         property uchar green\n\
         property uchar blue\n\
         element face {faces}\n\
         property list uchar {number} vertex_indices\n\
         end_header\n",
        version = env!("CARGO_PKG_VERSION"),
    )
}
