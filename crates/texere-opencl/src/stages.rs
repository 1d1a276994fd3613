//! The stages, and how the schedule per-ring does them.

use std::fmt::Debug;
use std::sync::Arc;

use bytemuck::bytes_of;
use texere_core::{BackendError, Block, Chunk, Limits, Params, Plan, Topology};
use texere_kernels::{BLOCK_TURNS, CAPS, Entry, MESH, MESH_ODD, TRAJECTORY, UNINDEXED_GROUP, YARN_ROLLS};

use crate::backend::Opened;
use crate::buffers::Buffer;
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

/// A schedule: one way of doing the stages. A slot that is handed over has the chunk's tables, and room for what the
/// stage writes.
pub(crate) trait Stages: Debug + Send {
    /// Whether `mesh` reads the slot's rings rather than work them out itself.
    fn mesh_reads_rings(&self) -> bool;

    fn scan(&mut self, work: Work<'_>) -> Result<Launches, BackendError>;
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
    /// All blocks of the plan, for the scan; made when it is first run.
    all_blocks: Option<Buffer>,
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
            all_blocks: None,
        })
    }
}

impl Stages for PerRing {
    fn mesh_reads_rings(&self) -> bool {
        false
    }

    fn scan(&mut self, work: Work<'_>) -> Result<Launches, BackendError> {
        let Work { opened, plan, resident } = work;
        let all_blocks = match self.all_blocks.take() {
            Some(all_blocks) => all_blocks,
            None => Buffer::holding(opened, "the table of all blocks", &all_blocks(plan)?)?,
        };
        let all_blocks = self.all_blocks.insert(all_blocks);
        let (params, points, yarns) =
            (scan_params(plan), Arg::Memory(&resident.points), Arg::Memory(&resident.yarns));
        let (rolls, whole) = (Arg::Memory(&resident.rolls), Arg::Memory(&resident.whole));

        let args = [Arg::Value(bytes_of(&params)), points, yarns, Arg::Memory(all_blocks), rolls];
        // SAFETY: the arguments are those of `block_turns`; a group reads its row of all blocks, its yarn's row and the
        // points of its rings, and writes its roll: the plan counted all of them.
        let turns = unsafe { self.block_turns.run(opened, &args, plan.block_count() as usize, None) }?;
        // SAFETY: the arguments are those of `yarn_rolls`; a group reads its yarn's row, reads and writes the yarn's
        // rolls, and writes its whole turn: the plan counted all of them.
        let rolled =
            unsafe { self.yarn_rolls.run(opened, &[yarns, rolls, whole], params.yarns as usize, None) }?;
        Ok([turns, rolled].concat())
    }

    fn trajectory(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError> {
        let Work { opened, plan, resident } = work;
        let (params, window) = (plan.params(chunk), chunk.window.start);
        let args = [
            Arg::Value(bytes_of(&params)),
            Arg::Value(bytes_of(&window)),
            Arg::Memory(&resident.points),
            Arg::Memory(&resident.yarns),
            Arg::Memory(&slot.table),
            Arg::Memory(&resident.rolls),
            Arg::Memory(&resident.whole),
            Arg::Memory(&slot.rings),
        ];
        // SAFETY: the arguments are those of `trajectory`; a group reads its row of the chunk's table and what that
        // names, and writes its rings, for all of which the slot has room.
        unsafe { self.trajectory.run(opened, &args, slot.rows, slot.ready.as_deref()) }
    }

    fn mesh(&mut self, work: Work<'_>, chunk: &Chunk, slot: &Slot) -> Result<Launches, BackendError> {
        let Work { opened, plan, resident } = work;
        let (params, window) = (plan.params(chunk), chunk.window.start);
        let args = [
            Arg::Value(bytes_of(&params)),
            Arg::Value(bytes_of(&window)),
            Arg::Memory(&resident.points),
            Arg::Memory(&resident.yarns),
            Arg::Memory(&slot.table),
            Arg::Memory(&resident.rolls),
            Arg::Memory(&resident.whole),
            Arg::Memory(&resident.outlines),
            Arg::Memory(&resident.pattern),
            Arg::Memory(&slot.vertices),
            Arg::Memory(&slot.indices),
        ];
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

/// The block table of the whole plan, its first points counted from the first of all.
fn all_blocks(plan: &Plan) -> Result<Vec<Block>, BackendError> {
    let chunks = plan
        .chunks(&Limits::NONE)
        .map_err(|source| BackendError::Driver { call: "cutting without limits", source: source.into() })?;
    let mut blocks = Vec::new();
    for chunk in chunks {
        // Without the row of a repeated ring.
        let own = (chunk.block_range.end - chunk.block_range.start) as usize;
        let moved =
            |block: Block| Block { first_point: block.first_point + chunk.window.start as u32, ..block };
        blocks.extend(chunk.blocks.iter().take(own).copied().map(moved));
    }
    Ok(blocks)
}

/// The parameters of a scan, which has no chunk.
fn scan_params(plan: &Plan) -> Params {
    let settings = plan.settings();
    Params {
        blocks: plan.block_count() as u32,
        yarns: plan.layout().yarns().len() as u32,
        sides: settings.sides,
        subdivisions: settings.subdivisions,
        frame: (settings.frame == texere_core::Frame::RotationMinimizing).into(),
        rolled: 1,
        s: plan.sampling().s(),
        step: plan.sampling().step(),
        ..Params::default()
    }
}
