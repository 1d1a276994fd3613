//! Feeds a mesh to a format's writer, and checks that every vertex comes once and in order, and is
//! finite.

use std::borrow::Borrow;
use std::io::{Seek, Write};

use texere_core::backend::{Chunk, Plan};
use texere_core::{Material, Vertex};

use super::Format;
use super::WriteError;
use super::bounds::Bounds;
#[cfg(feature = "glb")]
use super::glb::{CompressedGlbWriter, GlbWriter, InstancedGlbWriter};
use super::mesh_form::MeshForm;
use super::mesh_writer::{MeshWriter, Run, yarn_runs};
#[cfg(feature = "obj")]
use super::obj::{ObjWriter, library_name};
use super::places::{Places, RingForm};
#[cfg(feature = "ply")]
use super::ply::PlyWriter;
#[cfg(feature = "stl")]
use super::stl::StlWriter;
use super::target::Target;
use super::usd_mesh::UsdMeshWriter;

/// Starts a file of `form`.
fn writer<'a, W: Write + Seek + 'a>(
    form: MeshForm,
    target: Target<W>,
    plan: &'a Plan,
    chunks: impl Iterator<Item = impl Borrow<Chunk>>,
    materials: &'a [Material],
    bounds: Option<&Bounds>,
) -> Result<Box<dyn MeshWriter<W> + 'a>, WriteError> {
    match form.format {
        #[cfg(feature = "glb")]
        Format::Glb | Format::PackedGlb => {
            Ok(Box::new(GlbWriter::start(target, plan, chunks, materials, form, bounds)?))
        }
        #[cfg(feature = "glb")]
        Format::CompressedGlb | Format::KhrCompressedGlb => {
            Ok(Box::new(CompressedGlbWriter::start(target, plan, chunks, materials, form, bounds)?))
        }
        #[cfg(feature = "glb")]
        Format::InstancedGlb => {
            Ok(Box::new(InstancedGlbWriter::start(target, plan, materials, form, bounds)?))
        }
        #[cfg(feature = "ply")]
        Format::Ply => Ok(Box::new(PlyWriter::start(target, plan, materials, form)?)),
        #[cfg(feature = "stl")]
        Format::Stl => Ok(Box::new(StlWriter::start(target, plan)?)),
        #[cfg(feature = "obj")]
        Format::Obj => {
            let library = library_name(target.path());
            Ok(Box::new(ObjWriter::start(target, plan, chunks, materials, &library)?))
        }
        Format::Usda => Ok(Box::new(UsdMeshWriter::start(target, plan, chunks, materials, form)?)),
        #[cfg(not(all(feature = "glb", feature = "ply", feature = "stl", feature = "obj")))]
        format => Err(WriteError::Feature { format: format.extension(), feature: format.extension() }),
    }
}

/// Checks that a mesh of `plan` can be written with `materials`, before any work is done for it.
pub(super) fn check(plan: &Plan, materials: &[Material]) -> Result<(), WriteError> {
    for (yarn, each) in plan.layout().yarns().iter().enumerate() {
        if each.material as usize >= materials.len() {
            let (material, materials) = (each.material, materials.len());
            return Err(WriteError::UnknownMaterial { yarn, material, materials });
        }
    }
    if plan.counts().triangles == 0 {
        return Err(WriteError::Empty);
    }
    Ok(())
}

/// A mesh file that is being written, and the number of vertices that have come.
pub(super) struct Feed<'a, W: Write + Seek> {
    writer: Box<dyn MeshWriter<W> + 'a>,
    places: Places,
    sides: u32,
    /// Whether the next chunk begins with a ring that the chunk before repeats.
    goes_on: bool,
    given: u64,
    planned: u64,
}

impl<'a, W: Write + Seek + 'a> Feed<'a, W> {
    /// Starts a file for the mesh of `plan`, cut into `chunks`. [`check`] has passed. There are
    /// `bounds` of all yarns if the format needs them.
    pub(super) fn open(
        form: MeshForm,
        target: Target<W>,
        plan: &'a Plan,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        materials: &'a [Material],
        bounds: Option<&Bounds>,
    ) -> Result<Self, WriteError> {
        let sides = plan.settings().sides;
        let (mut planned, mut repeated) = (0, 0);
        let mut chunks = chunks.into_iter().inspect(|chunk| {
            let chunk = chunk.borrow();
            planned += u64::from(chunk.vertices());
            repeated += u64::from(chunk.repeats_ring()) * u64::from(sides);
        });
        let writer = writer(form, target, plan, &mut chunks, materials, bounds)?;
        // Chunks that the writer has not gone through count as well.
        chunks.for_each(drop);
        // If the plan has room for more control points (`Plan::with_room`), its chunks have more
        // vertices than the mesh.
        let given = planned - repeated;
        if given != plan.counts().vertices {
            return Err(WriteError::VertexCount { given, planned: plan.counts().vertices });
        }
        let places = Places::new(plan, RingForm::new(plan, form.has_seam()));
        Ok(Self { writer, places, sides, goes_on: false, given: 0, planned })
    }

    /// Passes `vertices` to the writer. They are those of `chunk` from number `first` on.
    pub(super) fn vertices(
        &mut self,
        chunk: &Chunk,
        first: u32,
        vertices: &[Vertex],
    ) -> Result<(), WriteError> {
        if vertices.is_empty() {
            return Ok(());
        }
        if chunk.first_vertex() + u64::from(first) != self.given {
            return Err(WriteError::VertexCount { given: self.given, planned: self.planned });
        }
        let floats: &[f32] = bytemuck::cast_slice(vertices);
        if let Some(float) = floats.iter().position(|float| !float.is_finite()) {
            let place = float / 6;
            let mut runs = yarn_runs(chunk, self.sides, first, vertices.len());
            let yarn = runs.find(|(_, run)| run.contains(&place)).map_or(0, |(yarn, _)| yarn);
            return Err(WriteError::NotFinite { vertex: self.given + place as u64, yarn });
        }
        self.given += vertices.len() as u64;
        let end = first + vertices.len() as u32;
        // A repeated ring is written with the next chunk.
        let [tubes, rings] =
            [u32::from(chunk.repeats_ring()), 0].map(|left| (chunk.rings() - left) * self.sides);
        for own in [0..tubes, rings..chunk.vertices()] {
            let (from, to) = (own.start.max(first), own.end.min(end));
            if from < to {
                let vertices = &vertices[(from - first) as usize..(to - first) as usize];
                self.writer.vertices(Run {
                    chunk,
                    goes_on: self.goes_on,
                    first: from,
                    place: self.places.of(chunk, from),
                    vertices,
                })?;
            }
        }
        if end == chunk.vertices() {
            self.writer.triangles(chunk, &self.places)?;
            self.places.pass(chunk);
            self.goes_on = chunk.repeats_ring();
        }
        Ok(())
    }

    /// The number of vertices of all chunks together.
    pub(super) fn planned(&self) -> u64 {
        self.planned
    }

    /// Completes the file, unless vertices are missing.
    pub(super) fn finish(self) -> Result<Target<W>, WriteError> {
        if self.given != self.planned {
            return Err(WriteError::VertexCount { given: self.given, planned: self.planned });
        }
        self.writer.finish()
    }
}
