//! Device memory of a chunk in flight: its tables and its results.

use std::ops::Range;
use std::sync::Arc;

use texere_core::{BackendError, Chunk, Plan, Ring, Topology, Vertex};

use crate::Schedule;
use crate::backend::Opened;
use crate::buffers::Buffer;
use crate::handles::Handle;

/// Memory of a chunk in flight, which serves the next chunk but one again.
#[derive(Debug, Default)]
pub(crate) struct ChunkMemory {
    /// The blocks of the chunk whose tables are here.
    loaded: Option<Range<u64>>,
    pub(crate) table: Buffer,
    /// Rows of `table`.
    pub(crate) rows: usize,
    pub(crate) caps: Buffer,
    pub(crate) rings: Buffer,
    /// The growth of the radius at each ring; the schedule per-yarn only.
    pub(crate) slopes: Buffer,
    pub(crate) vertices: Buffer,
    pub(crate) indices: Buffer,
    /// The last command that writes here.
    pub(crate) ready: Option<Arc<Handle>>,
}

impl ChunkMemory {
    /// Bytes of its tables and results.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { table, caps, rings, slopes, vertices, indices, .. } = self;
        [table, caps, rings, slopes, vertices, indices].map(Buffer::bytes).iter().sum()
    }

    /// Takes `chunk`, one of `plan`'s: sends its tables, beside the kernels of the other chunk in flight but after those
    /// that work here.
    pub(crate) fn load(&mut self, opened: &Opened, plan: &Plan, chunk: &Chunk) -> Result<(), BackendError> {
        self.loaded = None;
        if !plan.owns(chunk) {
            return Err(BackendError::NotLoaded { chunk: chunk.index() });
        }
        // Kept until the new tables are sent: commands that still use the old ones may be under way.
        let used = self.ready.clone();
        let parts;
        let rows = match opened.schedule {
            Schedule::PerRing => chunk.blocks(),
            Schedule::PerYarn => {
                parts = plan.part_rows(chunk, u32::MAX);
                &parts
            }
        };
        let caps = plan.cap_rows(chunk);
        self.table.reserve(opened, "the block table", size_of_val(rows) as u64)?;
        self.caps.reserve(opened, "the cap table", size_of_val(&caps[..]) as u64)?;
        let sent = [
            self.table.write(opened, &opened.transfers, 0, rows, used.as_deref())?,
            self.caps.write(opened, &opened.transfers, 0, &caps, used.as_deref())?,
        ];
        // In order, so the last stands for both.
        self.ready = sent.into_iter().flatten().last();
        self.loaded = Some(chunk.block_range());
        self.rows = rows.len();
        Ok(())
    }

    /// **Errors**: [`BackendError::NotLoaded`] unless the tables of `chunk`, one of `plan`'s, are here.
    pub(crate) fn check(&self, plan: &Plan, chunk: &Chunk) -> Result<(), BackendError> {
        if plan.owns(chunk) && self.loaded == Some(chunk.block_range()) {
            Ok(())
        } else {
            Err(BackendError::NotLoaded { chunk: chunk.index() })
        }
    }

    /// Makes room for the rings of `chunk`.
    pub(crate) fn reserve_rings(&mut self, opened: &Opened, chunk: &Chunk) -> Result<(), BackendError> {
        let rings = u64::from(chunk.rings());
        self.rings.reserve(opened, "rings", rings * size_of::<Ring>() as u64)?;
        if opened.schedule == Schedule::PerYarn {
            self.slopes.reserve(opened, "slopes", rings * size_of::<f32>() as u64)?;
        }
        Ok(())
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
