//! Crossings at rest, on a wgpu device.

mod kernels;
mod memory;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use texere_core::{BackendError, Limits};
use texere_gpu::{CrossingsParams, CrossingsSeenRow, crossings_batches};
use wgpu::{CommandEncoder, ComputePassDescriptor};

use crate::answer::Answer;
use crate::opened::Opened;
use crate::readback::Readback;
pub(crate) use kernels::CrossingsKernels;
use memory::{Memory, PARAMS_STEP};

/// The settler of crossings of a [`WgpuBackend`](crate::WgpuBackend).
#[derive(Debug)]
pub(crate) struct WgpuCrossings {
    opened: Arc<Opened>,
    kernels: Arc<CrossingsKernels>,
    plan: Arc<CrossingsPlan>,
    params: CrossingsParams,
    memory: Memory,
    answer: Answer,
    readback: Readback,
}

impl WgpuCrossings {
    /// Allocates memory, and compiles the shaders unless a settler of crossings has done so before.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], [`BackendError::Compile`],
    /// [`BackendError::Driver`], [`BackendError::DeviceLost`].
    pub(crate) fn new(
        opened: Arc<Opened>,
        limits: &Limits,
        plan: Arc<CrossingsPlan>,
    ) -> Result<Self, BackendError> {
        let gpu = &opened.gpu;
        gpu.probe()?;
        let memory = Memory::new(gpu, limits, &plan)?;
        Ok(Self {
            kernels: opened.crossings()?,
            params: CrossingsParams::new(&plan),
            answer: Answer::new(gpu, memory.pass_rows.size())?,
            readback: Readback::new(gpu)?,
            memory,
            plan,
            opened,
        })
    }

    /// Makes `passes`, which are at most [`texere_gpu::CROSSINGS_PASSES`], in one submission, and
    /// waits for their measures.
    fn run(&mut self, passes: &[CrossingsPass]) -> Result<Vec<CrossingsSeen>, BackendError> {
        let (gpu, memory, kernels) = (&self.opened.gpu, &self.memory, &self.kernels);
        let numbers = 0..passes.len() as u32;
        for (number, pass) in numbers.clone().zip(passes) {
            let params = self.params.with_pass(pass, number);
            gpu.write(&memory.params, PARAMS_STEP * u64::from(number), bytemuck::bytes_of(&params))?;
        }
        let workgroups = kernels.step.workgroups(self.params.crossings);
        let record = |encoder: &mut CommandEncoder| {
            let mut recorded = encoder.begin_compute_pass(&ComputePassDescriptor::default());
            for number in numbers {
                for (kernel, workgroups) in [(&kernels.step, workgroups), (&kernels.seen, 1)] {
                    let bound = kernel.bind(gpu, |resource| memory.resource(resource, number));
                    kernel.record(&mut recorded, &bound, workgroups);
                }
            }
        };
        let rows: Vec<CrossingsSeenRow> =
            self.answer.after(gpu, &memory.pass_rows, (0, passes.len() as u64), record)?;
        if !passes.len().is_multiple_of(2) {
            std::mem::swap(&mut self.memory.found, &mut self.memory.next);
        }
        Ok(rows.into_iter().map(CrossingsSeenRow::seen).collect())
    }
}

impl CrossingsSettler for WgpuCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.plan
    }

    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError> {
        let (gpu, memory) = (&self.opened.gpu, &self.memory);
        gpu.write(&memory.crossings, 0, bytemuck::cast_slice(crossings))?;
        gpu.write(&memory.found, 0, bytemuck::cast_slice(crossings))
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
        let mut at = 0;
        let (source, count) = (&self.memory.crossings, self.params.crossings);
        let _ = self.readback.lend(&self.opened.gpu, source, count, &mut |_, piece: &[CrossingState]| {
            for (crossing, read) in crossings[at..].iter_mut().zip(piece) {
                *crossing = *read;
            }
            at += piece.len();
            ControlFlow::Continue(())
        })?;
        Ok(())
    }
}
