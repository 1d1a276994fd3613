//! The engine on a CPU, which holds memory and takes timings. An [`Executor`] runs the stages.

use std::fmt::Debug;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere_core::backend::{
    AttributeSink, Chunk, Engine, MeshMut, MeshSink, PackedSink, PaddedPoints, Plan, RingSink, ScanChunks,
    Slot, StageTimings, zeroed,
};
use texere_core::definitions::Ring;
use texere_core::{
    ArcLength, Attribute, BackendError, ControlPoint, MeshPiece, OutOfMemory, PackedVertex, Vertex,
};

use crate::pages;
use crate::rolls::Rolls;

/// The input of all stages.
#[derive(Debug)]
pub(crate) struct Work {
    pub(crate) plan: Arc<Plan>,
    pub(crate) points: PaddedPoints,
    pub(crate) rolls: Rolls,
    /// For each block, the length of its yarn up to the block's first ring. Empty until attributes
    /// are asked for.
    pub(crate) lengths: Vec<ArcLength>,
}

/// A way to run the scan and the stages on a CPU.
pub(crate) trait Executor: Copy + Debug + Send + 'static {
    /// Whether `mesh` and `packed` work out their rings themselves, rather than read those of
    /// `trajectory`.
    const FUSED: bool;
    /// Works out the rolls of `yarns`. The rolls of other yarns stay as they are.
    fn scan(
        self,
        plan: &Plan,
        points: &PaddedPoints,
        rolls: &mut Rolls,
        yarns: Range<usize>,
    ) -> Result<(), BackendError>;
    fn trajectory(self, work: &Work, chunk: &Chunk, out: &mut [Ring]);
    /// Makes the mesh of `chunk`. `rings` are the chunk's rings; they have no meaning if the
    /// executor is [`FUSED`](Self::FUSED). `out` is a part of an output of `bytes` bytes. All of
    /// that output is filled before any of it is read, so its size says whether the caches can hold
    /// it.
    fn mesh(self, work: &Work, chunk: &Chunk, rings: &[Ring], out: MeshMut<'_>, bytes: u64);
    /// Makes the packed vertices of `chunk`. `rings` are the chunk's rings; they have no meaning if
    /// the executor is [`FUSED`](Self::FUSED).
    fn packed(self, work: &Work, chunk: &Chunk, rings: &[Ring], out: &mut [PackedVertex]);
    /// Works out the lengths of `yarns` up to the start of each block. `lengths` has one value for
    /// each block of the plan.
    fn measure(self, plan: &Plan, points: &PaddedPoints, lengths: &mut [ArcLength], yarns: Range<usize>);
    fn attributes(self, work: &Work, chunk: &Chunk, out: &mut [Attribute]);
}

/// The memory of one chunk at a time. Later chunks of the same slot use it again.
#[derive(Debug, Default)]
struct ChunkMemory {
    rings: Vec<Ring>,
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
    attributes: Vec<Attribute>,
    packed: Vec<PackedVertex>,
}

#[derive(Debug)]
pub(crate) struct CpuEngine<E> {
    work: Work,
    /// The memory of each [`Slot`].
    memory: Vec<ChunkMemory>,
    timings: StageTimings,
    executor: E,
}

impl<E: Executor> CpuEngine<E> {
    pub(crate) fn new(executor: E, plan: Arc<Plan>) -> Result<Self, BackendError> {
        let points = PaddedPoints::new(&plan)?;
        pages::prefer_huge(points.points());
        Ok(Self {
            work: Work { plan, points, rolls: Rolls::default(), lengths: Vec::new() },
            memory: Vec::new(),
            timings: StageTimings::default(),
            executor,
        })
    }
}

/// Makes `buffer` `length` values long. If its memory is too small, new memory full of zeros takes
/// its place. Otherwise its first values stay, and zeros are added if it was shorter.
pub(crate) fn resize<T: bytemuck::Zeroable>(
    what: &'static str,
    buffer: &mut Vec<T>,
    length: u64,
) -> Result<(), OutOfMemory> {
    if (buffer.capacity() as u64) < length {
        *buffer = zeroed(what, length)?;
    }
    buffer.resize_with(length as usize, T::zeroed);
    Ok(())
}

/// The number of rings that are scanned between two checks for a cancellation: some 10 ms of a slow
/// core.
const SCAN_RINGS: u64 = 1 << 17;

/// `yarns` in batches of about [`SCAN_RINGS`] rings. Each yarn lies in one batch.
fn batches(plan: &Plan, yarns: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let (offsets, mut first) = (plan.ring_offsets(), yarns.start);
    std::iter::from_fn(move || {
        let from = first;
        let end = offsets.partition_point(|offset| *offset < offsets[from] + SCAN_RINGS);
        first = end.clamp(from + 1, yarns.end.max(from + 1));
        (from < yarns.end).then_some(from..first)
    })
}

fn timed<T>(total: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed();
    result
}

impl<E: Executor> Engine for CpuEngine<E> {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError> {
        let Work { plan, points: padded, .. } = &mut self.work;
        let sent = timed(&mut self.timings.upload, || padded.upload(plan, first, points));
        Ok((sent.end - sent.start) * size_of::<ControlPoint>() as u64)
    }

    fn is_editable(&self) -> bool {
        true
    }

    fn replan(&mut self, plan: Arc<Plan>, _yarns: Range<usize>) -> Result<(), BackendError> {
        self.work.plan = plan;
        Ok(())
    }

    fn scan(&mut self, mut chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        let Self { work: Work { plan, points, rolls, .. }, timings, executor, .. } = self;
        timed(&mut timings.scan, || {
            batches(plan, chunks.yarns())
                .take_while(|_| chunks.watch().is_continue())
                .try_for_each(|yarns| executor.scan(plan, points, rolls, yarns))
        })
    }

    /// Makes room for the slot. Nothing else is needed: the stages read the tables of the chunk
    /// itself.
    fn load(&mut self, slot: Slot, _chunk: &Chunk) -> Result<(), BackendError> {
        self.memory.resize_with(self.memory.len().max(slot.index() + 1), ChunkMemory::default);
        Ok(())
    }

    fn mesh_reads_rings(&self) -> bool {
        !E::FUSED
    }

    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let rings = &mut self.memory[slot.index()].rings;
        resize("rings", rings, chunk.rings().into())?;
        timed(&mut self.timings.trajectory, || self.executor.trajectory(&self.work, chunk, rings));
        Ok(())
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let ChunkMemory { rings, vertices, indices, .. } = &mut self.memory[slot.index()];
        resize("vertices", vertices, chunk.vertices().into())?;
        resize("indices", indices, chunk.indices().into())?;
        let out = MeshMut { vertices, indices };
        let bytes = out.bytes();
        timed(&mut self.timings.mesh, || self.executor.mesh(&self.work, chunk, rings, out, bytes));
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        slot: Slot,
        _chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(sink(&self.memory[slot.index()].rings))
    }

    fn read_mesh(
        &mut self,
        slot: Slot,
        _chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let ChunkMemory { vertices, indices, .. } = &self.memory[slot.index()];
        let mut flow = sink(MeshPiece::Vertices { first: 0, vertices });
        if flow.is_continue() && !indices.is_empty() {
            flow = sink(MeshPiece::Indices { first: 0, indices });
        }
        Ok(flow)
    }

    fn measure(&mut self, mut chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        let Self { work: Work { plan, points, lengths, .. }, timings, executor, .. } = self;
        resize("lengths along yarns", lengths, plan.block_count())?;
        timed(&mut timings.scan, || {
            batches(plan, chunks.yarns())
                .take_while(|_| chunks.watch().is_continue())
                .for_each(|yarns| executor.measure(plan, points, lengths, yarns));
        });
        Ok(())
    }

    fn attributes(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let attributes = &mut self.memory[slot.index()].attributes;
        resize("attributes", attributes, chunk.vertices().into())?;
        timed(&mut self.timings.mesh, || self.executor.attributes(&self.work, chunk, attributes));
        Ok(())
    }

    fn read_attributes(
        &mut self,
        slot: Slot,
        _chunk: &Chunk,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(sink(0, &self.memory[slot.index()].attributes))
    }

    fn packed(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let ChunkMemory { rings, packed, .. } = &mut self.memory[slot.index()];
        resize("packed vertices", packed, chunk.vertices().into())?;
        timed(&mut self.timings.mesh, || self.executor.packed(&self.work, chunk, rings, packed));
        Ok(())
    }

    fn read_packed(
        &mut self,
        slot: Slot,
        _chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(sink(0, &self.memory[slot.index()].packed))
    }

    fn mesh_into(&mut self, slot: Slot, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        let rings = &self.memory[slot.index()].rings;
        // The caller keeps the whole mesh in memory, so the size of the whole mesh says whether the
        // caches can hold it.
        let bytes = self.work.plan.counts().bytes().max(out.bytes());
        timed(&mut self.timings.mesh, || self.executor.mesh(&self.work, chunk, rings, out, bytes));
        Ok(())
    }

    fn lends_its_own(&self) -> bool {
        true
    }

    fn timings(&mut self) -> StageTimings {
        self.timings
    }
}
