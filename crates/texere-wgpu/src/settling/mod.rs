//! Settling on a wgpu device.

mod kernels;
mod list;
mod memory;
mod pass;
mod points;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::zeroed;
use texere_core::settling::{Pass, Place, Settler, SettlingPlan, SettlingSeen};
use texere_core::{BackendError, Limits};
use texere_gpu::{SettlingParams, settles_flattened};
use wgpu::{CommandEncoder, ComputePassDescriptor};

use crate::answer::Answer;
use crate::gpu::Gpu;
use crate::kernel::Kernel;
use crate::opened::Opened;
use crate::readback::Readback;

pub(crate) use kernels::SettlingKernels;
use memory::Memory;

/// The settler of a [`WgpuBackend`](crate::WgpuBackend).
#[derive(Debug)]
pub(crate) struct WgpuSettler {
    opened: Arc<Opened>,
    kernels: Arc<SettlingKernels>,
    plan: Arc<SettlingPlan>,
    params: SettlingParams,
    memory: Memory,
    /// Whether a pass has been made, and whether the places that a pass measured were kept.
    seen: bool,
    kept: bool,
    answer: Answer,
    readback: Readback,
}

impl WgpuSettler {
    /// Allocates memory, and compiles the shaders unless a settler has done so before.
    pub(crate) fn new(
        opened: Arc<Opened>,
        limits: &Limits,
        plan: Arc<SettlingPlan>,
    ) -> Result<Self, BackendError> {
        let gpu = &opened.gpu;
        gpu.probe()?;
        let memory = Memory::new(gpu, limits, &plan)?;
        Ok(Self {
            kernels: opened.settling(settles_flattened(&plan))?,
            params: SettlingParams::new(&plan),
            answer: Answer::new(gpu, memory.extents.size())?,
            readback: Readback::new(gpu)?,
            seen: false,
            kept: false,
            memory,
            plan,
            opened,
        })
    }

    fn send_params(&self) -> Result<(), BackendError> {
        self.opened.gpu.write(&self.memory.params, 0, bytemuck::bytes_of(&self.params))
    }
}

/// Submits what `record` records.
fn submit(gpu: &Gpu, record: impl FnOnce(&mut CommandEncoder)) -> Result<(), BackendError> {
    gpu.scoped("Queue::submit", || {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        record(&mut encoder);
        gpu.queue.submit([encoder.finish()]);
    })
}

/// Records kernels one after the other, each with its number of workgroups.
fn record(gpu: &Gpu, memory: &Memory, encoder: &mut CommandEncoder, kernels: &[(&Kernel, u32)]) {
    let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
    for (kernel, workgroups) in kernels {
        let bound = kernel.bind(gpu, |resource| memory.resource(resource));
        kernel.record(&mut pass, &bound, *workgroups);
    }
}

impl Settler for WgpuSettler {
    fn plan(&self) -> &Arc<SettlingPlan> {
        &self.plan
    }

    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError> {
        let (gpu, memory) = (&self.opened.gpu, &self.memory);
        let mut padded: Vec<Place> = zeroed("places", self.plan.counts().places)?;
        self.plan.pad(places.iter().copied(), &mut padded);
        gpu.write(&memory.places, 0, bytemuck::cast_slice(&padded))?;
        gpu.write(&memory.lengths, 0, bytemuck::cast_slice(self.plan.lengths()))?;
        submit(gpu, |encoder| encoder.clear_buffer(&memory.steps, 0, None))
    }

    fn list(&mut self, growth: f32) -> Result<u64, BackendError> {
        if self.params.chords == 0 {
            return Ok(0);
        }
        let listed = self.find_cells(growth).and_then(|()| self.find_neighbours());
        if listed.is_err() {
            // The list is half made, and is emptied. An error of the emptying adds nothing to the
            // first error.
            let _ = submit(&self.opened.gpu, |encoder| encoder.clear_buffer(&self.memory.starts, 0, None));
        }
        listed.map(u64::from)
    }

    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        if self.params.places == 0 {
            return Ok(SettlingSeen::NOTHING);
        }
        let seen = self.run(pass)?;
        std::mem::swap(&mut self.memory.places, &mut self.memory.seen);
        self.seen = true;
        Ok(seen)
    }

    fn keep(&mut self) -> Result<(), BackendError> {
        self.kept = self.seen;
        let Memory { seen, kept, .. } = &self.memory;
        submit(&self.opened.gpu, |encoder| encoder.copy_buffer_to_buffer(seen, 0, kept, 0, seen.size()))
    }

    fn recall(&mut self) -> Result<(), BackendError> {
        if !self.kept {
            return Ok(());
        }
        let Memory { places, kept, steps, .. } = &self.memory;
        submit(&self.opened.gpu, |encoder| {
            encoder.copy_buffer_to_buffer(kept, 0, places, 0, kept.size());
            encoder.clear_buffer(steps, 0, None);
        })
    }

    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError> {
        let mut all = Vec::with_capacity(self.params.places as usize);
        let source = &self.memory.places;
        let _ =
            self.readback.lend(&self.opened.gpu, source, self.params.places, &mut |_, piece: &[Place]| {
                all.extend_from_slice(piece);
                ControlFlow::Continue(())
            })?;
        self.plan.unpad(&all, places);
        Ok(())
    }

    fn bounds(&mut self) -> Result<[[i32; 3]; 2], BackendError> {
        self.find_bounds()
    }
}
