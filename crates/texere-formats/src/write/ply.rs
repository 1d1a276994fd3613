//! Binary PLY: one list of vertices, one list of triangles.
//!
//! Source: Greg Turk, "The PLY Polygon File Format", 1994. Colours are the yarns' sRGB values,
//! which readers expect.

use std::io::{Seek, Write};

use texere_core::Material;
use texere_core::backend::{Chunk, Plan};

use super::WriteError;
use super::corners::Corners;
use super::mesh_form::{Attributes, MeshForm};
use super::mesh_writer::{MeshWriter, Run};
use super::places::{Places, RingForm};
use super::target::Target;

/// The most bytes of a vertex: six floats, texture coordinates, a tangent, the number of a yarn and
/// three colour bytes.
const VERTEX_BYTES_MOST: usize = 51;

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
    ring: RingForm,
    attributes: Attributes,
    corners: Corners,
    vertices_at: u64,
    next_tube_face_at: u64,
    next_cap_face_at: u64,
}

impl<'a, W: Write + Seek> PlyWriter<'a, W> {
    pub(super) fn start(
        mut target: Target<W>,
        plan: &'a Plan,
        materials: &'a [Material],
        form: MeshForm,
    ) -> Result<Self, WriteError> {
        let (counts, sides) = (plan.counts(), plan.settings().sides);
        let ring = RingForm::new(plan, form.has_seam());
        let vertices = ring.vertices(plan);
        if vertices > VERTICES_MAX {
            let format = "PLY";
            return Err(WriteError::TooManyVertices { format, vertices, limit: VERTICES_MAX });
        }
        let header = header(vertices, counts.triangles, form.attributes);
        target.write(header.as_bytes())?;
        let vertices_at = header.len() as u64;
        let faces_at = vertices_at + vertices * vertex_bytes(form.attributes);
        let caps = counts.vertices / u64::from(sides) - counts.rings;
        let tube_faces = counts.triangles - caps * u64::from(sides - 2);
        Ok(Self {
            target,
            plan,
            materials,
            ring,
            attributes: form.attributes,
            corners: Corners::new(plan, form.attributes, ring),
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
        let Attributes { uv, tangent, yarn } = self.attributes;
        let vertex_bytes = vertex_bytes(self.attributes);
        let Self { target, plan, materials, corners, vertices_at, .. } = self;
        corners.each(&run, |batch| {
            target.go_to(*vertices_at + batch.place * vertex_bytes)?;
            let colour = materials[plan.yarn(batch.yarn as usize).material as usize].srgb;
            for (vertex, surface) in batch.vertices.iter().zip(batch.surfaces()) {
                let mut bytes = [0; VERTEX_BYTES_MOST];
                let mut end = 0;
                let mut put = |property: &[u8]| {
                    bytes[end..end + property.len()].copy_from_slice(property);
                    end += property.len();
                };
                let mut floats = |floats: &[f32]| floats.iter().for_each(|float| put(&float.to_le_bytes()));
                floats(&bytemuck::cast::<_, [f32; 6]>(*vertex));
                if uv {
                    floats(&surface.uv);
                }
                if tangent {
                    floats(&surface.tangent);
                }
                if yarn {
                    put(&batch.yarn.to_le_bytes());
                }
                put(&colour);
                target.write(&bytes[..end])?;
            }
            Ok(())
        })
    }

    fn triangles(&mut self, chunk: &Chunk, places: &Places) -> Result<(), WriteError> {
        let quads = self.ring.quads();
        self.target.go_to(self.next_tube_face_at)?;
        for part in chunk.parts() {
            let first = places.of(chunk, part.first_vertex);
            for gap in 0..u64::from(part.rings) - 1 {
                self.faces(first + gap * u64::from(self.ring.corners), &quads)?;
            }
        }
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

/// Bytes of a vertex.
fn vertex_bytes(Attributes { uv, tangent, yarn }: Attributes) -> u64 {
    27 + if uv { 8 } else { 0 } + if tangent { 12 } else { 0 } + if yarn { 4 } else { 0 }
}

fn header(vertices: u64, faces: u64, Attributes { uv, tangent, yarn }: Attributes) -> String {
    // Some readers do not support unsigned vertex numbers. Signed numbers are written if all
    // numbers fit.
    let number = if vertices <= 1 << 31 { "int" } else { "uint" };
    let mut properties = ["x", "y", "z", "nx", "ny", "nz"].map(|name| ("float", name)).to_vec();
    if uv {
        properties.extend([("float", "s"), ("float", "t")]);
    }
    if tangent {
        properties.extend([("float", "tx"), ("float", "ty"), ("float", "tz")]);
    }
    if yarn {
        properties.push(("uint", "yarn"));
    }
    properties.extend(["red", "green", "blue"].map(|name| ("uchar", name)));
    let properties: String =
        properties.iter().map(|(kind, name)| format!("property {kind} {name}\n")).collect();
    format!(
        "ply\n\
         format binary_little_endian 1.0\n\
         comment texere {version}\n\
         comment unit mm; x along the weft or course, y along the warp or wale, z out of the face\n\
         element vertex {vertices}\n\
         {properties}\
         element face {faces}\n\
         property list uchar {number} vertex_indices\n\
         end_header\n",
        version = env!("CARGO_PKG_VERSION"),
    )
}
