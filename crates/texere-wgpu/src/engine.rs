//! The engine on a wgpu device: it holds memory, launches the schedule's kernels and reads results.

use std::any::Any;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere_core::backend::{
    AttributeSink, Chunk, Engine, MeshSink, PackedSink, Plan, RingSink, ScanChunk, ScanChunks, Slot,
    StageTimings, Traffic, take_over_host, zeroed,
};
use texere_core::settling::Settler;
use texere_core::{BackendError, ControlPoint, MeshPiece};
use texere_gpu::{Params, YarnEnds, YarnRow, check_schedule, part_rows, settles_flattened};

use texere_shaders::Resource;
use wgpu::BindingResource;

use crate::chunk_memory::ChunkMemory;
use crate::clock::{Clock, Timed};
use crate::kernel::Kernel;
use crate::kernels::Kernels;
use crate::opened::Opened;
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
    /// The memory of each [`Slot`].
    memory: Vec<ChunkMemory>,
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
        // The tables come first, so that a device that can't hold the points is noticed before the
        // host allocates memory for them.
        let tables = Tables::new(gpu, &plan)?;
        Ok(Self {
            ends: YarnEnds::new(&plan)?,
            tables,
            memory: Vec::new(),
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

    /// The binding of `resource` for the chunk in `slot`.
    pub(crate) fn resource(&self, slot: Slot, resource: Resource) -> Option<BindingResource<'_>> {
        self.memory(slot).resource(&self.tables, resource)
    }

    /// Whether a flattened control point was ever uploaded or taken from a settler.
    pub(crate) fn is_flattened(&self) -> bool {
        self.ends.flattened()
    }

    /// Returns [`BackendError::NotLoaded`] unless `chunk` is one of the plan's and its tables are
    /// in `slot`.
    fn check_loaded(&self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let not_loaded = BackendError::NotLoaded { chunk: chunk.index() };
        self.memory.get(slot.index()).ok_or(not_loaded)?.loaded.check(&self.plan, chunk)
    }

    /// The engine behind a [`LiveMesh`](texere_core::backend::LiveMesh), which lends the mesh's
    /// buffers. None if the mesh is not on a wgpu device. [`draw`](fn@crate::draw) draws the whole
    /// mesh.
    ///
    /// A live mesh has room between its yarns, in which triangles of earlier edits may lie. Draw
    /// what [`Plan::chunk_draws`] says of the mesh's current plan, and never a chunk from its first
    /// to its last index.
    ///
    /// ```no_run
    /// # fn example(mesh: &texere_core::backend::LiveMesh, pass: &mut wgpu::RenderPass<'_>) -> Option<()> {
    /// use texere_core::backend::Slot;
    /// use texere_wgpu::WgpuEngine;
    /// let engine = WgpuEngine::of(mesh.engine())?;
    /// for (number, chunk) in (0..).zip(mesh.chunks()) {
    ///     let slot = Slot::new(number);
    ///     pass.set_vertex_buffer(0, engine.vertex_buffer(slot)?.slice(..));
    ///     pass.set_index_buffer(engine.index_buffer(slot)?.slice(..), wgpu::IndexFormat::Uint32);
    ///     for draw in mesh.plan().chunk_draws(chunk) {
    ///         pass.draw_indexed(draw.indices, draw.base_vertex, 0..1);
    ///     }
    /// }
    /// # Some(())
    /// # }
    /// ```
    #[must_use]
    pub fn of(engine: &dyn Engine) -> Option<&Self> {
        (engine as &dyn Any).downcast_ref()
    }

    /// The device that the buffers are on.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.opened.gpu.device
    }

    /// The vertices of the chunk in `slot`: position and normal, 24 bytes each, from the start of
    /// the buffer. There are [`Chunk::vertices`] of them, and the buffer may be longer. None if no
    /// chunk was loaded into the slot yet. The buffer's usages are `VERTEX`, `STORAGE` and
    /// `COPY_SRC`.
    #[must_use]
    pub fn vertex_buffer(&self, slot: Slot) -> Option<&wgpu::Buffer> {
        Some(self.memory.get(slot.index())?.vertices.buffer())
    }

    /// The indices of the chunk in `slot`: four bytes each, from the start of the buffer. There are
    /// [`Chunk::indices`] of them, and the buffer may be longer. None if no chunk was loaded into
    /// the slot yet. A topology other than [`Indexed`](texere_core::Topology::Indexed) has no
    /// indices. The buffer's usages are `INDEX`, `STORAGE` and `COPY_SRC`.
    #[must_use]
    pub fn index_buffer(&self, slot: Slot) -> Option<&wgpu::Buffer> {
        Some(self.memory.get(slot.index())?.indices.buffer())
    }

    /// The attributes of the chunk in `slot`: one of 24 bytes for each vertex, from the start of
    /// the buffer, which may be longer. None if no chunk was loaded into the slot yet. The buffer's
    /// usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    #[must_use]
    pub fn attribute_buffer(&self, slot: Slot) -> Option<&wgpu::Buffer> {
        Some(self.memory.get(slot.index())?.attributes.buffer())
    }

    /// The packed vertices of the chunk in `slot`: one of 12 bytes for each vertex, from the start
    /// of the buffer, which may be longer. None if no chunk was loaded into the slot yet. The
    /// buffer's usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    #[must_use]
    pub fn packed_buffer(&self, slot: Slot) -> Option<&wgpu::Buffer> {
        Some(self.memory.get(slot.index())?.packed.buffer())
    }

    /// The bytes of device memory that the engine holds.
    pub(crate) fn device_bytes(&self) -> u64 {
        self.tables.bytes() + self.memory.iter().map(ChunkMemory::bytes).sum::<u64>()
    }

    /// Replaces the kernels for round yarns by the kernels for all yarns if a yarn is flattened.
    fn choose_kernels(&mut self) -> Result<(), BackendError> {
        if self.ends.flattened() {
            self.kernels = self.opened.flattened()?;
        }
        Ok(())
    }

    /// Reads the ends of yarns from the device, if an upload of `count` points needs some that the
    /// host does not have.
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

    /// Runs kernels one after the other on the chunk in `slot`, each with its number of workgroups.
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

    /// Runs `of_blocks` with one workgroup for each block of `chunks`, and then `of_yarns` with one
    /// workgroup for each yarn of `chunks`.
    fn run_over(
        &mut self,
        chunks: ScanChunks<'_>,
        of_blocks: &Kernel,
        of_yarns: &Kernel,
    ) -> Result<(), BackendError> {
        let (yarns, mut last) = (chunks.yarns(), None);
        for ScanChunk { slot, chunk, loaded } in chunks {
            if !loaded {
                self.load(slot, &chunk)?;
            }
            self.check_loaded(slot, &chunk)?;
            // A chunk that ends inside a yarn has a last row for the next chunk's first ring. This
            // row has no steps, so 0 is written for the next chunk's first block. The next chunk
            // overwrites the 0.
            self.run(slot, Timed::Scan, &[(of_blocks, self.memory(slot).rows)])?;
            last = Some((slot, chunk));
        }
        match last {
            Some((slot, chunk)) => self.run_for_yarns(slot, &chunk, of_yarns, &yarns),
            None => Ok(()),
        }
    }

    /// Runs `kernel` with one workgroup for each of `yarns`. `chunk`, which is in `slot`, is the
    /// last chunk with blocks of these yarns.
    fn run_for_yarns(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        kernel: &Kernel,
        yarns: &Range<usize>,
    ) -> Result<(), BackendError> {
        self.tables.set_yarns(&self.opened.gpu, &Params::of_yarns(&self.plan, chunk, yarns))?;
        let (gpu, memory, tables) = (&self.opened.gpu, &self.memory[slot.index()], &self.tables);
        self.clock.run(gpu, Timed::Scan, |pass| {
            let bound = kernel.bind(gpu, |resource| match resource {
                Resource::Params => Some(tables.of_yarns.buffer().as_entire_binding()),
                _ => memory.resource(tables, resource),
            });
            kernel.record(pass, &bound, yarns.len() as u32);
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
        // An empty submission now makes wgpu send its copy of the points, which would otherwise
        // wait until the first launch.
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
        // The schedule per-yarn refuses plans with rolls.
        let Kernels::PerRing(kernels) = &*kernels else { return Ok(()) };
        self.run_over(chunks, &kernels.block_turns, &kernels.yarn_rolls)
    }

    fn measure(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        let kernels = self.opened.attributes()?;
        self.tables.reserve_lengths(&self.opened.gpu, &self.plan)?;
        self.run_over(chunks, &kernels.block_lengths, &kernels.yarn_lengths)
    }

    fn attributes(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_loaded(slot, chunk)?;
        let kernels = self.opened.attributes()?;
        let memory = &mut self.memory[slot.index()];
        let (rows, cap_vertices) = (memory.rows, memory.cap_vertices);
        memory.reserve_attributes(&self.opened.gpu, chunk)?;
        let caps = kernels.of_caps.workgroups(cap_vertices);
        self.run(slot, Timed::Mesh, &[(&kernels.of_tubes, rows), (&kernels.of_caps, caps)])
    }

    fn read_attributes(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let attributes = self.memory[slot.index()].attributes.buffer();
        self.readback.lend(&self.opened.gpu, attributes, chunk.vertices(), sink)
    }

    fn packed(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_loaded(slot, chunk)?;
        let kernels = self.opened.packing(self.is_flattened())?;
        let memory = &mut self.memory[slot.index()];
        let (rows, cap_vertices) = (memory.rows, memory.cap_vertices);
        memory.reserve_packed(&self.opened.gpu, chunk)?;
        let even = self.plan.settings().sides.is_multiple_of(2);
        let tubes = if even { &kernels.tubes } else { &kernels.tubes_odd };
        let caps = kernels.caps.workgroups(cap_vertices);
        self.run(slot, Timed::Mesh, &[(tubes, rows), (&kernels.caps, caps)])
    }

    fn read_packed(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let packed = self.memory[slot.index()].packed.buffer();
        self.readback.lend(&self.opened.gpu, packed, chunk.vertices(), sink)
    }

    fn is_editable(&self) -> bool {
        matches!(*self.kernels, Kernels::PerRing(_))
    }

    fn replan(&mut self, plan: Arc<Plan>, yarns: Range<usize>) -> Result<(), BackendError> {
        let first = yarns.start * size_of::<YarnRow>();
        let rows = YarnRow::of(&plan, yarns.clone());
        self.opened.gpu.write(self.tables.yarns.buffer(), first as u64, bytemuck::cast_slice(&rows))?;
        self.tables.reserve_rolls(&self.opened.gpu, &plan)?;
        // Room for leans is allocated when the first yarn leans. It is empty at first, so all leans
        // are sent.
        let all = 0..plan.layout().yarns().len();
        let leaning = if self.plan.layout().leans() { yarns } else { all };
        self.tables.set_leans(&self.opened.gpu, &plan, leaning)?;
        self.plan = plan;
        Ok(())
    }

    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        while self.memory.len() <= slot.index() {
            self.memory.push(ChunkMemory::new(&self.opened.gpu)?);
        }
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
        self.check_loaded(slot, chunk)?;
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
        self.check_loaded(slot, chunk)?;
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
