//! GLB files whose buffer views are compressed.

use std::borrow::Borrow;
use std::io::{Seek, Write};
use std::path::Path;

use texere_core::backend::{Chunk, Plan, SessionError, room_for};
use texere_core::{Material, PipelineError};

use super::column::{Column, corners};
use super::document::Document;
use super::form::VertexForm;
use super::grid::{Grid, stepped};
use super::meshopt::{AttributeEncoder, Differences, Meshopt, TriangleEncoder};
use super::schema::SHORT;
use super::start::{Start, begin};
use crate::write::WriteError;
use crate::write::bounds::Bounds;
use crate::write::corners::Corners;
use crate::write::mesh_form::MeshForm;
use crate::write::mesh_writer::{MeshWriter, Run};
use crate::write::places::{Places, RingForm};
use crate::write::spool::Spool;
use crate::write::target::Target;

/// A compressed GLB file that is being written.
///
/// The document comes first in the file, but states how long each compressed buffer view is. All
/// views are therefore spooled, and the file is written when they are complete. A file that is too
/// large is refused before a byte is written.
#[derive(Debug)]
pub(in crate::write) struct CompressedGlbWriter<W: Write + Seek> {
    target: Target<W>,
    document: Document,
    form: VertexForm,
    corners: Corners,
    grids: Option<Vec<Grid>>,
    /// The compressed index pattern in its parts, one after the other.
    pattern: [Spool; 2],
    /// The compressed columns of the vertices.
    columns: Vec<CompressedColumn>,
    /// The number of the first vertex of a cap.
    first_of_caps: u64,
}

impl<W: Write + Seek> CompressedGlbWriter<W> {
    /// Starts a file. It needs `bounds`, the boxes of all yarns.
    pub(in crate::write) fn start(
        target: Target<W>,
        plan: &Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &[Material],
        form: MeshForm,
        bounds: Option<&Bounds>,
    ) -> Result<Self, WriteError> {
        let ring = RingForm::new(plan, form.has_seam());
        let Start { document, form, corners, grids } = Start::new(plan, chunks, materials, form, bounds)?;
        let first_of_caps = ring.tubes(plan);
        let caps = ring.vertices(plan) - first_of_caps;
        // Only compressed forms have this writer.
        let extension = form.compression.unwrap_or(Meshopt::Ext);
        let column = |column| CompressedColumn::new(column, extension, caps, target.path());
        Ok(Self {
            pattern: compressed_pattern(plan, &document, target.path())?,
            columns: form.columns.iter().map(column).collect::<Result<_, _>>()?,
            document,
            form,
            corners,
            grids,
            first_of_caps,
            target,
        })
    }
}

impl<W: Write + Seek> MeshWriter<W> for CompressedGlbWriter<W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        self.corners.each(&run, |batch| {
            let vertices = stepped(self.grids.as_deref(), &batch);
            self.document.include(batch.place, &vertices);
            for (column, compressed) in self.form.columns.iter().zip(&mut self.columns) {
                let mut bytes = Vec::with_capacity(vertices.len() * column.bytes as usize);
                corners(&vertices, &batch).for_each(|corner| (column.write)(&corner, &mut bytes));
                compressed.add(batch.place >= self.first_of_caps, &bytes)?;
            }
            Ok(())
        })
    }

    /// Nothing is left to write: all triangles are in the pattern.
    fn triangles(&mut self, _: &Chunk, _: &Places) -> Result<(), WriteError> {
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<Target<W>, WriteError> {
        let columns =
            self.columns.into_iter().map(CompressedColumn::finish).collect::<Result<Vec<_>, _>>()?;
        let pattern = self.pattern.iter().map(Spool::len).sum();
        self.document.place(std::iter::once(pattern).chain(columns.iter().map(Spool::len)));
        begin(self.document.gltf(), &mut self.target)?;
        let start = self.target.position();
        for spool in self.pattern.into_iter().chain(columns) {
            spool.write_to(&mut self.target)?;
        }
        let padding = start + self.document.buffer_bytes() - self.target.position();
        self.target.write(&[0; 4][..padding as usize])?;
        Ok(self.target)
    }
}

/// The index pattern, compressed in two parts: the codes of all triangles, and the rest.
fn compressed_pattern(
    plan: &Plan,
    document: &Document,
    path: Option<&Path>,
) -> Result<[Spool; 2], WriteError> {
    let [mut codes, mut further] = [path; 2].map(Spool::beside);
    let mut encoder = TriangleEncoder::new();
    let start = codes.write_all(&TriangleEncoder::START);
    start.map_err(|source| codes.failed(source))?;
    document.pattern(plan, |corners| {
        let mut triangles = corners.as_chunks().0.iter();
        let added = triangles.try_for_each(|triangle| encoder.add(*triangle, &mut codes, &mut further));
        added.map_err(|source| codes.failed(source))
    })?;
    let end = further.write_all(&TriangleEncoder::END);
    end.map_err(|source| further.failed(source))?;
    Ok([codes, further])
}

/// A column of all vertices, as it is compressed.
#[derive(Debug)]
struct CompressedColumn {
    encoder: AttributeEncoder,
    spool: Spool,
    /// The column of the caps, not compressed. The vertices of caps come between those of tubes,
    /// but follow them in the file.
    caps: Vec<u8>,
}

impl CompressedColumn {
    /// A column of all vertices, of which `caps` are those of caps.
    ///
    /// **Errors**: [`WriteError::Pipeline`] if memory is short.
    fn new(column: &Column, extension: Meshopt, caps: u64, path: Option<&Path>) -> Result<Self, WriteError> {
        let mut bytes = Vec::new();
        room_for(&mut bytes, (caps * column.bytes) as usize, "vertices of caps")
            .map_err(|short| PipelineError::from(SessionError::from(short)))?;
        let differences = match (extension, column.kind) {
            (Meshopt::Khr, SHORT) => Differences::Words,
            _ => Differences::Bytes,
        };
        let encoder = AttributeEncoder::new(column.bytes as usize, extension, differences);
        Ok(Self { encoder, spool: Spool::beside(path), caps: bytes })
    }

    /// Takes the column of further vertices, which are those of a cap if `of_cap` says so.
    fn add(&mut self, of_cap: bool, bytes: &[u8]) -> Result<(), WriteError> {
        if of_cap {
            self.caps.extend_from_slice(bytes);
            return Ok(());
        }
        self.encoder.add(bytes, &mut self.spool).map_err(|source| self.spool.failed(source))
    }

    /// The whole column.
    fn finish(self) -> Result<Spool, WriteError> {
        let Self { mut encoder, mut spool, caps } = self;
        let finished = encoder.add(&caps, &mut spool).and_then(|()| encoder.finish(&mut spool));
        finished.map_err(|source| spool.failed(source))?;
        Ok(spool)
    }
}
