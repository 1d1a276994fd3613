//! A backend that behaves like a GPU, and gives the gold reference's output.
//!
//! Launches only note what to do; the work is done when it is read. Chunks are as small as they get, results come in
//! small pieces from memory that held NaN before, and a third launch takes the memory of the first. What passes the
//! suite on this backend does not lean on the good nature of a CPU.

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::{
    Backend, BackendError, Chunk, ControlPoint, DeviceInfo, DeviceKind, Limits, MeshMut, MeshPiece, Plan,
    Ring, Session, StageTimings, Traffic, Vertex,
};
use texere_cpu::SerialBackend;

use crate::drive::{POISONED_INDEX, POISONED_RING, POISONED_VERTEX};

/// Bytes that a lent piece has at most.
const PIECE_BYTES: usize = 4096;

/// Chunks whose memory is held at once.
const IN_FLIGHT: usize = 2;

/// A block, and the row for the ring that a cut repeats.
const LIMITS: Limits = Limits { blocks: 2, ..Limits::NONE };

/// The serial backend behind a queue.
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
    /// Opens it.
    #[must_use]
    pub fn new() -> Self {
        let serial = SerialBackend::new();
        let info = DeviceInfo {
            name: "deferred".into(),
            schedule: "when read".into(),
            kind: DeviceKind::Other,
            limits: LIMITS,
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

    fn session(&self, plan: Arc<Plan>) -> Result<Box<dyn Session>, BackendError> {
        let serial = self.serial.session(plan.clone())?;
        Ok(Box::new(DeferredSession { plan, serial, scanned: false, in_flight: VecDeque::new() }))
    }
}

/// A chunk that was launched, and its memory.
#[derive(Debug)]
struct Launch {
    chunk: Chunk,
    meshed: bool,
    rings: Vec<Ring>,
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

#[derive(Debug)]
struct DeferredSession {
    plan: Arc<Plan>,
    serial: Box<dyn Session>,
    scanned: bool,
    /// The oldest first.
    in_flight: VecDeque<Launch>,
}

impl DeferredSession {
    fn launch(&mut self, call: &'static str, chunk: &Chunk) -> Result<&mut Launch, BackendError> {
        if self.plan.needs_scan() && !self.scanned {
            return Err(BackendError::OutOfOrder { call, needed: "scan" });
        }
        let launched = self.in_flight.iter().position(|launch| launch.chunk == *chunk);
        let at = launched.unwrap_or_else(|| {
            if self.in_flight.len() == IN_FLIGHT {
                self.in_flight.pop_front();
            }
            self.in_flight.push_back(Launch {
                chunk: chunk.clone(),
                meshed: false,
                rings: vec![POISONED_RING; chunk.rings as usize],
                vertices: vec![POISONED_VERTEX; chunk.vertices as usize],
                indices: vec![POISONED_INDEX; chunk.indices as usize],
            });
            self.in_flight.len() - 1
        });
        Ok(&mut self.in_flight[at])
    }

    /// The launch of `chunk`, and the session that is to do its work now.
    fn wait(&mut self, chunk: &Chunk) -> Result<(&mut Launch, &mut dyn Session), BackendError> {
        let not_in_flight = BackendError::NotInFlight { chunk: chunk.index };
        let launch = self.in_flight.iter_mut().find(|launch| launch.chunk == *chunk).ok_or(not_in_flight)?;
        Ok((launch, &mut *self.serial))
    }
}

impl Session for DeferredSession {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), BackendError> {
        self.scanned = false;
        self.in_flight.clear();
        self.serial.upload(first, points)
    }

    fn scan(&mut self) -> Result<(), BackendError> {
        self.scanned = true;
        self.serial.scan()
    }

    fn trajectory(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.launch("trajectory", chunk).map(|_| ())
    }

    fn mesh(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.launch("mesh", chunk)?.meshed = true;
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(&[Ring]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let (launch, serial) = self.wait(chunk)?;
        serial.trajectory(chunk)?;
        let mut at = 0;
        let _ = serial.read_trajectory(chunk, &mut |rings| {
            launch.rings[at..at + rings.len()].copy_from_slice(rings);
            at += rings.len();
            ControlFlow::Continue(())
        })?;
        Ok(lend(&launch.rings, |_, rings| sink(rings)))
    }

    fn read_mesh(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let (launch, serial) = self.wait(chunk)?;
        if !launch.meshed {
            return Err(BackendError::NotInFlight { chunk: chunk.index });
        }
        serial.mesh_into(chunk, MeshMut { vertices: &mut launch.vertices, indices: &mut launch.indices })?;
        let flow = lend(&launch.vertices, |first, vertices| sink(MeshPiece::Vertices { first, vertices }));
        if flow.is_break() {
            return Ok(flow);
        }
        Ok(lend(&launch.indices, |first, indices| sink(MeshPiece::Indices { first, indices })))
    }

    fn timings(&self) -> StageTimings {
        self.serial.timings()
    }

    fn traffic(&self) -> Traffic {
        self.serial.traffic()
    }
}

/// Lends `all` in pieces of [`PIECE_BYTES`], each with the number of its first.
fn lend<T>(all: &[T], mut sink: impl FnMut(u32, &[T]) -> ControlFlow<()>) -> ControlFlow<()> {
    let each = PIECE_BYTES / size_of::<T>();
    all.chunks(each).enumerate().try_for_each(|(number, piece)| sink((number * each) as u32, piece))
}
