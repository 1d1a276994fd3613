//! The engine trait: what a device does for a session. The session checks every call; an engine
//! gets only valid input.

use std::any::Any;
use std::fmt;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;
use std::time::Duration;

use crate::backend::{Chunk, MeshMut, Plan, Traffic};
use crate::definitions::Ring;
use crate::settling::{Settler, points_of};
use crate::{Attribute, BackendError, ControlPoint, MeshPiece, PackedVertex};

/// One of an engine's places for a chunk. The chunk's tables, rings and mesh lie there until
/// another chunk takes the slot.
///
/// A [`Session`](crate::backend::Session) has two, [`LiveMesh`](crate::backend::LiveMesh) one for
/// each of its chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Slot(u32);

impl Slot {
    /// The two of a session.
    pub const BOTH: [Self; 2] = [Self(0), Self(1)];

    /// The slot of a number, from 0.
    #[must_use]
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// Its number, the index into an engine's slots.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Time spent in each stage of a session, so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StageTimings {
    /// Control points to the device.
    pub upload: Duration,
    /// Rolls.
    pub scan: Duration,
    /// Rings; counted in `mesh` where the two stages are fused.
    pub trajectory: Duration,
    /// Vertices and indices.
    pub mesh: Duration,
    /// Results to the host.
    pub readback: Duration,
}

/// A callback that borrows rings, piece by piece.
pub type RingSink<'a> = &'a mut dyn FnMut(&[Ring]) -> ControlFlow<()>;

/// A callback that borrows vertices and indices, piece by piece.
pub type MeshSink<'a> = &'a mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>;

/// A callback that borrows attributes, piece by piece, each with the number of its first vertex,
/// from the chunk's start.
pub type AttributeSink<'a> = &'a mut dyn FnMut(u32, &[Attribute]) -> ControlFlow<()>;

/// A callback that borrows packed vertices, likewise.
pub type PackedSink<'a> = &'a mut dyn FnMut(u32, &[PackedVertex]) -> ControlFlow<()>;

/// The work on one plan on one device. It owns all memory that the work needs.
///
/// A [`Session`](crate::backend::Session) calls it, and keeps these rules, so that no engine has to
/// check them:
///
/// - Control points come within the plan's range. Results of the points before them are not read
///   any more.
/// - Where the plan needs a scan, one comes before any stage, and again after each upload.
/// - Every chunk is the plan's own, or a [patch](crate::backend::Plan::patch) of one. It is loaded
///   into a slot before a stage is run for it there. After a chunk come only patches of it where
///   its results are still wanted: they must stay where they are.
/// - `mesh` and `packed` of an engine that [reads rings](Engine::mesh_reads_rings) come after
///   `trajectory` in the same slot.
/// - What is read has been made, and nothing has taken its slot since. Slices to write into are as
///   long as the chunk says.
///
/// A caller without a session has to keep them. An engine whose kernels check no bounds checks the
/// two that memory safety depends on: the chunk is of its plan
/// ([`Plan::owns`](crate::backend::Plan::owns)), and is loaded in the slot. Otherwise it gives back
/// [`BackendError::NotLoaded`].
///
/// Every call may return before its work is done, except those that read.
///
/// All methods give back a [`BackendError`] for what could not be foreseen, and nothing else.
pub trait Engine: Any + fmt::Debug + Send {
    /// Takes control points, the first of which is number `first` of the fabric. Gives back the
    /// bytes sent, virtual ends included.
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError>;

    /// Takes all control points from where a settler has left them, whose yarns have as many as the
    /// plan's. Gives back the bytes that went over the host.
    ///
    /// Provided: [`take_over_host`]. An engine whose device the settler works on takes them where
    /// they lie.
    fn take_settled(&mut self, settler: &mut dyn Settler) -> Result<Traffic, BackendError> {
        take_over_host(self, settler)
    }

    /// Whether it has as many slots as it is asked for, makes
    /// [patches](crate::backend::Plan::patch) without touching what lies beside them, and takes
    /// edited plans: what [`LiveMesh`](crate::backend::LiveMesh) needs.
    fn is_editable(&self) -> bool {
        false
    }

    /// Takes a plan that was [edited](crate::backend::Plan::edited) from its own: `yarns` may be
    /// others, with other numbers of control points. It takes one plan several times where many
    /// yarns are edited, each time with other `yarns` that lie next to one another. What is loaded
    /// in slots is forgotten, what has been made stays.
    ///
    /// Provided: refused, by an engine that is not [editable](Engine::is_editable).
    fn replan(&mut self, plan: Arc<Plan>, yarns: Range<usize>) -> Result<(), BackendError> {
        let _ = (plan, yarns);
        Err(BackendError::NoEditing)
    }

    /// Works out the roll at each block's start, and the whole turn of each closed yarn, of the
    /// yarns that [`ScanChunks::yarns`] says. `chunks` are all of the plan or, between them, all
    /// blocks of those yarns, each in a slot, for an engine that needs their tables there.
    fn scan(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError>;

    /// Takes the tables of `chunk` into `slot`, in place of any other chunk's.
    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError>;

    /// Whether `mesh` and `packed` work from the rings that `trajectory` left rather than from
    /// control points.
    fn mesh_reads_rings(&self) -> bool {
        false
    }

    /// Stage 1, rings from control points, into `slot`.
    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError>;

    /// Stage 2, vertices and indices, into `slot`.
    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError>;

    /// Waits for the rings in `slot` and lends them piece by piece, in order. A sink that answers
    /// `Break` ends the reading, and the answer comes back.
    fn read_trajectory(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError>;

    /// Waits for the mesh in `slot` and lends it piece by piece from its own or from mapped memory:
    /// all vertices in order, then all indices in order. A sink that answers `Break` ends the
    /// reading, and the answer comes back.
    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError>;

    /// Works out how long each yarn is at each block's start, for those that [`ScanChunks::yarns`]
    /// says, as [`Engine::scan`] does rolls.
    ///
    /// Provided, as the two that follow: refused, by an engine that makes no attributes.
    fn measure(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        let _ = chunks;
        Err(BackendError::NoAttributes)
    }

    /// Attributes of all vertices of `chunk`, into `slot`, in memory of their own. Its yarns have
    /// been measured since the last upload.
    fn attributes(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let _ = (slot, chunk);
        Err(BackendError::NoAttributes)
    }

    /// Waits for the attributes in `slot` and lends them piece by piece, in order. A sink that
    /// answers `Break` ends the reading, and the answer comes back.
    fn read_attributes(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let _ = (slot, chunk, sink);
        Err(BackendError::NoAttributes)
    }

    /// Packed vertices of `chunk`, into `slot`, in memory of their own: no mesh is needed, and no
    /// indices are made.
    ///
    /// Provided, as the one that follows: refused, by an engine that packs nothing.
    fn packed(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let _ = (slot, chunk);
        Err(BackendError::NoPacking)
    }

    /// Waits for the packed vertices in `slot` and lends them piece by piece, in order. A sink that
    /// answers `Break` ends the reading, and the answer comes back.
    fn read_packed(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let _ = (slot, chunk, sink);
        Err(BackendError::NoPacking)
    }

    /// Stage 2 straight into the caller's slices.
    ///
    /// Provided: mesh, read, copy. An engine that can write there directly does.
    fn mesh_into(&mut self, slot: Slot, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        self.mesh(slot, chunk)?;
        let mut copy = |piece: MeshPiece<'_>| {
            match piece {
                MeshPiece::Vertices { first, vertices } => {
                    out.vertices[first as usize..][..vertices.len()].copy_from_slice(vertices);
                }
                MeshPiece::Indices { first, indices } => {
                    out.indices[first as usize..][..indices.len()].copy_from_slice(indices);
                }
            }
            ControlFlow::Continue(())
        };
        self.read_mesh(slot, chunk, &mut copy).map(|_| ())
    }

    /// Whether results lie in the host's own memory, so that to read them moves no byte.
    fn lends_its_own(&self) -> bool {
        false
    }

    /// Time spent in each stage so far. Waits for all that has been launched.
    fn timings(&mut self) -> StageTimings;
}

/// [`Engine::take_settled`] with any settler: reads the control points and uploads them.
///
/// **Errors**: [`BackendError`] of either device.
pub fn take_over_host<E: Engine + ?Sized>(
    engine: &mut E,
    settler: &mut dyn Settler,
) -> Result<Traffic, BackendError> {
    let points = points_of(settler)?;
    let read = if engine.lends_its_own() { 0 } else { size_of_val(&points[..]) as u64 };
    Ok(Traffic { uploaded: engine.upload(0, &points)?, read })
}

/// A chunk of a scan, in its slot.
#[derive(Debug)]
pub struct ScanChunk {
    /// Where its tables belong.
    pub slot: Slot,
    /// The chunk.
    pub chunk: Chunk,
    /// Whether its tables lie there already; else the engine is to load them, as [`Engine::load`]
    /// does.
    pub loaded: bool,
}

/// The chunks of a scan, in order, each with its slot. An engine that takes one has to load its
/// tables, unless they are there.
pub struct ScanChunks<'a> {
    chunks: &'a mut dyn Iterator<Item = ScanChunk>,
    yarns: Range<usize>,
}

impl<'a> ScanChunks<'a> {
    pub(crate) fn new(chunks: &'a mut dyn Iterator<Item = ScanChunk>, yarns: Range<usize>) -> Self {
        Self { chunks, yarns }
    }

    /// The yarns whose rolls are asked for.
    #[must_use]
    pub const fn yarns(&self) -> Range<usize> {
        self.yarns.start..self.yarns.end
    }
}

impl Iterator for ScanChunks<'_> {
    type Item = ScanChunk;

    fn next(&mut self) -> Option<ScanChunk> {
        self.chunks.next()
    }
}

impl fmt::Debug for ScanChunks<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScanChunks").finish_non_exhaustive()
    }
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn Engine>();
};
