//! Binary PLY: one list of vertices, one list of triangles.
//!
//! Source: Greg Turk, "The PLY Polygon File Format", 1994. Colours are the yarns' sRGB values,
//! which readers expect.

use std::io::{Seek, Write};

use texere_core::Material;
use texere_core::backend::{Chunk, Plan};
use texere_core::definitions::index_pattern;

use super::WriteError;
use super::mesh_writer::{MeshWriter, Run, yarn_runs};
use super::places::Places;
use super::target::Target;

/// Bytes of a vertex: six floats and three colour bytes.
const VERTEX_BYTES: usize = 27;

/// Bytes of a triangle: a byte for the count of corners, and three vertex numbers.
const FACE_BYTES: usize = 13;

/// The most vertices, which a `u32` numbers and counts.
const VERTICES_MAX: u64 = u32::MAX as u64;

/// A PLY file that is being written.
///
/// The file has all vertices before all faces, and tubes before caps, but the mesh comes chunk by
/// chunk. The file therefore grows in four places. Faces are not left to the end, because they are
/// half of the work: at the end, that half could neither report progress nor be cancelled.
#[derive(Debug)]
pub(super) struct PlyWriter<'a, W: Write + Seek> {
    target: Target<W>,
    plan: &'a Plan,
    materials: &'a [Material],
    /// The quads between a ring and the next.
    quads: Vec<u32>,
    vertices_at: u64,
    next_tube_face_at: u64,
    next_cap_face_at: u64,
}

impl<'a, W: Write + Seek> PlyWriter<'a, W> {
    pub(super) fn start(
        mut target: Target<W>,
        plan: &'a Plan,
        materials: &'a [Material],
    ) -> Result<Self, WriteError> {
        let (counts, sides) = (plan.counts(), plan.settings().sides);
        if counts.vertices > VERTICES_MAX {
            let (format, vertices) = ("PLY", counts.vertices);
            return Err(WriteError::TooManyVertices { format, vertices, limit: VERTICES_MAX });
        }
        let header = header(counts.vertices, counts.triangles);
        target.write(header.as_bytes())?;
        let vertices_at = header.len() as u64;
        let faces_at = vertices_at + counts.vertices * VERTEX_BYTES as u64;
        let caps = counts.vertices / u64::from(sides) - counts.rings;
        let tube_faces = counts.triangles - caps * u64::from(sides - 2);
        Ok(Self {
            target,
            plan,
            materials,
            quads: index_pattern(sides),
            vertices_at,
            next_tube_face_at: faces_at,
            next_cap_face_at: faces_at + tube_faces * FACE_BYTES as u64,
        })
    }

    /// Writes the triangles of `corners`, which count from vertex `base`.
    fn faces(&mut self, base: u64, corners: &[u32]) -> Result<(), WriteError> {
        for corners in corners.chunks_exact(3) {
            let mut face = [3; FACE_BYTES];
            for (bytes, corner) in face[1..].chunks_exact_mut(4).zip(corners) {
                // The sum fits, because the number of all vertices was checked.
                bytes.copy_from_slice(&((base + u64::from(*corner)) as u32).to_le_bytes());
            }
            self.target.write(&face)?;
        }
        Ok(())
    }
}

impl<W: Write + Seek> MeshWriter<W> for PlyWriter<'_, W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        self.target.go_to(self.vertices_at + run.place * VERTEX_BYTES as u64)?;
        let sides = self.plan.settings().sides;
        for (yarn, own) in yarn_runs(run.chunk, sides, run.first, run.vertices.len()) {
            let colour = self.materials[self.plan.yarn(yarn as usize).material as usize].srgb;
            for vertex in &run.vertices[own] {
                let mut bytes = [0; VERTEX_BYTES];
                let floats: [f32; 6] = bytemuck::cast(*vertex);
                for (place, float) in bytes.chunks_exact_mut(4).zip(floats) {
                    place.copy_from_slice(&float.to_le_bytes());
                }
                bytes[24..].copy_from_slice(&colour);
                self.target.write(&bytes)?;
            }
        }
        Ok(())
    }

    fn triangles(&mut self, chunk: &Chunk, places: &Places) -> Result<(), WriteError> {
        let quads = std::mem::take(&mut self.quads);
        self.target.go_to(self.next_tube_face_at)?;
        for part in chunk.parts() {
            let first = places.of(chunk, part.first_vertex);
            for gap in 0..u64::from(part.rings) - 1 {
                self.faces(first + gap * u64::from(self.plan.settings().sides), &quads)?;
            }
        }
        self.quads = quads;
        self.next_tube_face_at = self.target.position();
        self.target.go_to(self.next_cap_face_at)?;
        for cap in chunk.caps() {
            let section = self.plan.yarn(cap.yarn as usize).section as usize;
            let corners: Vec<_> = self.plan.cap_indices(section, cap.end).collect();
            self.faces(places.of(chunk, cap.first_vertex), &corners)?;
        }
        self.next_cap_face_at = self.target.position();
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError> {
        Ok(self.target)
    }
}

fn header(vertices: u64, faces: u64) -> String {
    // Some readers do not support unsigned vertex numbers. Signed numbers are written if all
    // numbers fit.
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
