//! glTF 2.0 binary: a header, a JSON document, and the buffer that it describes.
//!
//! Source: Khronos Group, "glTF 2.0 Specification", section 4.4 for the container.

mod compressed;
mod document;
mod form;
mod grid;
mod json;
mod meshopt;
mod schema;

use std::borrow::Borrow;
use std::io::{Seek, Write};

pub(super) use compressed::CompressedGlbWriter;
use document::Document;
use form::VertexForm;
use grid::Grid;
use texere_core::backend::{Chunk, Plan};
use texere_core::{Material, Vertex};

use super::WriteError;
use super::bounds::Bounds;
use super::mesh_writer::{MeshWriter, Run, yarn_runs};
use super::places::Places;
use super::target::Target;

/// The largest file, bytes. The header holds a file's length in a `u32`.
const BYTES_MAX: u64 = u32::MAX as u64;

/// Bytes of the header: magic, version and length of the file.
const HEADER_BYTES: u64 = 12;

/// Bytes of a chunk's header: length and type of the chunk.
const CHUNK_HEADER_BYTES: u64 = 8;

/// The number of vertices that are packed at a time. Their copies take 150 kB.
const BATCH: usize = 4096;

/// A GLB file that is being written.
///
/// The document comes first in the file, but states the bounds of every tube and cap. These are
/// known only when all vertices have come. The document is therefore written twice: at first to
/// reserve its place, and at the end with the bounds. The document's length does not depend on the
/// bounds.
#[derive(Debug)]
pub(super) struct GlbWriter<W: Write + Seek> {
    target: Target<W>,
    document: Document,
    /// The byte at which the vertices begin.
    vertices_at: u64,
    vertex_bytes: u64,
    sides: u32,
    /// The grid of each yarn, if vertices are packed.
    grids: Option<Vec<Grid>>,
}

impl<W: Write + Seek> GlbWriter<W> {
    /// Starts a file. If there are `bounds`, the boxes of all yarns, vertices are packed.
    pub(super) fn start(
        mut target: Target<W>,
        plan: &Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &[Material],
        bounds: Option<&Bounds>,
    ) -> Result<Self, WriteError> {
        let form = if bounds.is_some() { VertexForm::packed() } else { VertexForm::plain() };
        let (document, grids) = describe(plan, chunks, materials, &form, bounds)?;
        begin(&document, &mut target)?;
        document.pattern(plan, |corners| target.write_words(corners))?;
        let vertices_at = target.position();
        let (vertex_bytes, sides) = (form.bytes(), plan.settings().sides);
        Ok(Self { target, document, vertices_at, vertex_bytes, sides, grids })
    }
}

impl<W: Write + Seek> MeshWriter<W> for GlbWriter<W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        self.target.go_to(self.vertices_at + run.place * self.vertex_bytes)?;
        let Some(grids) = &self.grids else {
            self.document.include(run.place, run.vertices);
            return self.target.write_words(bytemuck::cast_slice(run.vertices));
        };
        each_stepped(grids, self.sides, &run, |place, stepped| {
            self.document.include(place, stepped);
            let bytes = stepped.iter().flat_map(|vertex| {
                let normal = grid::packed_normal(vertex.normal);
                grid::packed_position(vertex.position).into_iter().chain(normal)
            });
            self.target.write(&bytes.collect::<Vec<_>>())
        })
    }

    /// Nothing is left to write: all triangles are in the pattern, which is written first.
    fn triangles(&mut self, _: &Chunk, _: &Places) -> Result<(), WriteError> {
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<Target<W>, WriteError> {
        self.target.go_to(HEADER_BYTES + CHUNK_HEADER_BYTES)?;
        self.target.write(self.document.to_json().as_bytes())?;
        Ok(self.target)
    }
}

/// The document of a mesh, and the grids of its yarns if there are `bounds`.
///
/// **Errors**: [`WriteError::TooLongToPack`] and [`WriteError::GlbTooLarge`].
fn describe(
    plan: &Plan,
    chunks: impl Iterator<Item = impl Borrow<Chunk>>,
    materials: &[Material],
    form: &VertexForm,
    bounds: Option<&Bounds>,
) -> Result<(Document, Option<Vec<Grid>>), WriteError> {
    // The size is checked first, because there may be millions of chunks to go through.
    check(plan.counts().vertices * form.bytes())?;
    let grids = bounds.map(Grid::all).transpose()?;
    let document = Document::new(plan, chunks, materials, form, grids.as_deref());
    check(document.buffer_bytes())?;
    Ok((document, grids))
}

/// Writes everything that comes before the buffer.
///
/// **Errors**: [`WriteError::GlbTooLarge`] before a byte is written.
fn begin<W: Write>(document: &Document, target: &mut Target<W>) -> Result<(), WriteError> {
    let json = document.to_json();
    let bytes = HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + json.len() as u64 + document.buffer_bytes();
    check(bytes)?;
    target.write(b"glTF")?;
    target.write_words(&[2, bytes as u32, json.len() as u32])?;
    target.write(b"JSON")?;
    target.write(json.as_bytes())?;
    target.write_words(&[document.buffer_bytes() as u32])?;
    target.write(b"BIN\0")
}

/// Calls `each` with the vertices of a run, some thousand at a time, and the number of their first
/// in the file. Their positions are in steps of their yarn's grid.
fn each_stepped(
    grids: &[Grid],
    sides: u32,
    run: &Run<'_>,
    mut each: impl FnMut(u64, &[Vertex]) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    for (yarn, own) in yarn_runs(run.chunk, sides, run.first, run.vertices.len()) {
        let (grid, mut place) = (&grids[yarn as usize], run.place + own.start as u64);
        for vertices in run.vertices[own].chunks(BATCH) {
            each(place, &vertices.iter().map(|vertex| grid.stepped(vertex)).collect::<Vec<_>>())?;
            place += vertices.len() as u64;
        }
    }
    Ok(())
}

fn check(bytes: u64) -> Result<(), WriteError> {
    if bytes > BYTES_MAX {
        return Err(WriteError::GlbTooLarge { bytes, limit: BYTES_MAX });
    }
    Ok(())
}
