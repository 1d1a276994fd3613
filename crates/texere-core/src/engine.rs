//! The engine trait: what a device does for a session. The session checks every call, so an engine
//! gets only valid input.

use std::any::Any;
use std::fmt;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;
use std::time::Duration;

use crate::backend::{Chunk, MeshMut, Plan, Traffic};
use crate::definitions::Ring;
use crate::settling::{Settler, points_of};
use crate::work_watch::WorkWatch;
use crate::{Attribute, BackendError, ControlPoint, MeshPiece, PackedVertex};

/// One of an engine's places for a chunk. The chunk's tables, rings and mesh stay in the slot until
/// another chunk is loaded into it.
///
/// A [`Session`](crate::backend::Session) has two slots. A [`LiveMesh`](crate::backend::LiveMesh)
/// has one for each of its chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Slot(u32);

impl Slot {
    /// Both slots of a session.
    pub const BOTH: [Self; 2] = [Self(0), Self(1)];

    /// The slot with this number, counted from 0.
    #[must_use]
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// The slot's number: its index among an engine's slots.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// The time that a session has spent in each stage so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StageTimings {
    /// The transfer of control points to the device.
    pub upload: Duration,
    /// The scan of rolls.
    pub scan: Duration,
    /// The making of rings. In an engine that fuses both stages, this time is part of `mesh`.
    pub trajectory: Duration,
    /// The making of vertices and indices.
    pub mesh: Duration,
    /// The transfer of results to the host.
    pub readback: Duration,
}

/// A callback that borrows rings, piece by piece.
pub type RingSink<'a> = &'a mut dyn FnMut(&[Ring]) -> ControlFlow<()>;

/// A callback that borrows vertices and indices, piece by piece.
pub type MeshSink<'a> = &'a mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>;

/// A callback that borrows attributes, piece by piece. The number that it gets is that of the
/// piece's first vertex, counted from the chunk's start.
pub type AttributeSink<'a> = &'a mut dyn FnMut(u32, &[Attribute]) -> ControlFlow<()>;

/// A callback that borrows packed vertices, piece by piece. The number that it gets is that of the
/// piece's first vertex, counted from the chunk's start.
pub type PackedSink<'a> = &'a mut dyn FnMut(u32, &[PackedVertex]) -> ControlFlow<()>;

/// The work on one plan on one device. An engine owns all the memory that the work needs.
///
/// A [`Session`](crate::backend::Session) calls the engine and keeps these rules, so that no engine
/// has to check them:
///
/// - Control points come within the plan's range. Results of control points that were replaced are
///   not read afterwards.
/// - If the plan needs a scan, the scan comes after any number of uploads and before the next
///   stage. A session scans all yarns at once. A live mesh scans each run of neighbouring yarns
///   that have changed.
/// - Every chunk is one of the plan's own, or a patch of one. A patch is the chunk with only some
///   rows of its block table. Its results have the places that they have in the whole chunk. A
///   chunk is loaded into a slot before a stage runs for it there. While a chunk's results are
///   still needed, only patches of the chunk are loaded into its slot, and they must leave the
///   chunk's other results untouched.
/// - For an engine that [reads rings](Engine::mesh_reads_rings), `mesh` and `packed` come after
///   `trajectory` in the same slot.
/// - Only results that have been made are read, while their chunk still has its slot. Slices to
///   write into have the length that the chunk states.
///
/// A caller without a session has to keep these rules itself. An engine whose kernels check no
/// bounds must check the two rules that memory safety depends on: the chunk belongs to its plan
/// ([`Plan::owns`](crate::backend::Plan::owns)), and it is loaded in the slot. If a caller breaks
/// either rule, the engine returns [`BackendError::NotLoaded`].
///
/// Calls may return before their work is done, except those that read.
///
/// **Errors**: methods that can fail return a [`BackendError`]: one for a failure that could not be
/// foreseen, or one that says what the engine can't do.
pub trait Engine: Any + fmt::Debug + Send {
    /// Copies control points to the device. The first of them is number `first` of the fabric.
    /// Returns the bytes sent, virtual ends included.
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError>;

    /// Takes all control points from a settler. The settler's yarns have the same numbers of
    /// control points as the plan's. Returns the bytes that went through the host.
    ///
    /// The provided method calls [`take_over_host`]. An engine on the settler's own device
    /// overrides it, so that the points stay there.
    fn take_settled(&mut self, settler: &mut dyn Settler) -> Result<Traffic, BackendError> {
        take_over_host(self, settler)
    }

    /// Whether the engine supports [`LiveMesh`](crate::backend::LiveMesh): it has a slot for every
    /// chunk of a mesh, works on patches of chunks without touching the chunk's other results, and
    /// takes edited plans. Its backend says the same in [`Capabilities::edit`].
    ///
    /// The provided method answers false.
    ///
    /// [`Capabilities::edit`]: crate::Capabilities::edit
    fn is_editable(&self) -> bool {
        false
    }

    /// Takes a plan that was [edited](crate::backend::Plan::edited) from the engine's own. Only
    /// `yarns` differ, perhaps in their numbers of control points. If many yarns are edited, this
    /// method is called with the same plan once for each run of neighbouring `yarns`. The tables in
    /// all slots become invalid. The results stay.
    ///
    /// The provided method fails with [`BackendError::NoEditing`]. It suits engines that are not
    /// [editable](Engine::is_editable).
    fn replan(&mut self, plan: Arc<Plan>, yarns: Range<usize>) -> Result<(), BackendError> {
        let _ = (plan, yarns);
        Err(BackendError::NoEditing)
    }

    /// Works out the roll at each block's start, and the total turn of each closed yarn, for the
    /// yarns of [`ScanChunks::yarns`]. `chunks` holds all chunks of the plan, or chunks that
    /// together hold all blocks of those yarns. Each chunk has a slot, for an engine that needs the
    /// chunk's tables there.
    fn scan(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError>;

    /// Loads the tables of `chunk` into `slot`, in place of any other chunk's.
    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError>;

    /// Whether `mesh` and `packed` read the rings that `trajectory` has made. If not, they start
    /// from control points.
    fn mesh_reads_rings(&self) -> bool {
        false
    }

    /// Stage 1: makes rings from control points, in `slot`.
    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError>;

    /// Stage 2: makes vertices and indices, in `slot`.
    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError>;

    /// Waits for the rings in `slot` and lends them piece by piece, in order. If the sink answers
    /// `Break`, reading ends and the answer is returned.
    fn read_trajectory(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError>;

    /// Waits for the mesh in `slot` and lends it piece by piece, from the engine's own or from
    /// mapped memory: all vertices in order, then all indices in order. If the sink answers
    /// `Break`, reading ends and the answer is returned.
    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError>;

    /// Works out the length of yarn before each block's start, for the yarns of
    /// [`ScanChunks::yarns`]. Chunks come as in [`Engine::scan`].
    ///
    /// The provided method fails with [`BackendError::NoAttributes`], as do those of
    /// [`Engine::attributes`] and [`Engine::read_attributes`]. They suit engines that make no
    /// attributes.
    fn measure(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        let _ = chunks;
        Err(BackendError::NoAttributes)
    }

    /// Makes the attributes of all vertices of `chunk`, in memory of their own in `slot`. The
    /// chunk's yarns have been measured since the last upload.
    fn attributes(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let _ = (slot, chunk);
        Err(BackendError::NoAttributes)
    }

    /// Waits for the attributes in `slot` and lends them piece by piece, in order. If the sink
    /// answers `Break`, reading ends and the answer is returned.
    fn read_attributes(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let _ = (slot, chunk, sink);
        Err(BackendError::NoAttributes)
    }

    /// Makes the packed vertices of `chunk`, in memory of their own in `slot`. They need no mesh,
    /// and no indices are made.
    ///
    /// The provided method fails with [`BackendError::NoPacking`], as does that of
    /// [`Engine::read_packed`]. They suit engines that pack no vertices.
    fn packed(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        let _ = (slot, chunk);
        Err(BackendError::NoPacking)
    }

    /// Waits for the packed vertices in `slot` and lends them piece by piece, in order. If the sink
    /// answers `Break`, reading ends and the answer is returned.
    fn read_packed(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let _ = (slot, chunk, sink);
        Err(BackendError::NoPacking)
    }

    /// Stage 2, with the results in the caller's slices.
    ///
    /// The provided method calls `mesh`, then reads and copies. An engine that can write into the
    /// slices directly overrides it.
    fn mesh_into(&mut self, slot: Slot, chunk: &Chunk, mut out: MeshMut<'_>) -> Result<(), BackendError> {
        self.mesh(slot, chunk)?;
        let mut copy = |piece: MeshPiece<'_>| {
            out.take(piece);
            ControlFlow::Continue(())
        };
        self.read_mesh(slot, chunk, &mut copy).map(|_| ())
    }

    /// Whether results lie in the host's own memory, so that reading them moves no bytes.
    fn lends_its_own(&self) -> bool {
        false
    }

    /// The time spent in each stage so far. Waits for all work that has been launched.
    fn timings(&mut self) -> StageTimings;
}

/// [`Engine::take_settled`] for any settler: reads its control points and uploads them.
///
/// **Errors**: [`BackendError`] of either device, and [`BackendError::OutOfMemory`] if the host has
/// no room for the points.
pub fn take_over_host<E: Engine + ?Sized>(
    engine: &mut E,
    settler: &mut dyn Settler,
) -> Result<Traffic, BackendError> {
    let points = points_of(settler)?;
    let read = if engine.lends_its_own() { 0 } else { size_of_val(&points[..]) as u64 };
    Ok(Traffic { uploaded: engine.upload(0, &points)?, read })
}

/// A chunk of a scan, with the slot for its tables.
#[derive(Debug)]
pub struct ScanChunk {
    /// The slot for the chunk's tables.
    pub slot: Slot,
    /// The chunk.
    pub chunk: Chunk,
    /// Whether the tables are in the slot already. If not, the engine loads them, as in
    /// [`Engine::load`].
    pub loaded: bool,
}

/// The chunks of a scan, in order, each with its slot. An engine that uses a chunk has to load the
/// chunk's tables unless they are in the slot already. The chunks end early if the caller wants no
/// more of the scan.
pub struct ScanChunks<'a> {
    chunks: &'a mut dyn Iterator<Item = ScanChunk>,
    yarns: Range<usize>,
    watch: WorkWatch<'a>,
}

impl<'a> ScanChunks<'a> {
    pub(crate) fn new(
        chunks: &'a mut dyn Iterator<Item = ScanChunk>,
        yarns: Range<usize>,
        watch: WorkWatch<'a>,
    ) -> Self {
        Self { chunks, yarns, watch }
    }

    /// Asks whether to go on. An engine that does not take the chunks one by one asks a few times
    /// in each 50 ms. After `Break` it returns early, and its results are dropped.
    pub fn watch(&mut self) -> ControlFlow<()> {
        (self.watch)()
    }

    /// The yarns whose rolls ([`Engine::scan`]) or lengths ([`Engine::measure`]) the engine works
    /// out.
    #[must_use]
    pub const fn yarns(&self) -> Range<usize> {
        self.yarns.start..self.yarns.end
    }
}

impl Iterator for ScanChunks<'_> {
    type Item = ScanChunk;

    fn next(&mut self) -> Option<ScanChunk> {
        if self.watch().is_continue() { self.chunks.next() } else { None }
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
