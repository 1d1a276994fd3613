//! The schedule per-yarn, in which a lane makes a part of a yarn: algorithms 2 and 4 of the paper
//! in README.md.

use std::ops::Range;

use bytemuck::bytes_of;
use texere_core::BackendError;
use texere_core::backend::{Chunk, Plan};
use texere_gpu::Params;
use texere_kernels::{MESH_PER_YARN, TRAJECTORY_PER_YARN};

use crate::chunk_memory::ChunkMemory;
use crate::kernel::{Arg, Kernel};
use crate::opened::Opened;
use crate::work::{Kernels, Launches, Work};

/// The kernels of the schedule.
#[derive(Debug)]
pub(crate) struct PerYarn {
    trajectory: Kernel,
    mesh: Kernel,
}

impl PerYarn {
    pub(crate) fn new(opened: &Opened, flattened: bool) -> Result<Self, BackendError> {
        Ok(Self {
            trajectory: Kernel::new(opened, TRAJECTORY_PER_YARN, flattened)?,
            mesh: Kernel::new(opened, MESH_PER_YARN, flattened)?,
        })
    }
}

/// The parameters of a launch whose table has one row for each part.
fn part_params(plan: &Plan, chunk: &Chunk, memory: &ChunkMemory) -> Params {
    Params { blocks: memory.rows as u32, ..Params::new(plan, chunk) }
}

impl Kernels for PerYarn {
    fn mesh_reads_rings(&self) -> bool {
        true
    }

    /// Does nothing, because this schedule refuses plans with rolls.
    fn block_turns(&mut self, _: Work<'_>, _: &Chunk, _: &ChunkMemory) -> Result<Launches, BackendError> {
        Ok(Vec::new())
    }

    fn yarn_rolls(&mut self, _: Work<'_>, _: Range<usize>) -> Result<Launches, BackendError> {
        Ok(Vec::new())
    }

    fn trajectory(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, .. } = work;
        let (params, window) = (part_params(plan, chunk, memory), chunk.window().start);
        let args = [&work.inputs(&params, &window, memory)[..5], &[Arg::Memory(&memory.rings)]].concat();
        let groups = memory.rows.div_ceil(self.trajectory.group());
        // SAFETY: the arguments are those of `trajectory_per_yarn`. A lane reads its part and what
        // the part names, and writes the part's rings, for which there is room. Lanes past the last
        // part do nothing.
        unsafe { self.trajectory.run(opened, &args, 0..groups, memory.ready.as_deref()) }
    }

    fn mesh(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, tables } = work;
        let params = part_params(plan, chunk, memory);
        let args = [
            Arg::Value(bytes_of(&params)),
            Arg::Memory(&tables.yarns),
            Arg::Memory(&memory.table),
            Arg::Memory(&memory.rings),
            Arg::Memory(&tables.outlines),
            Arg::Memory(&tables.pattern),
            Arg::Memory(&memory.vertices),
            Arg::Memory(&memory.indices),
        ];
        let groups = memory.rows.div_ceil(self.mesh.group());
        // SAFETY: the arguments are those of `mesh_per_yarn`. A lane reads its part and what the
        // part names, and writes the part's vertices and indices, for which there is room. Lanes
        // past the last part do nothing.
        unsafe { self.mesh.run(opened, &args, 0..groups, memory.ready.as_deref()) }
    }
}
