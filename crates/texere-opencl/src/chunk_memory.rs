//! The device memory of a chunk: its tables and its results.

use std::sync::Arc;

use texere_core::backend::{Chunk, Plan, Schedule};
use texere_core::definitions::Ring;
use texere_core::{Attribute, BackendError, PackedVertex, Topology, Vertex};
use texere_gpu::{CapRow, LoadedChunk, part_rows};

use crate::buffer::Buffer;
use crate::handles::Handle;
use crate::opened::Opened;

/// The memory of one chunk at a time. A session has two of them, which its chunks use alternately.
/// A live mesh has one for each of its chunks.
#[derive(Debug, Default)]
pub(crate) struct ChunkMemory {
    pub(crate) loaded: LoadedChunk,
    pub(crate) table: Buffer,
    /// The number of rows of `table`.
    pub(crate) rows: usize,
    pub(crate) caps: Buffer,
    pub(crate) rings: Buffer,
    pub(crate) vertices: Buffer,
    pub(crate) indices: Buffer,
    /// The attributes of the chunk's vertices. Empty until attributes are asked for.
    pub(crate) attributes: Buffer,
    /// The packed vertices of the chunk. Empty until packed vertices are asked for.
    pub(crate) packed: Buffer,
    /// The last command that writes to this memory.
    pub(crate) ready: Option<Arc<Handle>>,
}

impl ChunkMemory {
    /// The bytes of the chunk's tables and results.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { table, caps, rings, vertices, indices, attributes, packed, .. } = self;
        [table, caps, rings, vertices, indices, attributes, packed].map(Buffer::bytes).iter().sum()
    }

    /// Sends the tables of `chunk`, which is one of `plan`'s. They are sent while kernels of
    /// another chunk run, but after kernels that still use this memory.
    pub(crate) fn load(&mut self, opened: &Opened, plan: &Plan, chunk: &Chunk) -> Result<(), BackendError> {
        let Self { loaded, table, caps, ready, .. } = self;
        self.rows = loaded.load(plan, chunk, || {
            // The event is kept until the new tables are sent, because commands that use the old
            // ones may still run.
            let used = ready.clone();
            let parts;
            let rows = match opened.schedule {
                Schedule::PerYarn => {
                    parts = part_rows(plan, chunk, u32::MAX);
                    &parts
                }
                _ => chunk.blocks(),
            };
            let cap_rows = CapRow::all(plan, chunk);
            table.reserve(opened, "the block table", size_of_val(rows) as u64)?;
            caps.reserve(opened, "the cap table", size_of_val(&cap_rows[..]) as u64)?;
            let sent = [
                table.write(opened, &opened.transfers, 0, rows, used.as_deref())?,
                caps.write(opened, &opened.transfers, 0, &cap_rows, used.as_deref())?,
            ];
            // The two commands end in order, so it is enough to wait for the last.
            *ready = sent.into_iter().flatten().last();
            Ok(rows.len())
        })?;
        Ok(())
    }

    /// Makes room for the rings of `chunk`.
    pub(crate) fn reserve_rings(&mut self, opened: &Opened, chunk: &Chunk) -> Result<(), BackendError> {
        self.rings.reserve(opened, "rings", u64::from(chunk.rings()) * size_of::<Ring>() as u64)
    }

    /// Makes room for the attributes of `chunk`.
    pub(crate) fn reserve_attributes(&mut self, opened: &Opened, chunk: &Chunk) -> Result<(), BackendError> {
        let bytes = u64::from(chunk.vertices()) * size_of::<Attribute>() as u64;
        self.attributes.reserve(opened, "attributes", bytes)
    }

    /// Makes room for the packed vertices of `chunk`.
    pub(crate) fn reserve_packed(&mut self, opened: &Opened, chunk: &Chunk) -> Result<(), BackendError> {
        let bytes = u64::from(chunk.vertices()) * size_of::<PackedVertex>() as u64;
        self.packed.reserve(opened, "packed vertices", bytes)
    }

    /// Makes room for the vertices and indices of `chunk`.
    pub(crate) fn reserve_mesh(
        &mut self,
        opened: &Opened,
        plan: &Plan,
        chunk: &Chunk,
    ) -> Result<(), BackendError> {
        self.vertices.reserve(
            opened,
            "vertices",
            u64::from(chunk.vertices()) * size_of::<Vertex>() as u64,
        )?;
        if plan.settings().topology == Topology::Indexed {
            self.indices.reserve(opened, "indices", u64::from(chunk.indices()) * size_of::<u32>() as u64)?;
        }
        Ok(())
    }
}
