//! The work on a plan on a wgpu device: memory, launches and reading.

use std::any::Any;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere_core::{
    BackendError, Chunk, ControlPoint, Engine, MeshPiece, MeshSink, Plan, RingSink, ScanChunk, ScanChunks,
    Settler, Slot, StageTimings, Traffic, take_over_host, zeroed,
};
use texere_gpu::{YarnEnds, check_schedule, part_rows, settles_flattened};

use crate::chunk_memory::ChunkMemory;
use crate::clock::{Clock, Timed};
use crate::kernels::{Kernel, Kernels, Opened};
use crate::per_yarn;
use crate::readback::Readback;
use crate::settling::WgpuSettler;
use crate::tables::Tables;
use crate::upload::Outbox;

/// The engine of a [`WgpuSession`](crate::WgpuSession).
#[derive(Debug)]
pub struct WgpuEngine {
    opened: Arc<Opened>,
    kernels: Arc<Kernels>,
    plan: Arc<Plan>,
    ends: YarnEnds,
    tables: Tables,
    /// One for each [`Slot`].
    memory: [ChunkMemory; 2],
    outbox: Outbox,
    readback: Readback,
    clock: Clock,
    upload_time: Duration,
}

impl WgpuEngine {
    pub(crate) fn new(opened: Arc<Opened>, plan: Arc<Plan>) -> Result<Self, BackendError> {
        let gpu = &opened.gpu;
        check_schedule(opened.schedule, &plan, &gpu.name)?;
        gpu.probe()?;
        // Tables first: a device that can't hold the points says so before the host makes room for them.
        let tables = Tables::new(gpu, &plan)?;
        Ok(Self {
            ends: YarnEnds::new(&plan)?,
            tables,
            memory: [ChunkMemory::new(gpu)?, ChunkMemory::new(gpu)?],
            outbox: Outbox::default(),
            readback: Readback::new(gpu)?,
            clock: Clock::new(gpu)?,
            upload_time: Duration::ZERO,
            plan,
            kernels: opened.round.clone(),
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
        if self.ends.flattened() {
            self.kernels = self.opened.flattened()?;
        }
        Ok(())
    }

    /// Reads yarns' ends from the device where an upload of so many points needs some that never were here.
    fn find_ends(&mut self, first: u64, count: usize) -> Result<(), BackendError> {
        if self.ends.are_missing(&self.plan, first, count) {
            let total = self.plan.padded_offsets().last().copied().unwrap_or(0);
            let mut padded: Vec<ControlPoint> = zeroed("control points", total)?;
            let (gpu, source) = (&self.opened.gpu, &self.tables.points);
            let _ = self.readback.lend(gpu, source, total as u32, &mut |first, piece| {
                padded[first as usize..][..piece.len()].copy_from_slice(piece);
                ControlFlow::Continue(())
            })?;
            self.ends.renew(&self.plan, &padded);
        }
        Ok(())
    }

    /// Runs kernels one after the other on the chunk in `slot`, each with its workgroups.
    fn run(&mut self, slot: Slot, timed: Timed, kernels: &[(&Kernel, u32)]) -> Result<(), BackendError> {
        let (gpu, memory, tables) = (&self.opened.gpu, &self.memory[slot.index()], &self.tables);
        self.clock.run(gpu, timed, |pass| {
            for (kernel, workgroups) in kernels {
                let bound = kernel.bind(gpu, |resource| memory.resource(tables, resource));
                kernel.record(pass, &bound, *workgroups);
            }
        })?;
        gpu.probe()
    }
}

impl Engine for WgpuEngine {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError> {
        let start = Instant::now();
        self.find_ends(first, points.len())?;
        let upload = self.ends.upload(&self.plan, first, points);
        let gpu = &self.opened.gpu;
        let sent = self.outbox.send(gpu, &self.tables.points, &upload)?;
        // Hands a small copy over now, so that wgpu's own copy of the points does not wait until the first launch.
        gpu.scoped("Queue::submit", || gpu.queue.submit([]))?;
        gpu.probe()?;
        self.ends.keep(&upload);
        self.choose_kernels()?;
        self.upload_time += start.elapsed();
        Ok(sent)
    }

    fn take_settled(&mut self, settler: &mut dyn Settler) -> Result<Traffic, BackendError> {
        let Some(own) = (settler as &mut dyn Any).downcast_mut::<WgpuSettler>() else {
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
        let kernels = self.kernels.clone();
        // A plan with rolls is refused by the other schedule.
        let Kernels::PerRing(kernels) = &*kernels else { return Ok(()) };
        let mut last = Slot::default();
        for ScanChunk { slot, chunk, loaded } in chunks {
            if !loaded {
                self.load(slot, &chunk)?;
            }
            self.memory(slot).loaded.check(&self.plan, &chunk)?;
            // A repeated ring has no step, and its block's turn is written by the next chunk, which comes after.
            self.run(slot, Timed::Scan, &[(&kernels.block_turns, self.memory(slot).rows)])?;
            last = slot;
        }
        let yarns = self.plan.layout().yarns().len() as u32;
        self.run(last, Timed::Scan, &[(&kernels.yarn_rolls, yarns)])
    }

    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let (gpu, memory) = (&self.opened.gpu, &mut self.memory[slot.index()]);
        match &*self.kernels {
            Kernels::PerRing(_) => memory.load(gpu, &self.plan, chunk, chunk.blocks()),
            Kernels::PerYarn(_) => {
                let most_rings = per_yarn::lane_rings(gpu, self.plan.settings().sides);
                memory.load(gpu, &self.plan, chunk, &part_rows(&self.plan, chunk, most_rings))
            }
        }
    }

    fn mesh_reads_rings(&self) -> bool {
        matches!(*self.kernels, Kernels::PerYarn(_))
    }

    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.memory(slot).loaded.check(&self.plan, chunk)?;
        let kernels = self.kernels.clone();
        let memory = &mut self.memory[slot.index()];
        let rows = memory.rows;
        memory.reserve_rings(&self.opened.gpu, chunk)?;
        let kernel = match &*kernels {
            Kernels::PerRing(kernels) => (&kernels.trajectory, rows),
            Kernels::PerYarn(kernels) => (&kernels.trajectory, kernels.trajectory.workgroups(rows)),
        };
        self.run(slot, Timed::Trajectory, &[kernel])
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.memory(slot).loaded.check(&self.plan, chunk)?;
        let kernels = self.kernels.clone();
        let memory = &mut self.memory[slot.index()];
        let (rows, cap_vertices) = (memory.rows, memory.cap_vertices);
        memory.reserve_mesh(&self.opened.gpu, chunk)?;
        match &*kernels {
            Kernels::PerRing(kernels) => {
                let even = self.plan.settings().sides.is_multiple_of(2);
                let tubes = if even { &kernels.mesh } else { &kernels.mesh_odd };
                let caps = kernels.caps.workgroups(cap_vertices);
                self.run(slot, Timed::Mesh, &[(tubes, rows), (&kernels.caps, caps)])
            }
            Kernels::PerYarn(kernels) => {
                self.run(slot, Timed::Mesh, &[(&kernels.mesh, kernels.mesh.workgroups(rows))])
            }
        }
    }

    fn read_trajectory(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let rings = self.memory[slot.index()].rings.buffer();
        self.readback.lend(&self.opened.gpu, rings, chunk.rings(), &mut |_, rings| sink(rings))
    }

    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let (gpu, memory) = (&self.opened.gpu, &self.memory[slot.index()]);
        let vertices = memory.vertices.buffer();
        let flow = self.readback.lend(gpu, vertices, chunk.vertices(), &mut |first, vertices| {
            sink(MeshPiece::Vertices { first, vertices })
        })?;
        if flow.is_break() {
            return Ok(flow);
        }
        let indices = memory.indices.buffer();
        self.readback.lend(gpu, indices, chunk.indices(), &mut |first, indices| {
            sink(MeshPiece::Indices { first, indices })
        })
    }

    fn timings(&mut self) -> StageTimings {
        let on_device = self.clock.totals(&self.opened.gpu);
        StageTimings { upload: self.upload_time, readback: self.readback.waited, ..on_device }
    }
}
