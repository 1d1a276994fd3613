//! Crossings on a wgpu device.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use texere_core::{BackendError, Limits};
use texere_gpu::{
    CROSSINGS_PASSES, CrossingsParams, CrossingsSeenRow, ThreadRow, crossings_batches, crossings_ups,
};
use texere_shaders::{Resource, crossings};
use wgpu::{BindingResource, BufferBinding, BufferSize, BufferUsages, CommandEncoder, ComputePassDescriptor};

use crate::answer::Answer;
use crate::gpu::Gpu;
use crate::kernels::{Kernel, Opened};
use crate::readback::Readback;
use crate::room::Room;

/// Bytes from the parameters of a pass to those of the next one: every device binds uniforms at
/// multiples of that.
const PARAMS_STEP: u64 = 256;

/// The compiled shaders that bring crossings to rest.
#[derive(Debug)]
pub(crate) struct CrossingsKernels {
    step: Kernel,
    seen: Kernel,
}

impl CrossingsKernels {
    /// **Errors**: [`BackendError::Compile`].
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        // They do not ask whether yarns are flattened: there all are.
        let kernel = |shader| Kernel::new(gpu, shader, true);
        Ok(Self { step: kernel(&crossings::MOVE)?, seen: kernel(&crossings::SEEN)? })
    }
}

/// What shaders read and write.
#[derive(Debug)]
struct Memory {
    /// Those of each pass between two waits.
    params: wgpu::Buffer,
    threads: wgpu::Buffer,
    ups: wgpu::Buffer,
    /// As they are.
    crossings: wgpu::Buffer,
    /// As others find them in the next pass, and in the one after it.
    found: wgpu::Buffer,
    next: wgpu::Buffer,
    /// What groups have seen, and what passes since the last wait have.
    group_rows: wgpu::Buffer,
    pass_rows: wgpu::Buffer,
}

impl Memory {
    fn new(gpu: &Gpu, limits: &Limits, plan: &CrossingsPlan) -> Result<Self, BackendError> {
        let mut room = Room::new(gpu, limits);
        let (passes, rows) = (u64::from(CROSSINGS_PASSES), size_of::<CrossingsSeenRow>() as u64);
        let crossings = plan.crossings() as u64;
        let bytes = size_of::<CrossingState>() as u64 * crossings;
        let groups = crossings.div_ceil(crossings::MOVE.workgroup.into());
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        Ok(Self {
            params: gpu.buffer("parameters", PARAMS_STEP * passes, uniform)?,
            threads: room.holding(gpu, "the thread table", &ThreadRow::all(plan))?,
            ups: room.holding(gpu, "the drawdown", &crossings_ups(plan))?,
            crossings: room.take(gpu, "crossings", bytes)?,
            found: room.take(gpu, "crossings as others find them", bytes)?,
            next: room.take(gpu, "crossings as others will find them", bytes)?,
            group_rows: room.take(gpu, "what groups have seen", rows * groups)?,
            pass_rows: room.take(gpu, "what was seen", rows * passes)?,
        })
    }

    /// What a shader sees as `resource` in pass `number` of those between two waits. Every other
    /// one finds what the one before it has written.
    fn resource(&self, resource: Resource, number: u32) -> Option<BindingResource<'_>> {
        let [found, next] =
            if number.is_multiple_of(2) { [&self.found, &self.next] } else { [&self.next, &self.found] };
        let buffer = match resource {
            Resource::CrossingsParams => {
                return Some(BindingResource::Buffer(BufferBinding {
                    buffer: &self.params,
                    offset: PARAMS_STEP * u64::from(number),
                    size: BufferSize::new(size_of::<CrossingsParams>() as u64),
                }));
            }
            Resource::ThreadRows => &self.threads,
            Resource::Ups => &self.ups,
            Resource::FoundCrossings => found,
            Resource::Crossings => &self.crossings,
            Resource::NextCrossings => next,
            Resource::CrossingsGroupRows => &self.group_rows,
            Resource::CrossingsPassRows => &self.pass_rows,
            _ => return None,
        };
        Some(buffer.as_entire_binding())
    }
}

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
    /// Compiles the shaders if no settler of crossings has before, and takes memory.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], [`BackendError::Compile`].
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

    /// Records so many passes that there is a row for each, hands them over at once, and waits for
    /// what they have seen.
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
        watch: &mut dyn FnMut(&CrossingsPass, CrossingsSeen) -> ControlFlow<()>,
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
