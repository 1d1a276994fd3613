//! The stages of an engine: their input, their kernels, and the launches that they return.

use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

use bytemuck::bytes_of;
use texere_core::BackendError;
use texere_core::backend::{Chunk, Plan};
use texere_gpu::Params;

use crate::chunk_memory::ChunkMemory;
use crate::handles::Handle;
use crate::kernel::Arg;
use crate::opened::Opened;
use crate::tables::Tables;

/// The events of a stage's launches, in order.
pub(crate) type Launches = Vec<Arc<Handle>>;

/// The input of a stage.
#[derive(Clone, Copy)]
pub(crate) struct Work<'a> {
    pub(crate) opened: &'a Opened,
    pub(crate) plan: &'a Plan,
    pub(crate) tables: &'a Tables,
}

impl<'a> Work<'a> {
    /// The first arguments of the kernels that work on a chunk, apart from `caps`, `cap_attributes`
    /// and `mesh_per_yarn`, in the order of the sources. Kernels that read no rolls leave out the
    /// last two arguments, `block_turns` leaves out the last, and `packed_caps` has the first
    /// three.
    pub(crate) fn inputs(
        &self,
        params: &'a Params,
        window: &'a u64,
        memory: &'a ChunkMemory,
    ) -> [Arg<'a>; 7] {
        [
            Arg::Value(bytes_of(params)),
            Arg::Value(bytes_of(window)),
            Arg::Memory(&self.tables.points),
            Arg::Memory(&self.tables.yarns),
            Arg::Memory(&memory.table),
            Arg::Memory(&self.tables.rolls),
            Arg::Memory(&self.tables.yarn_turns),
        ]
    }
}

/// The kernels of a schedule. The memory that is passed to them holds the chunk's tables, and has
/// room for what the stage writes.
pub(crate) trait Kernels: Debug + Send {
    /// Whether `mesh` reads the rings that `trajectory` made, instead of working them out itself.
    fn mesh_reads_rings(&self) -> bool;

    /// The first half of the scan: the turn of each block of the chunk.
    fn block_turns(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError>;
    /// The second half of the scan: the rolls of `yarns` from the turns of their blocks.
    fn yarn_rolls(&mut self, work: Work<'_>, yarns: Range<usize>) -> Result<Launches, BackendError>;
    fn trajectory(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError>;
    fn mesh(&mut self, work: Work<'_>, chunk: &Chunk, memory: &ChunkMemory)
    -> Result<Launches, BackendError>;
}
