//! A session: order of calls, memory, launches and reading.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere_core::{
    BackendError, Chunk, ControlPoint, Limits, MeshPiece, Plan, Ring, Session, StageTimings, Traffic,
    YarnEnds,
};

use crate::Schedule;
use crate::buffers::{Slot, Tables};
use crate::clock::{Clock, Timed};
use crate::device::Opened;
use crate::per_yarn;
use crate::readback::Readback;
use crate::stages::{Stage, Stages};
use crate::upload::Outbox;

/// One fabric on one wgpu device: a [`Session`] that lends its buffers besides.
///
/// ```no_run
/// # use std::sync::Arc;
/// # use texere_core::{Plan, Session, Yarns};
/// # fn draw(_: &wgpu::Buffer, _: &wgpu::Buffer) {}
/// # fn example(backend: &texere_wgpu::WgpuBackend, plan: Arc<Plan>, yarns: &Yarns) -> Result<(), Box<dyn std::error::Error>> {
/// use texere_core::Backend;
/// let mut session = backend.wgpu_session(plan.clone())?;
/// session.upload(0, yarns.points())?;
/// session.scan()?;
/// for chunk in plan.chunks(&backend.info().limits)? {
///     session.mesh(&chunk)?;
///     // On the device's queue, whatever comes after the mesh sees it: there is nothing to wait for.
///     draw(session.vertex_buffer(&chunk)?, session.index_buffer(&chunk)?);
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct WgpuSession {
    opened: Arc<Opened>,
    /// What a scan cuts chunks to.
    limits: Limits,
    plan: Arc<Plan>,
    ends: YarnEnds,
    scanned: bool,
    tables: Tables,
    /// Two in flight, the one launched first in front.
    slots: [Slot; 2],
    outbox: Outbox,
    readback: Readback,
    /// Read by [`Session::timings`], which takes what has come in.
    clock: RefCell<Clock>,
    upload_time: Duration,
    uploaded: u64,
}

impl WgpuSession {
    pub(crate) fn new(opened: Arc<Opened>, limits: Limits, plan: Arc<Plan>) -> Result<Self, BackendError> {
        let gpu = &opened.gpu;
        if matches!(opened.stages, Stages::PerYarn(_)) {
            Schedule::PerYarn.check(&plan, &gpu.name)?;
        }
        gpu.probe()?;
        // Tables first: a device that can't hold the points says so before the host makes room for them.
        let tables = Tables::new(gpu, &plan)?;
        Ok(Self {
            ends: YarnEnds::new(&plan)?,
            scanned: false,
            tables,
            slots: [Slot::new(gpu)?, Slot::new(gpu)?],
            outbox: Outbox::default(),
            readback: Readback::new(gpu)?,
            clock: RefCell::new(Clock::new(gpu)?),
            upload_time: Duration::ZERO,
            uploaded: 0,
            limits,
            plan,
            opened,
        })
    }

    /// The vertices of `chunk`, which [`Session::mesh`] has been called for: `chunk.vertices` of 24 bytes, position and
    /// normal, at the start of the buffer. It may be longer, and is used again for the next chunk but one.
    ///
    /// Its usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: [`BackendError::NotInFlight`].
    pub fn vertex_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, BackendError> {
        Ok(self.find(chunk, |slot| slot.has_mesh)?.vertices.buffer())
    }

    /// The indices of `chunk`, likewise: `chunk.indices` of four bytes. None with another topology than
    /// [`Indexed`](texere_core::Topology::Indexed).
    ///
    /// Its usages are `INDEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: [`BackendError::NotInFlight`].
    pub fn index_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, BackendError> {
        Ok(self.find(chunk, |slot| slot.has_mesh)?.indices.buffer())
    }

    /// Bytes of device memory that it holds: in the schedule per-ring the buffers of [`Plan::device_buffers`], each a multiple
    /// of 16 bytes, and the rings where [`Session::trajectory`] was called. Not what wgpu maps to send and read through.
    #[must_use]
    pub fn device_bytes(&self) -> u64 {
        self.tables.bytes() + self.slots.iter().map(Slot::bytes).sum::<u64>()
    }

    fn check_scanned(&self, call: &'static str) -> Result<(), BackendError> {
        if self.scanned || !self.plan.needs_scan() {
            Ok(())
        } else {
            Err(BackendError::OutOfOrder { call, needed: "scan" })
        }
    }

    fn find(&self, chunk: &Chunk, wanted: fn(&Slot) -> bool) -> Result<&Slot, BackendError> {
        self.slots
            .iter()
            .find(|slot| slot.holds(chunk) && wanted(slot))
            .ok_or(BackendError::NotInFlight { chunk: chunk.index })
    }

    /// The number of the slot with the tables of `chunk`; if there is none, that of the chunk launched longest ago,
    /// which gets them.
    fn claim(&mut self, chunk: &Chunk) -> Result<usize, BackendError> {
        if let Some(number) = self.slots.iter().position(|slot| slot.holds(chunk)) {
            return Ok(number);
        }
        let gpu = &self.opened.gpu;
        if !self.plan.holds(chunk) {
            return Err(BackendError::ForeignChunk { chunk: chunk.index });
        }
        self.slots.swap(0, 1);
        let slot = &mut self.slots[1];
        match &self.opened.stages {
            Stages::PerRing(_) => slot.take_tables(gpu, &self.plan, chunk, &chunk.blocks)?,
            Stages::PerYarn(_) => {
                let most_rings = per_yarn::lane_rings(gpu, self.plan.settings().sides);
                let rows = self.plan.part_rows(chunk, most_rings);
                slot.take_tables(gpu, &self.plan, chunk, &rows)?;
            }
        }
        Ok(1)
    }

    /// Runs stages one after the other on the chunk of slot `number`, each with its workgroups.
    fn run(&mut self, number: usize, timed: Timed, stages: &[(&Stage, u32)]) -> Result<(), BackendError> {
        let (gpu, slot, tables) = (&self.opened.gpu, &self.slots[number], &self.tables);
        self.clock.get_mut().run(gpu, timed, |pass| {
            for (stage, workgroups) in stages {
                let bound = stage.bind(gpu, |resource| slot.resource(tables, resource));
                stage.record(pass, &bound, *workgroups);
            }
        })?;
        gpu.probe()
    }
}

impl Session for WgpuSession {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), BackendError> {
        let start = Instant::now();
        let upload = self.ends.upload(&self.plan, first, points)?;
        // What was worked out before belongs to the old points.
        self.scanned = false;
        self.slots.iter_mut().for_each(Slot::forget_results);
        let gpu = &self.opened.gpu;
        let sent = self.outbox.send(gpu, &self.tables.points, &upload)?;
        // Hands a small copy over now, so that wgpu's own copy of the points does not wait until the first launch.
        gpu.scoped("Queue::submit", || gpu.queue.submit([]))?;
        gpu.probe()?;
        self.ends.keep(&upload);
        self.uploaded += sent;
        self.upload_time += start.elapsed();
        Ok(())
    }

    fn scan(&mut self) -> Result<(), BackendError> {
        let opened = self.opened.clone();
        if let Stages::PerRing(stages) = &opened.stages
            && self.plan.needs_scan()
            && !self.scanned
        {
            let plan = self.plan.clone();
            let chunks = plan.chunks(&self.limits).map_err(|source| BackendError::Driver {
                call: "cutting the plan into chunks",
                source: source.into(),
            })?;
            let mut number = 0;
            for chunk in chunks {
                number = self.claim(&chunk)?;
                // A repeated ring has no step, and its block's turn is written by the next chunk, which comes after.
                self.run(number, Timed::Scan, &[(&stages.block_turns, self.slots[number].rows)])?;
            }
            let yarns = plan.layout().yarns().len() as u32;
            self.run(number, Timed::Scan, &[(&stages.yarn_rolls, yarns)])?;
        }
        self.scanned = true;
        Ok(())
    }

    fn trajectory(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_scanned("trajectory")?;
        let number = self.claim(chunk)?;
        if self.slots[number].has_rings {
            return Ok(());
        }
        let opened = self.opened.clone();
        let slot = &mut self.slots[number];
        let rows = slot.rows;
        slot.reserve_rings(&opened.gpu, chunk, matches!(opened.stages, Stages::PerYarn(_)))?;
        let stage = match &opened.stages {
            Stages::PerRing(stages) => (&stages.trajectory, rows),
            Stages::PerYarn(stages) => (&stages.trajectory, stages.trajectory.workgroups(rows)),
        };
        self.run(number, Timed::Trajectory, &[stage])?;
        self.slots[number].has_rings = true;
        Ok(())
    }

    fn mesh(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_scanned("mesh")?;
        let opened = self.opened.clone();
        if matches!(opened.stages, Stages::PerYarn(_)) {
            self.trajectory(chunk)?;
        }
        let number = self.claim(chunk)?;
        let slot = &mut self.slots[number];
        let (rows, cap_vertices) = (slot.rows, slot.cap_vertices);
        slot.has_mesh = false;
        slot.reserve_mesh(&opened.gpu, chunk)?;
        match &opened.stages {
            Stages::PerRing(stages) => {
                let even = self.plan.settings().sides.is_multiple_of(2);
                let tubes = if even { &stages.mesh } else { &stages.mesh_odd };
                let caps = stages.caps.workgroups(cap_vertices);
                self.run(number, Timed::Mesh, &[(tubes, rows), (&stages.caps, caps)])?;
            }
            Stages::PerYarn(stages) => {
                self.run(number, Timed::Mesh, &[(&stages.mesh, stages.mesh.workgroups(rows))])?;
            }
        }
        self.slots[number].has_mesh = true;
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(&[Ring]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        self.find(chunk, |slot| slot.has_rings || slot.has_mesh)?;
        self.trajectory(chunk)?;
        let rings = self.find(chunk, |slot| slot.has_rings)?.rings.buffer().clone();
        self.readback.lend(&self.opened.gpu, &rings, chunk.rings, &mut |_, rings| sink(rings))
    }

    fn read_mesh(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let slot = self.find(chunk, |slot| slot.has_mesh)?;
        let (vertices, indices) = (slot.vertices.buffer().clone(), slot.indices.buffer().clone());
        let gpu = &self.opened.gpu;
        let flow = self.readback.lend(gpu, &vertices, chunk.vertices, &mut |first, vertices| {
            sink(MeshPiece::Vertices { first, vertices })
        })?;
        if flow.is_break() {
            return Ok(flow);
        }
        self.readback.lend(gpu, &indices, chunk.indices, &mut |first, indices| {
            sink(MeshPiece::Indices { first, indices })
        })
    }

    fn timings(&self) -> StageTimings {
        let on_device = self.clock.borrow_mut().totals(&self.opened.gpu);
        StageTimings { upload: self.upload_time, readback: self.readback.waited, ..on_device }
    }

    fn traffic(&self) -> Traffic {
        Traffic { uploaded: self.uploaded, read: self.readback.bytes }
    }
}
