//! A backend that behaves like a GPU, with the output of the gold reference.
//!
//! A launch only records the work. The work is done when its results are read. Chunks are as small
//! as possible. Results come in small pieces from memory that held NaN before, and a third chunk
//! uses the memory of the first. The backend thus shows whether the core or the suite relies on
//! results being there early, as they are on a CPU.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::{
    Chunk, Engine, MeshMut, MeshSink, Plan, RingSink, ScanChunks, Schedule, Slot, StageTimings,
};
use texere_core::definitions::Ring;
use texere_core::{
    Backend, BackendError, Capabilities, ControlPoint, DeviceInfo, DeviceKind, Limits, MeshPiece, Vertex,
};
use texere_cpu::SerialBackend;

use crate::poison::{POISONED_INDEX, POISONED_RING, POISONED_VERTEX};

/// The most bytes of a lent piece.
const PIECE_BYTES: usize = 4096;

/// The limits of a chunk: two rows of the block table. They have room for a block and the ring that
/// a cut repeats, or for two blocks.
const LIMITS: Limits = Limits { blocks: 2, ..Limits::NONE };

/// The serial backend, with its work deferred as in a queue.
///
/// ```
/// use texere_conformance::DeferredBackend;
/// use texere_core::Backend;
/// assert_eq!(DeferredBackend::new().info().limits.blocks, 2);
/// ```
#[derive(Debug)]
pub struct DeferredBackend {
    info: DeviceInfo,
    serial: SerialBackend,
}

impl DeferredBackend {
    /// Opens the backend.
    #[must_use]
    pub fn new() -> Self {
        let serial = SerialBackend::new();
        let info = DeviceInfo {
            name: "deferred".into(),
            schedule: Schedule::PerRing,
            kind: DeviceKind::Other,
            limits: LIMITS,
            can: Capabilities::default(),
            ..serial.info().clone()
        };
        Self { info, serial }
    }
}

impl Default for DeferredBackend {
    fn default() -> Self {
        Self::new()
    }
}

impl Backend for DeferredBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        let serial = self.serial.engine(plan)?;
        Ok(Box::new(DeferredEngine { serial, launches: Default::default() }))
    }
}

/// The memory of a slot's results.
#[derive(Debug, Default)]
struct Launch {
    rings: Vec<Ring>,
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

#[derive(Debug)]
struct DeferredEngine {
    serial: Box<dyn Engine>,
    launches: [Launch; 2],
}

impl Engine for DeferredEngine {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError> {
        self.serial.upload(first, points)
    }

    fn scan(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        self.serial.scan(chunks)
    }

    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.launches[slot.index()] = Launch::default();
        self.serial.load(slot, chunk)
    }

    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.launches[slot.index()].rings = vec![POISONED_RING; chunk.rings() as usize];
        Ok(())
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let launch = &mut self.launches[slot.index()];
        launch.vertices = vec![POISONED_VERTEX; chunk.vertices() as usize];
        launch.indices = vec![POISONED_INDEX; chunk.indices() as usize];
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { serial, launches } = self;
        let rings = &mut launches[slot.index()].rings;
        serial.trajectory(slot, chunk)?;
        let mut at = 0;
        let _ = serial.read_trajectory(slot, chunk, &mut |piece| {
            rings[at..at + piece.len()].copy_from_slice(piece);
            at += piece.len();
            ControlFlow::Continue(())
        })?;
        Ok(lend(rings, |_, rings| sink(rings)))
    }

    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let Self { serial, launches } = self;
        let Launch { vertices, indices, .. } = &mut launches[slot.index()];
        serial.trajectory(slot, chunk)?;
        serial.mesh_into(slot, chunk, MeshMut { vertices, indices })?;
        let flow = lend(vertices, |first, vertices| sink(MeshPiece::Vertices { first, vertices }));
        if flow.is_break() {
            return Ok(flow);
        }
        Ok(lend(indices, |first, indices| sink(MeshPiece::Indices { first, indices })))
    }

    fn lends_its_own(&self) -> bool {
        true
    }

    fn timings(&mut self) -> StageTimings {
        self.serial.timings()
    }
}

/// Lends `all` in pieces of [`PIECE_BYTES`], each with the number of its first element.
fn lend<T>(all: &[T], mut sink: impl FnMut(u32, &[T]) -> ControlFlow<()>) -> ControlFlow<()> {
    let each = PIECE_BYTES / size_of::<T>();
    all.chunks(each).enumerate().try_for_each(|(number, piece)| sink((number * each) as u32, piece))
}
