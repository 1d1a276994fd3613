//! The work on a plan on an OpenCL device: memory and timings; the kernels are the schedule's.

use std::any::Any;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use opencl3::command_queue::{finish, flush};
use texere_core::{
    BackendError, Chunk, ControlPoint, Engine, Limits, MeshMut, MeshPiece, MeshSink, Plan, RingSink,
    ScanChunk, ScanChunks, Settler, Slot, StageTimings, Traffic, Vertex, take_over_host, zeroed,
};
use texere_gpu::{YarnEnds, check_schedule, settles_flattened};

use crate::buffers::Staging;
use crate::chunk_memory::ChunkMemory;
use crate::clock::{Clock, Stage};
use crate::kernels::{Kernels, Launches, Work, kernels};
use crate::opened::Opened;
use crate::settling::OpenClSettler;
use crate::tables::Tables;
use crate::upload::Outbox;

/// The engine of an [`OpenClSession`](crate::OpenClSession).
#[derive(Debug)]
pub struct OpenClEngine {
    plan: Arc<Plan>,
    ends: YarnEnds,
    tables: Tables,
    kernels: Box<dyn Kernels>,
    /// Whether the kernels are those for all yarns.
    flattened: bool,
    /// One for each [`Slot`].
    memory: [ChunkMemory; 2],
    staging: Staging,
    outbox: Outbox,
    clock: Clock,
    opened: Arc<Opened>,
}

impl OpenClEngine {
    pub(crate) fn new(opened: Arc<Opened>, limits: &Limits, plan: Arc<Plan>) -> Result<Self, BackendError> {
        check_schedule(opened.schedule, &plan, &opened.name)?;
        Ok(Self {
            ends: YarnEnds::new(&plan)?,
            tables: Tables::new(&opened, limits, &plan)?,
            kernels: kernels(&opened, &plan, false)?,
            flattened: false,
            plan,
            memory: Default::default(),
            staging: Staging::default(),
            outbox: Outbox::default(),
            clock: Clock::default(),
            opened,
        })
    }

    /// The memory of the chunk in `slot`.
    pub(crate) fn memory(&self, slot: Slot) -> &ChunkMemory {
        &self.memory[slot.index()]
    }

    /// Bytes of device memory that it holds.
    pub(crate) fn device_bytes(&self) -> u64 {
        self.tables.bytes() + self.memory.iter().map(ChunkMemory::bytes).sum::<u64>()
    }

    /// Takes the kernels for all yarns where one is not round.
    fn choose_kernels(&mut self) -> Result<(), BackendError> {
        if self.ends.flattened() && !self.flattened {
            self.kernels = kernels(&self.opened, &self.plan, true)?;
            self.flattened = true;
        }
        Ok(())
    }

    /// Starts the kernels of a stage, notes their time, and lets the memory of `slot` wait for them.
    fn run(
        &mut self,
        stage: Stage,
        slot: Option<Slot>,
        start: impl FnOnce(&mut dyn Kernels, Work<'_>, &[ChunkMemory; 2]) -> Result<Launches, BackendError>,
    ) -> Result<(), BackendError> {
        let started = Instant::now();
        let work = Work { opened: &self.opened, plan: &self.plan, tables: &self.tables };
        let launches = start(&mut *self.kernels, work, &self.memory).inspect_err(|_| {
            // Some kernels may be running, and nobody else would wait for them. An error of this wait adds nothing.
            let _ = finish(self.opened.queue.raw());
        })?;
        if self.opened.profiled {
            launches.iter().for_each(|event| self.clock.note(stage, event));
            flush(self.opened.queue.raw()).map_err(self.opened.failed("clFlush"))?;
        } else {
            finish(self.opened.queue.raw()).map_err(self.opened.failed("clFinish"))?;
            self.clock.add(stage, started.elapsed());
        }
        if let (Some(slot), Some(last)) = (slot, launches.last()) {
            self.memory[slot.index()].ready = Some(last.clone());
        }
        Ok(())
    }
}

impl Engine for OpenClEngine {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError> {
        let started = Instant::now();
        let Self { opened, plan, ends, tables, outbox, clock, .. } = self;
        if ends.are_missing(plan, first, points.len()) {
            let mut padded: Vec<ControlPoint> =
                zeroed("control points", plan.padded_offsets().last().copied().unwrap_or(0))?;
            tables.points.read_now(opened, 0, &mut padded)?;
            ends.renew(plan, &padded);
        }
        let upload = ends.upload(plan, first, points);
        let sent = outbox.send(opened, &mut tables.points, &upload, clock)?;
        ends.keep(&upload);
        if !opened.profiled {
            finish(opened.queue.raw()).map_err(opened.failed("clFinish"))?;
            clock.add(Stage::Upload, started.elapsed());
        }
        self.choose_kernels()?;
        Ok(sent)
    }

    fn take_settled(&mut self, settler: &mut dyn Settler) -> Result<Traffic, BackendError> {
        let Some(own) = (settler as &mut dyn Any).downcast_mut::<OpenClSettler>() else {
            return take_over_host(self, settler);
        };
        if !own.write_points(&self.opened, &self.plan, &self.tables.points)? {
            return take_over_host(self, settler);
        }
        self.ends.forget(settles_flattened(own.plan()));
        self.choose_kernels()?;
        Ok(Traffic::default())
    }

    fn scan(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        for ScanChunk { slot, chunk, loaded } in chunks {
            if !loaded {
                self.load(slot, &chunk)?;
            }
            self.memory[slot.index()].loaded.check(&self.plan, &chunk)?;
            self.run(Stage::Scan, Some(slot), |kernels, work, memory| {
                kernels.block_turns(work, &chunk, &memory[slot.index()])
            })?;
        }
        self.run(Stage::Scan, None, |kernels, work, _| kernels.yarn_rolls(work))
    }

    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.memory[slot.index()].load(&self.opened, &self.plan, chunk)
    }

    fn mesh_reads_rings(&self) -> bool {
        self.kernels.mesh_reads_rings()
    }

    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.memory[slot.index()].loaded.check(&self.plan, chunk)?;
        self.memory[slot.index()].reserve_rings(&self.opened, chunk)?;
        self.run(Stage::Trajectory, Some(slot), |kernels, work, memory| {
            kernels.trajectory(work, chunk, &memory[slot.index()])
        })
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.memory[slot.index()].loaded.check(&self.plan, chunk)?;
        self.memory[slot.index()].reserve_mesh(&self.opened, &self.plan, chunk)?;
        self.run(Stage::Mesh, Some(slot), |kernels, work, memory| {
            kernels.mesh(work, chunk, &memory[slot.index()])
        })
    }

    fn read_trajectory(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { opened, memory, staging, clock, .. } = self;
        let ChunkMemory { rings, ready, .. } = &memory[slot.index()];
        staging.read(opened, rings, chunk.rings(), ready.as_deref(), clock, &mut |_, rings| sink(rings))
    }

    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { opened, memory, staging, clock, .. } = self;
        let ChunkMemory { vertices, indices, ready, .. } = &memory[slot.index()];
        let ready = ready.as_deref();
        let flow = staging.read(
            opened,
            vertices,
            chunk.vertices(),
            ready,
            clock,
            &mut |first, vertices: &[Vertex]| sink(MeshPiece::Vertices { first, vertices }),
        )?;
        if flow.is_break() {
            return Ok(flow);
        }
        staging.read(opened, indices, chunk.indices(), ready, clock, &mut |first, indices: &[u32]| {
            sink(MeshPiece::Indices { first, indices })
        })
    }

    fn mesh_into(&mut self, slot: Slot, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        self.mesh(slot, chunk)?;
        let Self { opened, memory, clock, .. } = self;
        let ChunkMemory { vertices, indices, ready, .. } = &memory[slot.index()];
        vertices.read_into(opened, out.vertices, ready.as_deref(), clock)?;
        indices.read_into(opened, out.indices, ready.as_deref(), clock)
    }

    fn timings(&mut self) -> StageTimings {
        self.clock.timings()
    }
}
