//! A session on an OpenCL device: memory, order of calls, timings; the stages themselves are the schedule's.

use std::ffi::c_void;
use std::marker::PhantomData;
use std::ops::ControlFlow;
use std::ptr;
use std::sync::Arc;
use std::time::Instant;

use opencl3::command_queue::{finish, flush};
use texere_core::{
    BackendError, Chunk, ControlPoint, Limits, MeshMut, MeshPiece, Plan, Ring, Session, StageTimings,
    Traffic, Vertex, YarnEnds, check_output,
};

use crate::Schedule;
use crate::backend::Opened;
use crate::buffers::{Meter, Staging};
use crate::clock::{Clock, Stage};
use crate::handles::Handle;
use crate::per_yarn::PerYarn;
use crate::resident::Resident;
use crate::slot::Slot;
use crate::stages::{Launches, PerRing, Stages, Work};
use crate::upload::Outbox;

/// One fabric on one device. Beyond [`Session`] it lends a chunk's mesh where it lies.
///
/// Control points stay on the device whole; a chunk's results stay until a stage is run for the next chunk but one.
///
/// ```no_run
/// use std::sync::Arc;
/// use texere_core::{ControlPoint, Limits, Plan, Session, Settings, Yarn, Yarns};
/// use texere_opencl::{OpenClBackend, Schedule};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default())?);
/// let mut session = OpenClBackend::open(0, Schedule::PerRing)?.session_on_device(plan.clone())?;
/// session.upload(0, yarns.points())?;
/// for chunk in plan.chunks(&Limits::NONE)? {
///     session.mesh(&chunk)?;
///     let mesh = session.device_mesh(&chunk)?;
///     println!("{} vertices in {:?} after {:?}", chunk.vertices, mesh.vertices, mesh.ready);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct OpenClSession {
    plan: Arc<Plan>,
    /// What a scan cuts chunks to.
    limits: Limits,
    ends: YarnEnds,
    resident: Resident,
    stages: Box<dyn Stages>,
    scanned: bool,
    /// Two in flight, the one launched first in front.
    slots: [Slot; 2],
    staging: Staging,
    outbox: Outbox,
    clock: Clock,
    traffic: Traffic,
    opened: Arc<Opened>,
}

/// A chunk's mesh in the device's memory. Valid as long as it is borrowed: until the session's next call.
#[derive(Debug)]
pub struct DeviceMesh<'a> {
    /// A `cl_mem` with the chunk's [`Vertex`]es from its start.
    pub vertices: *mut c_void,
    /// A `cl_mem` with the chunk's `u32` indices from its start; null where it has none.
    pub indices: *mut c_void,
    /// The `cl_event` of the last command that writes them: wait for it, also in a queue.
    pub ready: *mut c_void,
    session: PhantomData<&'a OpenClSession>,
}

impl OpenClSession {
    pub(crate) fn new(opened: Arc<Opened>, limits: Limits, plan: Arc<Plan>) -> Result<Self, BackendError> {
        let stages: Box<dyn Stages> = match opened.schedule {
            Schedule::PerRing => Box::new(PerRing::new(&opened, &plan)?),
            Schedule::PerYarn => Box::new(PerYarn::new(&opened, &plan)?),
        };
        Ok(Self {
            ends: YarnEnds::new(&plan)?,
            resident: Resident::new(&opened, &limits, &plan)?,
            plan,
            limits,
            stages,
            scanned: false,
            slots: Default::default(),
            staging: Staging::default(),
            outbox: Outbox::default(),
            clock: Clock::default(),
            traffic: Traffic::default(),
            opened,
        })
    }

    /// The mesh of `chunk` where it lies on the device, for a caller who draws it or works on with it there.
    ///
    /// **Errors**: [`BackendError::NotInFlight`] unless [`Session::mesh`] has been called for this chunk.
    pub fn device_mesh(&self, chunk: &Chunk) -> Result<DeviceMesh<'_>, BackendError> {
        let slot = &self.slots[self.find(chunk, |slot| slot.has_mesh)?];
        Ok(DeviceMesh {
            vertices: slot.vertices.raw(),
            indices: if chunk.indices > 0 { slot.indices.raw() } else { ptr::null_mut() },
            ready: slot.ready.as_deref().map_or(ptr::null_mut(), Handle::raw),
            session: PhantomData,
        })
    }

    /// Bytes of device memory that it holds: in the schedule per-ring the buffers of [`Plan::device_buffers`], and the rings where
    /// [`Session::trajectory`] was called.
    #[must_use]
    pub fn device_bytes(&self) -> u64 {
        self.resident.bytes() + self.slots.iter().map(Slot::bytes).sum::<u64>()
    }

    fn check_scanned(&self, call: &'static str) -> Result<(), BackendError> {
        if self.scanned || !self.plan.needs_scan() {
            Ok(())
        } else {
            Err(BackendError::OutOfOrder { call, needed: "scan" })
        }
    }

    /// The place of `chunk`'s slot; if it is new, that of the chunk launched longest ago takes it.
    ///
    /// **Errors**: [`BackendError::ForeignChunk`] for a chunk that the plan did not cut: no kernel checks its bounds.
    fn claim(&mut self, chunk: &Chunk) -> Result<usize, BackendError> {
        if let Some(place) = self.slots.iter().position(|slot| slot.holds(chunk)) {
            return Ok(place);
        }
        // Before any slot is given up: a chunk that is refused takes no place.
        if !self.plan.holds(chunk) {
            return Err(BackendError::ForeignChunk { chunk: chunk.index });
        }
        self.slots.swap(0, 1);
        self.slots[1].take(&self.opened, &self.plan, chunk)?;
        Ok(1)
    }

    fn find(&self, chunk: &Chunk, wanted: fn(&Slot) -> bool) -> Result<usize, BackendError> {
        self.slots
            .iter()
            .position(|slot| slot.holds(chunk) && wanted(slot))
            .ok_or(BackendError::NotInFlight { chunk: chunk.index })
    }

    /// Runs stage 1 for the chunk in the slot at `place` unless it has run.
    fn ensure_rings(&mut self, chunk: &Chunk, place: usize) -> Result<(), BackendError> {
        if self.slots[place].has_rings {
            return Ok(());
        }
        self.slots[place].reserve_rings(&self.opened, chunk)?;
        self.run(Stage::Trajectory, Some(place), |stages, work, slots| {
            stages.trajectory(work, chunk, &slots[place])
        })?;
        self.slots[place].has_rings = true;
        Ok(())
    }

    /// Starts the kernels of a stage, notes their time, and lets the slot at `place` wait for them.
    fn run(
        &mut self,
        stage: Stage,
        place: Option<usize>,
        start: impl FnOnce(&mut dyn Stages, Work<'_>, &[Slot; 2]) -> Result<Launches, BackendError>,
    ) -> Result<(), BackendError> {
        let started = Instant::now();
        let work = Work { opened: &self.opened, plan: &self.plan, resident: &self.resident };
        let launches = start(&mut *self.stages, work, &self.slots)?;
        if self.opened.profiled {
            launches.iter().for_each(|event| self.clock.note(stage, event));
            flush(self.opened.queue.raw()).map_err(self.opened.failed("clFlush"))?;
        } else {
            finish(self.opened.queue.raw()).map_err(self.opened.failed("clFinish"))?;
            self.clock.add(stage, started.elapsed());
        }
        if let (Some(place), Some(last)) = (place, launches.last()) {
            self.slots[place].ready = Some(last.clone());
        }
        Ok(())
    }
}

impl Session for OpenClSession {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), BackendError> {
        let started = Instant::now();
        let upload = self.ends.upload(&self.plan, first, points)?;
        // What was worked out before belongs to the old points.
        self.scanned = false;
        self.slots.iter_mut().for_each(Slot::forget_results);
        let Self { opened, resident, outbox, clock, traffic, .. } = self;
        outbox.send(opened, &mut resident.points, &upload, &mut Meter { clock, traffic })?;
        self.ends.keep(&upload);
        if !self.opened.profiled {
            finish(self.opened.queue.raw()).map_err(self.opened.failed("clFinish"))?;
            self.clock.add(Stage::Upload, started.elapsed());
        }
        Ok(())
    }

    fn scan(&mut self) -> Result<(), BackendError> {
        if self.plan.needs_scan() && !self.scanned {
            let plan = self.plan.clone();
            let chunks = plan.chunks(&self.limits).map_err(|source| BackendError::Driver {
                call: "cutting the plan into chunks",
                source: source.into(),
            })?;
            for chunk in chunks {
                let place = self.claim(&chunk)?;
                self.run(Stage::Scan, Some(place), |stages, work, slots| {
                    stages.block_turns(work, &chunk, &slots[place])
                })?;
            }
            self.run(Stage::Scan, None, |stages, work, _| stages.yarn_rolls(work))?;
        }
        self.scanned = true;
        Ok(())
    }

    fn trajectory(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_scanned("trajectory")?;
        let place = self.claim(chunk)?;
        self.ensure_rings(chunk, place)
    }

    fn mesh(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_scanned("mesh")?;
        let place = self.claim(chunk)?;
        if self.stages.mesh_reads_rings() {
            self.ensure_rings(chunk, place)?;
        }
        self.slots[place].reserve_mesh(&self.opened, &self.plan, chunk)?;
        self.run(Stage::Mesh, Some(place), |stages, work, slots| stages.mesh(work, chunk, &slots[place]))?;
        self.slots[place].has_mesh = true;
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(&[Ring]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let place = self.find(chunk, |slot| slot.has_rings || slot.has_mesh)?;
        self.ensure_rings(chunk, place)?;
        let Self { opened, slots, staging, clock, traffic, .. } = self;
        let slot = &slots[place];
        staging.read(
            opened,
            &slot.rings,
            chunk.rings,
            slot.ready.as_deref(),
            &mut Meter { clock, traffic },
            &mut |_, rings| sink(rings),
        )
    }

    fn read_mesh(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let place = self.find(chunk, |slot| slot.has_mesh)?;
        let Self { opened, slots, staging, clock, traffic, .. } = self;
        let (slot, mut meter) = (&slots[place], Meter { clock, traffic });
        let flow = staging.read(
            opened,
            &slot.vertices,
            chunk.vertices,
            slot.ready.as_deref(),
            &mut meter,
            &mut |first, vertices: &[Vertex]| sink(MeshPiece::Vertices { first, vertices }),
        )?;
        if flow.is_break() {
            return Ok(flow);
        }
        staging.read(
            opened,
            &slot.indices,
            chunk.indices,
            slot.ready.as_deref(),
            &mut meter,
            &mut |first, indices: &[u32]| sink(MeshPiece::Indices { first, indices }),
        )
    }

    fn mesh_into(&mut self, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        check_output(chunk, &out)?;
        self.mesh(chunk)?;
        let place = self.find(chunk, |slot| slot.has_mesh)?;
        let Self { opened, slots, clock, traffic, .. } = self;
        let (slot, mut meter) = (&slots[place], Meter { clock, traffic });
        slot.vertices.read_into(opened, out.vertices, slot.ready.as_deref(), &mut meter)?;
        slot.indices.read_into(opened, out.indices, slot.ready.as_deref(), &mut meter)
    }

    fn timings(&self) -> StageTimings {
        self.clock.timings()
    }

    fn traffic(&self) -> Traffic {
        self.traffic
    }
}
