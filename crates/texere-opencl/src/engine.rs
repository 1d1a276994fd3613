//! The engine on an OpenCL device: it holds memory, launches the schedule's kernels and takes
//! timings.

use std::any::Any;
use std::ffi::c_void;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;
use std::time::Instant;

use opencl3::command_queue::{finish, flush};
use texere_core::backend::{
    AttributeSink, Chunk, Engine, MeshMut, MeshSink, PackedSink, Plan, RingSink, ScanChunk, ScanChunks,
    Schedule, Slot, StageTimings, Traffic, take_over_host, zeroed,
};
use texere_core::settling::Settler;
use texere_core::{BackendError, ControlPoint, Limits, MeshPiece, Vertex};
use texere_gpu::{YarnEnds, YarnRow, check_schedule, settles_flattened};

use crate::attributes::Attributes;
use crate::chunk_memory::ChunkMemory;
use crate::clock::{Clock, Stage};
use crate::device_mesh::DeviceMesh;
use crate::kernels::kernels;
use crate::opened::Opened;
use crate::packed::Packed;
use crate::readback::Readback;
use crate::settling::OpenClSettler;
use crate::tables::Tables;
use crate::upload::Outbox;
use crate::work::{Kernels, Launches, Work};

/// The engine of an [`OpenClSession`](crate::OpenClSession).
#[derive(Debug)]
pub struct OpenClEngine {
    plan: Arc<Plan>,
    ends: YarnEnds,
    tables: Tables,
    kernels: Box<dyn Kernels>,
    /// Whether the kernels are those for all yarns, rather than for round yarns alone.
    flattened: bool,
    /// The kernels and the memory of attributes. None until attributes are asked for.
    attributes: Option<Box<Attributes>>,
    /// The kernels of packed vertices: for round yarns alone, or for all yarns if `flattened`. None
    /// until packed vertices are asked for.
    packed: Option<Packed>,
    /// The memory of each [`Slot`].
    memory: Vec<ChunkMemory>,
    readback: Readback,
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
            attributes: None,
            packed: None,
            plan,
            memory: Vec::new(),
            readback: Readback::default(),
            outbox: Outbox::default(),
            clock: Clock::default(),
            opened,
        })
    }

    /// The memory of the chunk in `slot`.
    pub(crate) fn memory(&self, slot: Slot) -> &ChunkMemory {
        &self.memory[slot.index()]
    }

    /// Returns [`BackendError::NotLoaded`] unless `chunk` is one of the plan's and its tables are
    /// in `slot`.
    fn check_loaded(&self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let not_loaded = BackendError::NotLoaded { chunk: chunk.index() };
        self.memory.get(slot.index()).ok_or(not_loaded)?.loaded.check(&self.plan, chunk)
    }

    /// The engine behind a [`LiveMesh`](texere_core::backend::LiveMesh), which lends the mesh's
    /// memory. None if the mesh is not on an OpenCL device.
    ///
    /// ```no_run
    /// # fn example(mesh: &texere_core::backend::LiveMesh) -> Option<()> {
    /// use texere_core::backend::Slot;
    /// use texere_opencl::OpenClEngine;
    /// let first = OpenClEngine::of(mesh.engine())?.device_mesh(Slot::new(0))?;
    /// println!("{:?} after {:?}", first.vertices, first.ready);
    /// # Some(())
    /// # }
    /// ```
    #[must_use]
    pub fn of(engine: &dyn Engine) -> Option<&Self> {
        (engine as &dyn Any).downcast_ref()
    }

    /// The `cl_context` that the buffers are in, valid as long as the engine.
    #[must_use]
    pub fn context(&self) -> *mut c_void {
        self.opened.context.raw()
    }

    /// The `cl_command_queue` that meshes are made on, valid as long as the engine.
    #[must_use]
    pub fn queue(&self) -> *mut c_void {
        self.opened.queue.raw()
    }

    /// The device memory of the mesh of the chunk in `slot`. None if no chunk was loaded into the
    /// slot yet. A buffer that was never made is null.
    #[must_use]
    pub fn device_mesh(&self, slot: Slot) -> Option<DeviceMesh<'_>> {
        Some(DeviceMesh::new(self.memory.get(slot.index())?))
    }

    /// The bytes of device memory that the engine holds.
    pub(crate) fn device_bytes(&self) -> u64 {
        let lengths = self.attributes.as_ref().map_or(0, |attributes| attributes.lengths.bytes());
        self.tables.bytes() + lengths + self.memory.iter().map(ChunkMemory::bytes).sum::<u64>()
    }

    /// Replaces the kernels for round yarns by the kernels for all yarns if a yarn is flattened.
    fn choose_kernels(&mut self) -> Result<(), BackendError> {
        if self.ends.flattened() && !self.flattened {
            self.kernels = kernels(&self.opened, &self.plan, true)?;
            self.flattened = true;
            self.packed = None;
        }
        Ok(())
    }

    /// Starts the kernels of a stage and notes their time. Later work in the memory of `slot` waits
    /// for these kernels.
    fn run(
        &mut self,
        stage: Stage,
        slot: Option<Slot>,
        start: impl FnOnce(&mut dyn Kernels, Work<'_>, &[ChunkMemory]) -> Result<Launches, BackendError>,
    ) -> Result<(), BackendError> {
        let started = Instant::now();
        let work = Work { opened: &self.opened, plan: &self.plan, tables: &self.tables };
        let launches = start(&mut *self.kernels, work, &self.memory);
        self.note(stage, slot, started, launches)
    }

    /// [`Self::run`] for the kernels of attributes. Fails with [`BackendError::NoAttributes`] if
    /// [`Engine::measure`] has not made these kernels yet.
    fn run_attributes(
        &mut self,
        stage: Stage,
        slot: Option<Slot>,
        start: impl FnOnce(&mut Attributes, Work<'_>, &[ChunkMemory]) -> Result<Launches, BackendError>,
    ) -> Result<(), BackendError> {
        let started = Instant::now();
        let work = Work { opened: &self.opened, plan: &self.plan, tables: &self.tables };
        let attributes = self.attributes.as_mut().ok_or(BackendError::NoAttributes)?;
        let launches = start(attributes, work, &self.memory);
        self.note(stage, slot, started, launches)
    }

    /// Notes the time of a stage's launches. Later work in the memory of `slot` waits for these
    /// launches.
    fn note(
        &mut self,
        stage: Stage,
        slot: Option<Slot>,
        started: Instant,
        launches: Result<Launches, BackendError>,
    ) -> Result<(), BackendError> {
        let launches = launches.inspect_err(|_| {
            // Some kernels may be running, and nothing else would wait for them. An error of this
            // wait adds nothing to the first error.
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

impl OpenClEngine {
    /// Does `work` with each of `chunks`, after loading the chunk into its slot if it is not there.
    fn load_each(
        &mut self,
        chunks: ScanChunks<'_>,
        mut work: impl FnMut(&mut Self, Slot, &Chunk) -> Result<(), BackendError>,
    ) -> Result<(), BackendError> {
        for ScanChunk { slot, chunk, loaded } in chunks {
            if !loaded {
                self.load(slot, &chunk)?;
            }
            self.check_loaded(slot, &chunk)?;
            work(self, slot, &chunk)?;
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
        let yarns = chunks.yarns();
        self.load_each(chunks, |engine, slot, chunk| {
            engine.run(Stage::Scan, Some(slot), |kernels, work, memory| {
                kernels.block_turns(work, chunk, &memory[slot.index()])
            })
        })?;
        self.run(Stage::Scan, None, |kernels, work, _| kernels.yarn_rolls(work, yarns))
    }

    fn is_editable(&self) -> bool {
        self.opened.schedule == Schedule::PerRing
    }

    fn replan(&mut self, plan: Arc<Plan>, yarns: Range<usize>) -> Result<(), BackendError> {
        let first = yarns.start * size_of::<YarnRow>();
        // The rows are sent through the queue of the kernels, so that earlier kernels still read
        // the earlier rows.
        let rows = YarnRow::of(&plan, yarns.clone());
        self.tables.yarns.write(&self.opened, &self.opened.queue, first as u64, &rows, None)?;
        self.tables.reserve_rolls(&self.opened, &plan)?;
        // Room for leans is allocated when the first yarn leans. It is empty at first, so all leans
        // are sent.
        let all = 0..plan.layout().yarns().len();
        let leaning = if self.plan.layout().leans() { yarns } else { all };
        self.tables.set_leans(&self.opened, &plan, leaning)?;
        self.plan = plan;
        Ok(())
    }

    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.memory.resize_with(self.memory.len().max(slot.index() + 1), ChunkMemory::default);
        self.memory[slot.index()].load(&self.opened, &self.plan, chunk)
    }

    fn mesh_reads_rings(&self) -> bool {
        self.kernels.mesh_reads_rings()
    }

    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_loaded(slot, chunk)?;
        self.memory[slot.index()].reserve_rings(&self.opened, chunk)?;
        self.run(Stage::Trajectory, Some(slot), |kernels, work, memory| {
            kernels.trajectory(work, chunk, &memory[slot.index()])
        })
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_loaded(slot, chunk)?;
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
        let Self { opened, memory, readback, clock, .. } = self;
        let ChunkMemory { rings, ready, .. } = &memory[slot.index()];
        readback.read(opened, rings, chunk.rings(), ready.as_deref(), clock, &mut |_, rings| sink(rings))
    }

    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { opened, memory, readback, clock, .. } = self;
        let ChunkMemory { vertices, indices, ready, .. } = &memory[slot.index()];
        let ready = ready.as_deref();
        let flow = readback.read(
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
        readback.read(opened, indices, chunk.indices(), ready, clock, &mut |first, indices: &[u32]| {
            sink(MeshPiece::Indices { first, indices })
        })
    }

    fn measure(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        if self.attributes.is_none() {
            self.attributes = Some(Box::new(Attributes::new(&self.opened, &self.plan)?));
        }
        let yarns = chunks.yarns();
        self.load_each(chunks, |engine, slot, chunk| {
            engine.run_attributes(Stage::Scan, Some(slot), |attributes, work, memory| {
                attributes.block_lengths(work, chunk, &memory[slot.index()])
            })
        })?;
        self.run_attributes(Stage::Scan, None, |attributes, work, _| attributes.yarn_lengths(work, yarns))
    }

    fn attributes(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_loaded(slot, chunk)?;
        self.memory[slot.index()].reserve_attributes(&self.opened, chunk)?;
        self.run_attributes(Stage::Mesh, Some(slot), |attributes, work, memory| {
            attributes.make(work, chunk, &memory[slot.index()])
        })
    }

    fn read_attributes(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { opened, memory, readback, clock, .. } = self;
        let ChunkMemory { attributes, ready, .. } = &memory[slot.index()];
        readback.read(opened, attributes, chunk.vertices(), ready.as_deref(), clock, sink)
    }

    fn packed(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_loaded(slot, chunk)?;
        let mut packed = match self.packed.take() {
            Some(packed) => packed,
            None => Packed::new(&self.opened, &self.plan, self.flattened)?,
        };
        self.memory[slot.index()].reserve_packed(&self.opened, chunk)?;
        let started = Instant::now();
        let work = Work { opened: &self.opened, plan: &self.plan, tables: &self.tables };
        let launches = packed.make(work, chunk, &self.memory[slot.index()]);
        self.packed = Some(packed);
        self.note(Stage::Mesh, Some(slot), started, launches)
    }

    fn read_packed(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { opened, memory, readback, clock, .. } = self;
        let ChunkMemory { packed, ready, .. } = &memory[slot.index()];
        readback.read(opened, packed, chunk.vertices(), ready.as_deref(), clock, sink)
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
