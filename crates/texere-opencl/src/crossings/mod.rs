//! Crossings at rest, on an OpenCL device.

mod kernels;
mod memory;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use texere_core::{BackendError, Limits};
use texere_gpu::{CROSSINGS_PASSES, CrossingsParams, CrossingsSeenRow, crossings_batches};

use crate::opened::Opened;
use kernels::CrossingsKernels;
use memory::Memory;

/// The settler of crossings of an [`OpenClBackend`](crate::OpenClBackend).
#[derive(Debug)]
pub(crate) struct OpenClCrossings {
    plan: Arc<CrossingsPlan>,
    params: CrossingsParams,
    kernels: CrossingsKernels,
    memory: Memory,
    opened: Arc<Opened>,
}

impl OpenClCrossings {
    /// Allocates memory, and compiles the kernels unless a settler of crossings has done so before.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], [`BackendError::Compile`], and
    /// [`BackendError::Driver`] or [`BackendError::DeviceLost`] if another call of OpenCL fails.
    pub(crate) fn new(
        opened: Arc<Opened>,
        limits: &Limits,
        plan: Arc<CrossingsPlan>,
    ) -> Result<Self, BackendError> {
        Ok(Self {
            params: CrossingsParams::new(&plan),
            kernels: CrossingsKernels::new(&opened)?,
            memory: Memory::new(&opened, limits, &plan)?,
            plan,
            opened,
        })
    }

    /// Makes `passes`, which are at most [`CROSSINGS_PASSES`], and waits for their measures.
    fn run(&mut self, passes: &[CrossingsPass]) -> Result<Vec<CrossingsSeen>, BackendError> {
        for (number, pass) in (0..CROSSINGS_PASSES).zip(passes) {
            let params = self.params.with_pass(pass, number);
            self.kernels.start(&self.opened, &params, &self.memory)?;
            std::mem::swap(&mut self.memory.found, &mut self.memory.next);
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
        watch: &mut dyn FnMut(&CrossingsPass, Option<CrossingsSeen>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        crossings_batches(passes, |passes| self.run(passes), watch)
    }

    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError> {
        self.memory.crossings.read_now(&self.opened, 0, crossings)
    }
}
