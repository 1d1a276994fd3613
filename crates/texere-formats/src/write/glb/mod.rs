//! glTF 2.0 binary: a header, a JSON document, and the buffer that it describes.
//!
//! Source: Khronos Group, "glTF 2.0 Specification", section 4.4 for the container.

mod document;
mod grid;
mod json;
mod schema;

use std::borrow::Borrow;
use std::io::{Seek, Write};

use document::Document;
use grid::{Grid, PackedBytes};
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
        // The size is checked first, because there may be millions of chunks to go through.
        let vertex_bytes = if bounds.is_some() { size_of::<PackedBytes>() } else { size_of::<Vertex>() };
        check(plan.counts().vertices * vertex_bytes as u64)?;
        let grids = bounds.map(Grid::all).transpose()?;
        let document = Document::new(plan, chunks, materials, grids.as_deref());
        check(document.buffer_bytes())?;
        let json = document.to_json();
        let bytes = HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + json.len() as u64 + document.buffer_bytes();
        check(bytes)?;
        target.write(b"glTF")?;
        target.write_words(&[2, bytes as u32, json.len() as u32])?;
        target.write(b"JSON")?;
        target.write(json.as_bytes())?;
        target.write_words(&[document.buffer_bytes() as u32])?;
        target.write(b"BIN\0")?;
        document.write_pattern(plan, &mut target)?;
        let vertices_at = target.position();
        Ok(Self { target, document, vertices_at, sides: plan.settings().sides, grids })
    }
}

impl<W: Write + Seek> MeshWriter<W> for GlbWriter<W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        let Some(grids) = &self.grids else {
            self.document.include(run.place, run.vertices);
            self.target.go_to(self.vertices_at + run.place * size_of::<Vertex>() as u64)?;
            return self.target.write_words(bytemuck::cast_slice(run.vertices));
        };
        self.target.go_to(self.vertices_at + run.place * size_of::<PackedBytes>() as u64)?;
        for (yarn, own) in yarn_runs(run.chunk, self.sides, run.first, run.vertices.len()) {
            let (grid, mut place) = (&grids[yarn as usize], run.place + own.start as u64);
            for vertices in run.vertices[own].chunks(BATCH) {
                let stepped: Vec<_> = vertices.iter().map(|vertex| grid.stepped(vertex)).collect();
                self.document.include(place, &stepped);
                self.target.write(stepped.iter().map(grid::packed).collect::<Vec<_>>().as_flattened())?;
                place += vertices.len() as u64;
            }
        }
        Ok(())
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

fn check(bytes: u64) -> Result<(), WriteError> {
    if bytes > BYTES_MAX {
        return Err(WriteError::GlbTooLarge { bytes, limit: BYTES_MAX });
    }
    Ok(())
}
