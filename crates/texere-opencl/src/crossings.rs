//! Crossings on an OpenCL device.

use std::ops::ControlFlow;
use std::sync::Arc;

use bytemuck::bytes_of;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use texere_core::{BackendError, Limits};
use texere_gpu::{
    CROSSINGS_PASSES, CrossingsParams, CrossingsSeenRow, ThreadRow, crossings_batches, crossings_ups,
};
use texere_kernels::{CROSSINGS_MOVE, CROSSINGS_SEEN};

use crate::buffers::Buffer;
use crate::kernel::{Arg, Kernel, in_memory, start};
use crate::opened::Opened;
use crate::room::Room;

/// The settler of crossings of an [`OpenClBackend`](crate::OpenClBackend).
#[derive(Debug)]
pub(crate) struct OpenClCrossings {
    plan: Arc<CrossingsPlan>,
    params: CrossingsParams,
    step: Kernel,
    seen: Kernel,
    memory: Memory,
    opened: Arc<Opened>,
}

/// What kernels read and write.
#[derive(Debug)]
struct Memory {
    threads: Buffer,
    ups: Buffer,
    /// As they are.
    crossings: Buffer,
    /// As others find them in the next pass, and in the one after it.
    found: Buffer,
    next: Buffer,
    /// What groups have seen, and what passes since the last wait have.
    group_rows: Buffer,
    pass_rows: Buffer,
}

impl Memory {
    fn new(opened: &Opened, limits: &Limits, plan: &CrossingsPlan) -> Result<Self, BackendError> {
        let mut room = Room::new(limits);
        let rows = |count: u64| size_of::<CrossingsSeenRow>() as u64 * count;
        let crossings = plan.crossings() as u64;
        let bytes = size_of::<CrossingState>() as u64 * crossings;
        let groups = crossings.div_ceil(CROSSINGS_MOVE.group as u64);
        Ok(Self {
            threads: room.holding(opened, "the thread table", &ThreadRow::all(plan))?,
            ups: room.holding(opened, "the drawdown", &crossings_ups(plan))?,
            crossings: room.zeroed(opened, "crossings", bytes)?,
            found: room.zeroed(opened, "crossings as others find them", bytes)?,
            next: room.zeroed(opened, "crossings as others will find them", bytes)?,
            group_rows: room.zeroed(opened, "what groups have seen", rows(groups))?,
            pass_rows: room.zeroed(opened, "what was seen", rows(CROSSINGS_PASSES.into()))?,
        })
    }
}

impl OpenClCrossings {
    /// Compiles the kernels if no settler of crossings has before, and takes memory.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], [`BackendError::Compile`].
    pub(crate) fn new(
        opened: Arc<Opened>,
        limits: &Limits,
        plan: Arc<CrossingsPlan>,
    ) -> Result<Self, BackendError> {
        let program = opened.crossings()?;
        Ok(Self {
            params: CrossingsParams::new(&plan),
            step: Kernel::of(&opened, program, CROSSINGS_MOVE)?,
            seen: Kernel::of(&opened, program, CROSSINGS_SEEN)?,
            memory: Memory::new(&opened, limits, &plan)?,
            plan,
            opened,
        })
    }

    /// Starts a pass, `number` of those between two waits.
    fn start_pass(&mut self, pass: &CrossingsPass, number: u32) -> Result<(), BackendError> {
        let params = self.params.with_pass(pass, number);
        let value = [Arg::Value(bytes_of(&params))];
        let Memory { threads, ups, crossings, found, next, group_rows, pass_rows } = &self.memory;
        let args = [&value[..], &in_memory([threads, ups, found, crossings, next, group_rows])].concat();
        // SAFETY: the arguments are those of `crossings_move`; a lane reads its threads' rows, its
        // bit of the drawdown and its crossing, and the same of sites beside it that the plan has,
        // and writes its crossing; a group writes its row.
        unsafe { start(&mut self.step, &self.opened, &args, params.crossings) }?;
        let args = [&value[..], &in_memory([group_rows, pass_rows])].concat();
        // SAFETY: the arguments are those of `crossings_seen`; the only group reads all rows of
        // groups, and writes that of the pass, of which there are `CROSSINGS_PASSES`.
        unsafe { start(&mut self.seen, &self.opened, &args, 1) }?;
        std::mem::swap(&mut self.memory.found, &mut self.memory.next);
        Ok(())
    }

    /// Makes so many passes that there is a row for each, and waits for what they have seen.
    fn run(&mut self, passes: &[CrossingsPass]) -> Result<Vec<CrossingsSeen>, BackendError> {
        for (number, pass) in (0..CROSSINGS_PASSES).zip(passes) {
            self.start_pass(pass, number)?;
        }
        let mut rows = vec![CrossingsSeenRow::default(); passes.len()];
        self.memory.pass_rows.read_now(&self.opened, 0, &mut rows)?;
        Ok(rows.into_iter().map(CrossingsSeenRow::seen).collect())
    }
}

impl CrossingsSettler for OpenClCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.plan
    }

    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError> {
        let Self { opened, memory, .. } = self;
        memory.crossings.write(opened, &opened.queue, 0, crossings, None)?;
        memory.found.copy(opened, &memory.crossings)
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let seen = self.run(&[*pass])?;
        Ok(seen.into_iter().fold(CrossingsSeen::NOTHING, CrossingsSeen::and))
    }

    fn passes(
        &mut self,
        passes: &[CrossingsPass],
        watch: &mut dyn FnMut(&CrossingsPass, CrossingsSeen) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        crossings_batches(passes, |passes| self.run(passes), watch)
    }

    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError> {
        self.memory.crossings.read_now(&self.opened, 0, crossings)
    }
}
