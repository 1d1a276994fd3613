//! The stages, and how the schedule per-ring does them.

use std::fmt::Debug;
use std::sync::Arc;

use bytemuck::bytes_of;
use texere_core::{BackendError, Chunk, Params, Plan, Topology};
use texere_kernels::{BLOCK_TURNS, CAPS, Entry, MESH, MESH_ODD, TRAJECTORY, UNINDEXED_GROUP, YARN_ROLLS};

use crate::backend::Opened;
use crate::handles::Handle;
use crate::kernel::{Arg, Kernel};
use crate::resident::Resident;
use crate::slot::Slot;

/// The events of the launches that make a stage, in order.
pub(crate) type Launches = Vec<Arc<Handle>>;

/// What a stage works with.
#[derive(Clone, Copy)]
pub(crate) struct Work<'a> {
    pub(crate) opened: &'a Opened,
    pub(crate) plan: &'a Plan,
    pub(crate) resident: &'a Resident,
}

impl<'a> Work<'a> {
    /// What the kernels that read a chunk's table begin with, in the order of the sources. Those that need no rolls leave
    /// out the last two, `block_turns` the last.
    pub(crate) fn inputs(&self, params: &'a Params, window: &'a u64, slot: &'a Slot) -> [Arg<'a>; 7] {
        [
            Arg::Value(bytes_of(params)),
            Arg::Value(bytes_of(window)),
            Arg::Memory(&self.resident.points),
            Arg::Memory(&self.resident.yarns),
            Arg::Memory(&slot.table),
            Arg::Memory(&self.resident.rolls),
            Arg::Memory(&self.resident.whole),
        ]
    }
}

/// A schedule: one way of doing the stages. A slot that is handed over has the chunk's tables, and room for what the
/// stage writes.
pub(crate) trait Stages: Debug + Send {
    /// Whether `mesh` reads the slot's rings rather than work them out itself.
    fn mesh_reads_rings(&self) -> bool;

    /// The first half of the scan: what each block of the chunk turns by.
    fn block_turns(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError>;
    /// The second half: rolls from the turns of all chunks.
    fn yarn_rolls(&mut self, work: Work<'_>) -> Result<Launches, BackendError>;
    fn trajectory(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError>;
    fn mesh(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError>;
}

/// A workgroup a block.
#[derive(Debug)]
pub(crate) struct PerRing {
    block_turns: Kernel,
    yarn_rolls: Kernel,
    trajectory: Kernel,
    mesh: Kernel,
    caps: Kernel,
}

impl PerRing {
    pub(crate) fn new(opened: &Opened, plan: &Plan) -> Result<Self, BackendError> {
        let settings = plan.settings();
        let mesh = if settings.sides.is_multiple_of(2) { MESH } else { MESH_ODD };
        let group = if settings.topology == Topology::Indexed { mesh.group } else { UNINDEXED_GROUP };
        Ok(Self {
            block_turns: Kernel::new(opened, BLOCK_TURNS)?,
            yarn_rolls: Kernel::new(opened, YARN_ROLLS)?,
            trajectory: Kernel::new(opened, TRAJECTORY)?,
            mesh: Kernel::new(opened, Entry { group, ..mesh })?,
            caps: Kernel::new(opened, CAPS)?,
        })
    }
}

impl Stages for PerRing {
    fn mesh_reads_rings(&self) -> bool {
        false
    }

    fn block_turns(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError> {
        let Work { opened, plan, .. } = work;
        let (params, window) = (plan.params(chunk), chunk.window.start);
        let args = &work.inputs(&params, &window, slot)[..6];
        // SAFETY: the arguments are those of `block_turns`; a group reads its row of the chunk's table and what that
        // names, and writes its block's roll: the plan counted all blocks. A repeated ring's is the next chunk's first.
        unsafe { self.block_turns.run(opened, args, slot.rows, slot.ready.as_deref()) }
    }

    fn yarn_rolls(&mut self, work: Work<'_>) -> Result<Launches, BackendError> {
        let Work { opened, plan, resident } = work;
        let args = [Arg::Memory(&resident.yarns), Arg::Memory(&resident.rolls), Arg::Memory(&resident.whole)];
        // SAFETY: the arguments are those of `yarn_rolls`; a group reads its yarn's row, reads and writes the yarn's
        // rolls, and writes its whole turn: the plan counted all of them.
        unsafe { self.yarn_rolls.run(opened, &args, plan.layout().yarns().len(), None) }
    }

    fn trajectory(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError> {
        let Work { opened, plan, .. } = work;
        let (params, window) = (plan.params(chunk), chunk.window.start);
        let args = [&work.inputs(&params, &window, slot)[..], &[Arg::Memory(&slot.rings)]].concat();
        // SAFETY: the arguments are those of `trajectory`; a group reads its row of the chunk's table and what that
        // names, and writes its rings, for all of which the slot has room.
        unsafe { self.trajectory.run(opened, &args, slot.rows, slot.ready.as_deref()) }
    }

    fn mesh(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError> {
        let Work { opened, plan, resident } = work;
        let (params, window) = (plan.params(chunk), chunk.window.start);
        let outputs = [
            Arg::Memory(&resident.outlines),
            Arg::Memory(&resident.pattern),
            Arg::Memory(&slot.vertices),
            Arg::Memory(&slot.indices),
        ];
        let args = [&work.inputs(&params, &window, slot)[..], &outputs].concat();
        // SAFETY: the arguments are those of `mesh`; a group reads its row of the chunk's table and what that names, and
        // writes the row's vertices and indices, for all of which the slot has room.
        let tubes = unsafe { self.mesh.run(opened, &args, slot.rows, slot.ready.as_deref()) }?;
        let args = [
            Arg::Value(bytes_of(&params)),
            Arg::Value(bytes_of(&window)),
            Arg::Memory(&resident.points),
            Arg::Memory(&slot.caps),
            Arg::Memory(&resident.cap_pattern),
            Arg::Memory(&slot.vertices),
            Arg::Memory(&slot.indices),
        ];
        let lanes = params.caps as usize * params.sides as usize;
        // SAFETY: the arguments are those of `caps`; a lane reads its cap's row and what that names, and writes a vertex
        // and a triangle, for all of which the slot has room. Lanes past the last do nothing.
        let caps = unsafe { self.caps.run(opened, &args, lanes.div_ceil(self.caps.group()), None) }?;
        Ok([tubes, caps].concat())
    }
}
