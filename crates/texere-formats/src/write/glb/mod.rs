//! glTF 2.0 binary: a header, a JSON document, and the buffer that it describes.
//!
//! Source: Khronos Group, "glTF 2.0 Specification", section 4.4 for the container.

mod column;
mod compressed;
mod document;
mod form;
mod grid;
mod instanced;
mod instanced_document;
mod json;
mod meshopt;
mod parts;
mod schema;
mod start;

use std::borrow::Borrow;
use std::io::{Seek, Write};

use column::corners;
pub(super) use compressed::CompressedGlbWriter;
use document::Document;
use form::VertexForm;
use grid::{Grid, stepped};
pub(super) use instanced::InstancedGlbWriter;
use start::{DOCUMENT_AT, Start, begin, text};
use texere_core::Material;
use texere_core::backend::{Chunk, Plan};

use super::WriteError;
use super::bounds::Bounds;
use super::corners::Corners;
use super::mesh_form::MeshForm;
use super::mesh_writer::{MeshWriter, Run};
use super::places::Places;
use super::target::Target;

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
    form: VertexForm,
    corners: Corners,
    /// The grid of each yarn, if vertices are packed.
    grids: Option<Vec<Grid>>,
}

impl<W: Write + Seek> GlbWriter<W> {
    /// Starts a file. A packed `form` needs `bounds`, the boxes of all yarns.
    pub(super) fn start(
        mut target: Target<W>,
        plan: &Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &[Material],
        form: MeshForm,
        bounds: Option<&Bounds>,
    ) -> Result<Self, WriteError> {
        let Start { document, form, corners, grids } = Start::new(plan, chunks, materials, form, bounds)?;
        begin(document.gltf(), &mut target)?;
        document.pattern(plan, |corners| target.write_words(corners))?;
        let vertices_at = target.position();
        Ok(Self { target, document, vertices_at, form, corners, grids })
    }
}

impl<W: Write + Seek> MeshWriter<W> for GlbWriter<W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        let (grids, vertex_bytes) = (self.grids.as_deref(), self.form.bytes());
        self.corners.each(&run, |batch| {
            self.target.go_to(self.vertices_at + batch.place * vertex_bytes)?;
            if self.form.is_as_in_memory() {
                self.document.include(batch.place, batch.vertices);
                return self.target.write_words(bytemuck::cast_slice(batch.vertices));
            }
            let vertices = stepped(grids, &batch);
            self.document.include(batch.place, &vertices);
            let mut bytes = Vec::with_capacity(vertices.len() * vertex_bytes as usize);
            for corner in corners(&vertices, &batch) {
                self.form.columns.iter().for_each(|column| (column.write)(&corner, &mut bytes));
            }
            self.target.write(&bytes)
        })
    }

    /// Nothing is left to write: all triangles are in the pattern, which is written first.
    fn triangles(&mut self, _: &Chunk, _: &Places) -> Result<(), WriteError> {
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<Target<W>, WriteError> {
        self.target.go_to(DOCUMENT_AT)?;
        self.target.write(text(self.document.gltf()).as_bytes())?;
        Ok(self.target)
    }
}
