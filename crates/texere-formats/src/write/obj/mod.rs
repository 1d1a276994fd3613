//! OBJ: a text with vertices, their normals and texture coordinates, and triangles. A file of
//! materials (MTL) lies beside it.
//!
//! Source: Wavefront, "Advanced Visualizer Manual", appendix B1, 1995.

mod materials;

use std::borrow::Borrow;
use std::io::{Seek, Write};

use texere_core::Material;
use texere_core::backend::{Chunk, Plan};
use texere_core::definitions::index_pattern;

use super::WriteError;
use super::corners::Corners;
use super::mesh_form::Attributes;
use super::mesh_writer::{MeshWriter, Run};
use super::places::{Places, RingForm};
use super::target::Target;

use materials::material_name;
pub(super) use materials::{LIBRARY, library, library_name};

/// Bytes of a line of three numbers: a keyword of two letters, a space and fifteen bytes for each
/// number, and the line's end. Fifteen bytes hold any float: a sign, nine digits, a point, and an
/// exponent of four bytes.
const THREE_BYTES: u64 = 51;
/// Bytes of a line of two numbers.
const TWO_BYTES: u64 = 35;

/// The most vertices, and the most texture coordinates. The format has no limit, but readers number
/// both with 32 bits and a sign.
const NUMBERS_MAX: u64 = i32::MAX as u64;

/// An OBJ file that is being written.
///
/// OBJ numbers vertices by their order in the file, but the mesh comes chunk by chunk. All lines of
/// a kind therefore have the same length. The place of each line is then known whatever comes
/// first, and the file grows in several places. Positions, normals and texture coordinates of rings
/// stand before those of caps, and triangles of tubes before those of caps.
///
/// The first texture coordinate is the angle round the yarn as a share of a turn. The second is the
/// distance along the yarn, mm. A ring has one more pair of coordinates than it has sides, because
/// the turn begins at 0 and ends at 1. A cap takes the circle that touches the texture's edges.
#[derive(Debug)]
pub(super) struct ObjWriter<'a, W: Write + Seek> {
    target: Target<W>,
    plan: &'a Plan,
    materials: &'a [Material],
    /// The corners of the triangles between a ring and the next, as numbers of the two rings'
    /// vertices.
    quads: Vec<u32>,
    /// The digits of the largest number of a vertex or of texture coordinates.
    digits: usize,
    /// The number of texture coordinates of all rings.
    ring_coordinates: u64,
    /// The byte at which positions begin.
    positions_at: u64,
    /// The byte at which normals begin.
    normals_at: u64,
    /// The byte at which texture coordinates begin.
    coordinates_at: u64,
    /// The byte at which the next triangle of a tube begins.
    next_tube_face_at: u64,
    /// The byte at which the next triangle of a cap begins.
    next_cap_face_at: u64,
    /// The yarn of the last face of a tube, and the yarn of the last face of a cap.
    named: [Option<u32>; 2],
    /// The texture coordinates, which have a seam.
    corners: Corners,
}

impl<'a, W: Write + Seek> ObjWriter<'a, W> {
    /// Starts a file. `library` is the name of the file of materials.
    pub(super) fn start(
        mut target: Target<W>,
        plan: &'a Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &'a [Material],
        library: &str,
    ) -> Result<Self, WriteError> {
        let (counts, sides) = (plan.counts(), u64::from(plan.settings().sides));
        let caps = counts.vertices / sides - counts.rings;
        let ring_coordinates = counts.rings * (sides + 1);
        let coordinates = ring_coordinates + caps * sides;
        if coordinates.max(counts.vertices) > NUMBERS_MAX {
            let (format, vertices) = ("OBJ", coordinates.max(counts.vertices));
            return Err(WriteError::TooManyVertices { format, vertices, limit: NUMBERS_MAX });
        }
        let digits = coordinates.max(counts.vertices).to_string().len();
        let header = format!(
            "# texere {}\n# unit mm; x along the weft or course, y along the warp or wale, z out of the face\n\
             mtllib {library}\n",
            env!("CARGO_PKG_VERSION")
        );
        target.write(header.as_bytes())?;
        let positions_at = header.len() as u64;
        let normals_at = positions_at + counts.vertices * THREE_BYTES;
        let coordinates_at = normals_at + counts.vertices * THREE_BYTES;
        let faces_at = coordinates_at + coordinates * TWO_BYTES;
        let mut writer = Self {
            target,
            plan,
            materials,
            quads: index_pattern(sides as u32),
            digits,
            ring_coordinates,
            positions_at,
            normals_at,
            coordinates_at,
            next_tube_face_at: faces_at,
            next_cap_face_at: faces_at,
            named: [None; 2],
            corners: Corners::new(
                plan,
                Attributes { uv: true, ..Attributes::default() },
                RingForm::new(plan, true),
            ),
        };
        let tube_faces = counts.triangles - caps * (sides - 2);
        writer.next_cap_face_at += tube_faces * writer.face_bytes() + writer.names_bytes(chunks);
        Ok(writer)
    }

    /// Bytes of the line of a triangle.
    fn face_bytes(&self) -> u64 {
        // The line has an `f`, for each corner a space, three numbers and two slashes, and the
        // line's end.
        2 + 3 * (3 + 3 * self.digits as u64)
    }

    /// Bytes of the lines that name the yarns of tubes.
    fn names_bytes(&self, chunks: impl Iterator<Item = impl Borrow<Chunk>>) -> u64 {
        let (mut named, mut bytes) = (None, 0);
        for chunk in chunks {
            for part in chunk.borrow().parts().iter().filter(|part| part.rings > 1) {
                if named.replace(part.yarn) != Some(part.yarn) {
                    bytes += self.name(part.yarn).len() as u64;
                }
            }
        }
        bytes
    }

    /// The lines that name a yarn and its material.
    fn name(&self, yarn: u32) -> String {
        let own = self.plan.yarn(yarn as usize);
        let origin = own.origin.to_string().replace(", ", "_").replace(' ', "_");
        let material = material_name(own.material, self.materials);
        format!("g {origin}_{yarn}\nusemtl {material}\n")
    }

    /// Writes the name of a yarn, unless the last face of this kind belonged to the same yarn.
    /// `kind` is 0 for faces of tubes, and 1 for those of caps.
    fn named(&mut self, kind: usize, yarn: u32) -> Result<(), WriteError> {
        if self.named[kind].replace(yarn) == Some(yarn) {
            return Ok(());
        }
        let name = self.name(yarn);
        self.target.write(name.as_bytes())
    }

    /// Writes a triangle. Each corner has the number of its vertex and the number of its texture
    /// coordinates, both counted from 0.
    fn face(&mut self, corners: [[u64; 2]; 3]) -> Result<(), WriteError> {
        let [one, two, three] = corners.map(|[vertex, at]| format!("{0}/{1}/{0}", vertex + 1, at + 1));
        // Spaces at the end give all these lines the same length.
        let width = self.face_bytes() as usize - 1;
        let line = format!("{:width$}\n", format!("f {one} {two} {three}"));
        self.target.write(line.as_bytes())
    }
}

impl<W: Write + Seek> MeshWriter<W> for ObjWriter<'_, W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        for (at, keyword) in [(self.positions_at, "v "), (self.normals_at, "vn")] {
            self.target.go_to(at + run.place * THREE_BYTES)?;
            for vertex in run.vertices {
                let [x, y, z] = if keyword == "vn" { vertex.normal } else { vertex.position };
                let line = format!("{keyword} {x:15e} {y:15e} {z:15e}\n");
                self.target.write(line.as_bytes())?;
            }
        }
        let Self { corners, target, coordinates_at, .. } = self;
        corners.each(&run, |batch| {
            target.go_to(*coordinates_at + batch.place * TWO_BYTES)?;
            batch.surfaces().try_for_each(|surface| target.write(two(surface.uv).as_bytes()))
        })
    }

    fn triangles(&mut self, chunk: &Chunk, places: &Places) -> Result<(), WriteError> {
        let sides = u64::from(self.plan.settings().sides);
        let quads = std::mem::take(&mut self.quads);
        self.target.go_to(self.next_tube_face_at)?;
        for part in chunk.parts().iter().filter(|part| part.rings > 1) {
            self.named(0, part.yarn)?;
            let first = places.of(chunk, part.first_vertex);
            for gap in 0..u64::from(part.rings) - 1 {
                let base = first + gap * sides;
                for corners in quads.chunks_exact(3) {
                    self.face(tube_corners(base, [corners[0], corners[1], corners[2]], sides))?;
                }
            }
        }
        self.quads = quads;
        self.next_tube_face_at = self.target.position();
        self.target.go_to(self.next_cap_face_at)?;
        for cap in chunk.caps() {
            self.named(1, cap.yarn)?;
            let section = self.plan.yarn(cap.yarn as usize).section as usize;
            let base = places.of(chunk, cap.first_vertex);
            let all_rings = self.plan.counts().rings;
            let of_caps = self.ring_coordinates + base - all_rings * sides;
            let corners: Vec<_> = self.plan.cap_indices(section, cap.end).map(u64::from).collect();
            for corners in corners.chunks_exact(3) {
                self.face([0, 1, 2].map(|corner| [base + corners[corner], of_caps + corners[corner]]))?;
            }
        }
        self.next_cap_face_at = self.target.position();
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError> {
        Ok(self.target)
    }
}

/// Vertices and texture coordinates of a triangle between two rings. Vertex `base` is the first of
/// the first ring. Where the triangles of the last side come back to the ring's first vertex, they
/// take the coordinates of the texture's far edge.
fn tube_corners(base: u64, corners: [u32; 3], sides: u64) -> [[u64; 2]; 3] {
    let side = |corner: u32| u64::from(corner) % sides;
    let closes = corners.iter().any(|&corner| side(corner) == sides - 1)
        && corners.iter().any(|&corner| side(corner) == 0);
    corners.map(|corner| {
        let ring = base / sides + u64::from(corner) / sides;
        let at = if closes && side(corner) == 0 { sides } else { side(corner) };
        [base + u64::from(corner), ring * (sides + 1) + at]
    })
}

/// The line of a pair of texture coordinates.
fn two([turn, along]: [f32; 2]) -> String {
    format!("vt {turn:15e} {along:15e}\n")
}
