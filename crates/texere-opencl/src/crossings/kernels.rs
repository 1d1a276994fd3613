//! The kernels that bring crossings to rest.

use bytemuck::bytes_of;
use texere_core::BackendError;
use texere_gpu::CrossingsParams;
use texere_kernels::{CROSSINGS_MOVE, CROSSINGS_SEEN};

use super::memory::Memory;
use crate::kernel::{Arg, Kernel, in_memory, start};
use crate::opened::Opened;

/// The two kernels of a pass.
#[derive(Debug)]
pub(super) struct CrossingsKernels {
    step: Kernel,
    seen: Kernel,
}

impl CrossingsKernels {
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::Driver`] or
    /// [`BackendError::DeviceLost`] if another call of OpenCL fails.
    pub(super) fn new(opened: &Opened) -> Result<Self, BackendError> {
        let program = opened.crossings()?;
        Ok(Self {
            step: Kernel::of(opened, program, CROSSINGS_MOVE)?,
            seen: Kernel::of(opened, program, CROSSINGS_SEEN)?,
        })
    }

    /// Starts the pass that `params` describe.
    pub(super) fn start(
        &mut self,
        opened: &Opened,
        params: &CrossingsParams,
        memory: &Memory,
    ) -> Result<(), BackendError> {
        let value = [Arg::Value(bytes_of(params))];
        let Memory { threads, sites, crossings, found, next, group_rows, pass_rows } = memory;
        let args = [&value[..], &in_memory([threads, sites, found, crossings, next, group_rows])].concat();
        // SAFETY: the arguments are those of `crossings_move`. A lane reads the rows of threads,
        // the sites and the lies of its crossing and of the crossings near it that are in the plan.
        // It writes the lies of its own crossing in `crossings` and `next`, and a group writes its
        // row.
        unsafe { start(&mut self.step, opened, &args, params.crossings) }?;
        let args = [&value[..], &in_memory([group_rows, pass_rows])].concat();
        // SAFETY: the arguments are those of `crossings_seen`. The only group reads the rows of all
        // groups, and writes the row of the pass. There are `CROSSINGS_PASSES` rows of passes.
        unsafe { start(&mut self.seen, opened, &args, 1) }
    }
}
