//! The schedule per-ring, in which a lane makes a ring.

use std::ops::Range;

use bytemuck::bytes_of;
use texere_core::backend::{Chunk, Plan};
use texere_core::{BackendError, Topology};
use texere_gpu::Params;
use texere_kernels::{
    BLOCK_TURNS, CAPS, EntryPoint, MESH, MESH_ODD, TRAJECTORY, UNINDEXED_GROUP, YARN_ROLLS,
};

use crate::chunk_memory::ChunkMemory;
use crate::kernel::{Arg, Kernel};
use crate::opened::Opened;
use crate::work::{Kernels, Launches, Work};

/// The kernels of the schedule. A workgroup makes a block.
#[derive(Debug)]
pub(crate) struct PerRing {
    block_turns: Kernel,
    yarn_rolls: Kernel,
    trajectory: Kernel,
    mesh: Kernel,
    caps: Kernel,
}

impl PerRing {
    pub(crate) fn new(opened: &Opened, plan: &Plan, flattened: bool) -> Result<Self, BackendError> {
        let settings = plan.settings();
        let mesh = if settings.sides.is_multiple_of(2) { MESH } else { MESH_ODD };
        let group = if settings.topology == Topology::Indexed { mesh.group } else { UNINDEXED_GROUP };
        Ok(Self {
            block_turns: Kernel::new(opened, BLOCK_TURNS, flattened)?,
            yarn_rolls: Kernel::new(opened, YARN_ROLLS, flattened)?,
            trajectory: Kernel::new(opened, TRAJECTORY, flattened)?,
            mesh: Kernel::new(opened, EntryPoint { group, ..mesh }, flattened)?,
            caps: Kernel::new(opened, CAPS, flattened)?,
        })
    }
}

impl Kernels for PerRing {
    fn mesh_reads_rings(&self) -> bool {
        false
    }

    fn block_turns(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, .. } = work;
        let (params, window) = (Params::new(plan, chunk), chunk.window().start);
        let args = &work.inputs(&params, &window, memory)[..6];
        // SAFETY: the arguments are those of `block_turns`. A group reads its row of the chunk's
        // table and what the row names, and writes its block's turn. There is a turn for each block
        // of the plan. A row for a repeated ring writes the turn of the next chunk's first block.
        unsafe { self.block_turns.run(opened, args, 0..memory.rows, memory.ready.as_deref()) }
    }

    fn yarn_rolls(&mut self, work: Work<'_>, yarns: Range<usize>) -> Result<Launches, BackendError> {
        let Work { opened, tables, .. } = work;
        let args = [Arg::Memory(&tables.yarns), Arg::Memory(&tables.rolls), Arg::Memory(&tables.yarn_turns)];
        // SAFETY: the arguments are those of `yarn_rolls`. A group reads its yarn's row, reads and
        // writes the yarn's rolls, and writes its total turn. There is room for the rolls and the
        // total turns of all yarns of the plan.
        unsafe { self.yarn_rolls.run(opened, &args, yarns, None) }
    }

    fn trajectory(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, .. } = work;
        let (params, window) = (Params::new(plan, chunk), chunk.window().start);
        let args = [&work.inputs(&params, &window, memory)[..], &[Arg::Memory(&memory.rings)]].concat();
        // SAFETY: the arguments are those of `trajectory`. A group reads its row of the chunk's
        // table and what the row names, and writes its rings, for all of which there is room.
        unsafe { self.trajectory.run(opened, &args, 0..memory.rows, memory.ready.as_deref()) }
    }

    fn mesh(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, tables } = work;
        let (params, window) = (Params::new(plan, chunk), chunk.window().start);
        let outputs = [
            Arg::Memory(&tables.outlines),
            Arg::Memory(&tables.pattern),
            Arg::Memory(&memory.vertices),
            Arg::Memory(&memory.indices),
        ];
        let args = [&work.inputs(&params, &window, memory)[..], &outputs].concat();
        // SAFETY: the arguments are those of `mesh`. A group reads its row of the chunk's table and
        // what the row names, and writes the row's vertices and indices, for all of which there is
        // room.
        let tubes = unsafe { self.mesh.run(opened, &args, 0..memory.rows, memory.ready.as_deref()) }?;
        let args = [
            Arg::Value(bytes_of(&params)),
            Arg::Value(bytes_of(&window)),
            Arg::Memory(&tables.points),
            Arg::Memory(&memory.caps),
            Arg::Memory(&tables.cap_pattern),
            Arg::Memory(&memory.vertices),
            Arg::Memory(&memory.indices),
        ];
        let lanes = params.caps as usize * params.sides as usize;
        // SAFETY: the arguments are those of `caps`. A lane reads its cap's row and what the row
        // names, and writes a vertex and at most one triangle, for all of which there is room.
        // Lanes past the last do nothing.
        let caps = unsafe { self.caps.run(opened, &args, 0..lanes.div_ceil(self.caps.group()), None) }?;
        Ok([tubes, caps].concat())
    }
}
