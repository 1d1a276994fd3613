//! Settling on an OpenCL device.

mod list;
mod memory;
mod pass;
mod points;

use std::sync::Arc;

use texere_core::backend::{Plan, zeroed};
use texere_core::settling::{Pass, Place, Settler, SettlingPlan, SettlingSeen};
use texere_core::{BackendError, Limits};
use texere_gpu::{SettlingParams, settles_flattened};
use texere_kernels::EntryPoint;

use crate::buffer::Buffer;
use crate::kernel::Kernel;
use crate::opened::Opened;
use list::ListKernels;
use memory::Memory;
use pass::PassKernels;
use points::PointKernels;

/// The settler of an [`OpenClBackend`](crate::OpenClBackend).
#[derive(Debug)]
pub(crate) struct OpenClSettler {
    plan: Arc<SettlingPlan>,
    params: SettlingParams,
    list: ListKernels,
    pass: PassKernels,
    points: PointKernels,
    memory: Memory,
    /// Whether a pass has been made, and whether the places that a pass measured were kept.
    seen: bool,
    kept: bool,
    opened: Arc<Opened>,
}

impl OpenClSettler {
    /// Allocates memory, and compiles the kernels unless a settler has done so before.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], [`BackendError::Compile`], and
    /// [`BackendError::Driver`] or [`BackendError::DeviceLost`] if another call of OpenCL fails.
    pub(crate) fn new(
        opened: Arc<Opened>,
        limits: &Limits,
        plan: Arc<SettlingPlan>,
    ) -> Result<Self, BackendError> {
        let program = opened.settling(settles_flattened(&plan))?;
        let kernel = |entry: EntryPoint| Kernel::of(&opened, program, entry);
        Ok(Self {
            params: SettlingParams::new(&plan),
            list: ListKernels::new(&kernel)?,
            pass: PassKernels::new(&kernel)?,
            points: PointKernels::new(&kernel)?,
            memory: Memory::new(&opened, limits, &plan)?,
            seen: false,
            kept: false,
            plan,
            opened,
        })
    }

    /// Writes all control points, padded as `plan` says, to `points`, if that buffer belongs to the
    /// same open device. Returns whether it does.
    pub(crate) fn write_points(
        &mut self,
        opened: &Arc<Opened>,
        plan: &Plan,
        points: &Buffer,
    ) -> Result<bool, BackendError> {
        let own = Arc::ptr_eq(opened, &self.opened);
        if own {
            self.points.write(opened, (&self.plan, &self.memory), plan, points)?;
        }
        Ok(own)
    }
}

impl Settler for OpenClSettler {
    fn plan(&self) -> &Arc<SettlingPlan> {
        &self.plan
    }

    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError> {
        let Self { opened, memory, plan, .. } = self;
        let mut padded: Vec<Place> = zeroed("places", plan.counts().places)?;
        plan.pad(places.iter().copied(), &mut padded);
        memory.places.write(opened, &opened.queue, 0, &padded, None)?;
        memory.lengths.write(opened, &opened.queue, 0, plan.lengths(), None)?;
        memory.steps.clear(opened)
    }

    fn list(&mut self, growth: f32) -> Result<u64, BackendError> {
        let Self { opened, memory, plan, list, pass, params, .. } = self;
        if params.chords == 0 {
            return Ok(0);
        }
        let params = SettlingParams { growth, ..*params };
        let listed = pass
            .chords(opened, &params, memory)
            .and_then(|()| list.cells(opened, plan, &params, memory))
            .and_then(|params| list.neighbours(opened, plan, &params, memory));
        if listed.is_err() {
            // The list is half made, and is emptied. An error of the emptying adds nothing to the
            // first error.
            let _ = memory.starts.clear(opened);
        }
        listed.map(u64::from)
    }

    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        let params = self.params.with_pass(&self.plan, pass);
        if params.places == 0 {
            return Ok(SettlingSeen::NOTHING);
        }
        let seen = self.pass.run(&self.opened, &params, pass.form, &self.memory)?;
        std::mem::swap(&mut self.memory.places, &mut self.memory.seen);
        self.seen = true;
        Ok(seen)
    }

    fn keep(&mut self) -> Result<(), BackendError> {
        self.kept = self.seen;
        let Memory { kept, seen, .. } = &mut self.memory;
        kept.copy(&self.opened, seen)
    }

    fn recall(&mut self) -> Result<(), BackendError> {
        if self.kept {
            let Memory { places, kept, steps, .. } = &mut self.memory;
            places.copy(&self.opened, kept)?;
            steps.clear(&self.opened)?;
        }
        Ok(())
    }

    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError> {
        let mut all: Vec<Place> = zeroed("places", self.plan.counts().places)?;
        self.memory.places.read_now(&self.opened, 0, &mut all)?;
        self.plan.unpad(&all, places);
        Ok(())
    }

    fn bounds(&mut self) -> Result<[[i32; 3]; 2], BackendError> {
        self.points.bounds(&self.opened, &self.plan, &self.memory)
    }
}
