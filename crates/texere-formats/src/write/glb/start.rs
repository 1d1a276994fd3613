//! What all kinds of GLB files begin with: the header and the document, up to the buffer.

use std::borrow::Borrow;
use std::io::Write;

use texere_core::Material;
use texere_core::backend::{Chunk, Plan};

use super::document::Document;
use super::form::VertexForm;
use super::grid::Grid;
use super::json::Json;
use super::schema::Gltf;
use crate::write::WriteError;
use crate::write::bounds::Bounds;
use crate::write::corners::Corners;
use crate::write::mesh_form::MeshForm;
use crate::write::places::RingForm;
use crate::write::target::Target;

/// The largest file, bytes. The header holds a file's length in a `u32`.
const BYTES_MAX: u64 = u32::MAX as u64;

/// Bytes of the header: magic, version and length of the file.
const HEADER_BYTES: u64 = 12;

/// Bytes of a chunk's header: length and type of the chunk.
const CHUNK_HEADER_BYTES: u64 = 8;

/// The byte at which the document begins.
pub(super) const DOCUMENT_AT: u64 = HEADER_BYTES + CHUNK_HEADER_BYTES;

/// What a file is begun with.
pub(super) struct Start {
    pub(super) document: Document,
    pub(super) form: VertexForm,
    pub(super) corners: Corners,
    /// The grid of each yarn, if vertices are packed.
    pub(super) grids: Option<Vec<Grid>>,
}

impl Start {
    /// **Errors**: [`WriteError::TooLongToPack`] and [`WriteError::GlbTooLarge`].
    pub(super) fn new(
        plan: &Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &[Material],
        form: MeshForm,
        bounds: Option<&Bounds>,
    ) -> Result<Self, WriteError> {
        let ring = RingForm::new(plan, form.has_seam());
        let corners = Corners::new(plan, form.attributes, ring);
        let form = VertexForm::new(form);
        // The size is checked first, because there may be millions of chunks to go through.
        check(ring.vertices(plan) * form.bytes())?;
        let grids = bounds.map(Grid::all).transpose()?;
        let document = Document::new(plan, chunks, materials, &form, ring, grids.as_deref());
        check(document.buffer_bytes())?;
        Ok(Self { document, form, corners, grids })
    }
}

/// Writes everything that comes before the buffer.
///
/// **Errors**: [`WriteError::GlbTooLarge`] before a byte is written.
pub(super) fn begin<W: Write>(gltf: &Gltf, target: &mut Target<W>) -> Result<(), WriteError> {
    let (json, buffer_bytes) = (text(gltf), gltf.buffers[0].byte_length);
    let bytes = HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + json.len() as u64 + buffer_bytes;
    check(bytes)?;
    target.write(b"glTF")?;
    target.write_words(&[2, bytes as u32, json.len() as u32])?;
    target.write(b"JSON")?;
    target.write(json.as_bytes())?;
    target.write_words(&[buffer_bytes as u32])?;
    target.write(b"BIN\0")
}

/// The document as text. Its length is a multiple of four, and does not depend on its floats.
pub(super) fn text(gltf: &Gltf) -> String {
    let mut text = String::new();
    gltf.write(&mut text);
    let padding = text.len().next_multiple_of(4) - text.len();
    text.extend(std::iter::repeat_n(' ', padding));
    text
}

fn check(bytes: u64) -> Result<(), WriteError> {
    if bytes > BYTES_MAX {
        return Err(WriteError::GlbTooLarge { bytes, limit: BYTES_MAX });
    }
    Ok(())
}
