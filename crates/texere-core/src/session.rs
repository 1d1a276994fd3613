//! A session: one fabric on one device. The session checks the order of calls and keeps two chunks
//! in flight.

mod error;

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::backend::{Chunk, MeshMut, Plan, TablesId};
use crate::definitions::Ring;
use crate::engine::{
    AttributeSink, Engine, MeshSink, PackedSink, RingSink, ScanChunk, ScanChunks, Slot, StageTimings,
};
use crate::settling::{Settler, SettlingYarn};
use crate::traffic::Traffic;
use crate::work_watch::WorkWatch;
use crate::{Backend, BackendError, ControlPoint, Limits, Vertex};

pub use self::error::SessionError;

/// The work on one fabric on one device: upload and scan, then the stages chunk by chunk.
///
/// Chunks come from [`Plan::chunks`] of the session's plan, cut to the device's limits or to
/// stricter ones. Two chunks may be in flight: the session keeps their tables and results. A stage
/// for a third chunk reuses the memory of the oldest. [`Pipeline`](crate::Pipeline) makes all these
/// calls. Without a pipeline they are:
///
/// ```
/// use std::{ops::ControlFlow, sync::Arc};
/// use texere_core::backend::{NullBackend, Plan, Session};
/// use texere_core::{Backend, ControlPoint, MeshPiece, Settings, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let device = NullBackend::default(); // any backend
/// let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default())?);
/// let mut session = Session::new(&device, plan.clone())?;
/// session.upload(0, yarns.points())?;
/// session.scan()?;
/// let mut triangles = 0;
/// for chunk in plan.chunks(&device.info().limits)? {
///     session.mesh(&chunk)?;
///     let _ = session.read_mesh(&chunk, &mut |piece| {
///         if let MeshPiece::Indices { indices, .. } = piece {
///             triangles += indices.len() / 3;
///         }
///         ControlFlow::Continue(())
///     })?;
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Session<E: Engine + ?Sized = dyn Engine> {
    plan: Arc<Plan>,
    /// The limits that the chunks of a scan are cut to.
    limits: Limits,
    scanned: bool,
    measured: bool,
    in_flight: [InFlight; 2],
    /// The slot for the next new chunk.
    next: Slot,
    traffic: Traffic,
    engine: Box<E>,
}

/// The contents of a slot.
#[derive(Debug, Default)]
struct InFlight {
    /// The identity of the tables in the slot. A chunk's index does not identify them, because
    /// chunks of different cuts have equal indices.
    tables: Option<TablesId>,
    has_rings: bool,
    has_mesh: bool,
    has_attributes: bool,
    has_packed: bool,
}

impl InFlight {
    fn forget_results(&mut self) {
        *self = Self { tables: self.tables.take(), ..Self::default() };
    }
}

impl Session {
    /// Starts a session for a plan on `device`.
    ///
    /// **Errors**: [`SessionError::Backend`] if memory is short, the device fails, or the device or
    /// its schedule can't do the work.
    pub fn new(device: &dyn Backend, plan: Arc<Plan>) -> Result<Self, SessionError> {
        Ok(Self::with_engine(device.engine(plan.clone())?, device.info().limits, plan))
    }
}

impl<E: Engine + ?Sized> Session<E> {
    /// Starts a session for `plan` with an engine that was opened for `plan`, on a device with
    /// `limits`. This is for backends whose engines can do more than the trait [`Engine`].
    #[must_use]
    pub fn with_engine(engine: Box<E>, limits: Limits, plan: Arc<Plan>) -> Self {
        Self {
            plan,
            limits,
            scanned: false,
            measured: false,
            in_flight: Default::default(),
            next: Slot::default(),
            traffic: Traffic::default(),
            engine,
        }
    }

    /// Cuts a scan's chunks to `limits` if they are stricter than the device's own. If the caller
    /// cuts chunks to the same limits, tables that are still in a slot after the scan are not sent
    /// again for the stages.
    #[must_use]
    pub fn with_limits(mut self, limits: &Limits) -> Self {
        self.limits = self.limits.min(limits);
        self
    }

    /// The plan of the session.
    #[must_use]
    pub const fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// The engine that does the work.
    #[must_use]
    pub const fn engine(&self) -> &E {
        &self.engine
    }

    /// Copies control points to the device. The first of `points` is number `first` of the fabric.
    /// Any range is allowed: a generator can send block by block, and an edit can send one yarn.
    /// Points that are never uploaded are zeros. The session does not check positions and sizes.
    /// Points of [`Yarns`](crate::Yarns) are valid, and [`check_points`](crate::check_points)
    /// checks any other points.
    ///
    /// **Errors**: [`SessionError::UploadRange`] past the last control point, and
    /// [`SessionError::Backend`].
    pub fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), SessionError> {
        let (end, total) = (first.saturating_add(points.len() as u64), self.plan.layout().point_count());
        if end > total {
            return Err(SessionError::UploadRange { first, end, points: total });
        }
        self.forget_points();
        self.traffic.uploaded += self.engine.upload(first, points)?;
        Ok(())
    }

    /// Copies all control points from a settler. If the settler works on the same device, the
    /// points never leave that device. The new points change neither which yarns are
    /// [steep](crate::Layout::is_steep) nor how outlines [lean](crate::Layout::ups). Both stay as
    /// planned.
    ///
    /// **Errors**: [`SessionError::OtherYarns`] for a settler whose yarns have other numbers of
    /// control points than the plan's, and [`SessionError::Backend`] of either device.
    pub fn take_settled(&mut self, settler: &mut dyn Settler) -> Result<(), SessionError> {
        let points = |strand: &SettlingYarn| u64::from(strand.points);
        let settled = settler.plan().strands().iter().map(points);
        if !settled.eq(self.plan.layout().offsets().windows(2).map(|pair| pair[1] - pair[0])) {
            return Err(SessionError::OtherYarns);
        }
        self.forget_points();
        let Traffic { uploaded, read } = self.engine.take_settled(settler)?;
        self.traffic.uploaded += uploaded;
        self.traffic.read += read;
        Ok(())
    }

    /// Works out the roll at each block's start, and the total turn of each closed yarn. The call
    /// is needed once after uploads. It does nothing if [`Plan::needs_scan`] is false, or if
    /// nothing was uploaded since the last scan.
    ///
    /// **Errors**: [`SessionError::Plan`] if not even one block fits the device's limits, and
    /// [`SessionError::Backend`].
    pub fn scan(&mut self) -> Result<(), SessionError> {
        self.scan_watched(&mut || ControlFlow::Continue(())).map(|_| ())
    }

    /// [`Session::scan`], which ends early if `watch` answers `Break`, and returns that answer.
    /// `watch` is called now and then.
    ///
    /// **Errors**: the errors of [`Session::scan`].
    pub fn scan_watched(&mut self, watch: WorkWatch<'_>) -> Result<ControlFlow<()>, SessionError> {
        if self.plan.needs_scan() && !self.scanned && self.go_through(E::scan, watch)?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        self.scanned = true;
        Ok(ControlFlow::Continue(()))
    }

    /// Works out the length of yarn before each block's start, which [`Session::attributes`] needs.
    /// The call is needed once after uploads. It does nothing if nothing was uploaded since the
    /// last call.
    ///
    /// **Errors**: [`BackendError::NoAttributes`], and the errors of [`Session::scan`].
    pub fn measure(&mut self) -> Result<(), SessionError> {
        self.measure_watched(&mut || ControlFlow::Continue(())).map(|_| ())
    }

    /// [`Session::measure`], which ends early if `watch` answers `Break`, and returns that answer.
    /// `watch` is called now and then.
    ///
    /// **Errors**: the errors of [`Session::measure`].
    pub fn measure_watched(&mut self, watch: WorkWatch<'_>) -> Result<ControlFlow<()>, SessionError> {
        if !self.measured && self.go_through(E::measure, watch)?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        self.measured = true;
        Ok(ControlFlow::Continue(()))
    }

    /// Calls `scan` with all chunks of the whole plan, each in a slot, until `watch` answers
    /// `Break`.
    fn go_through(
        &mut self,
        scan: impl FnOnce(&mut E, ScanChunks<'_>) -> Result<(), BackendError>,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<()>, SessionError> {
        let mut answer = ControlFlow::Continue(());
        let mut watch = || {
            if answer.is_continue() {
                answer = watch();
            }
            answer
        };
        // A yarn's roll at any place depends on all of the yarn before it, so a scan covers the
        // whole plan.
        let whole = self.plan.whole();
        let chunks = whole.chunks(&self.limits)?;
        // The slots' contents are put back only on success. After an error it is unknown which
        // tables are loaded.
        let mut in_flight = std::mem::take(&mut self.in_flight);
        let mut in_slots = chunks.map(|chunk| {
            let (slot, loaded) = claim(&mut in_flight, &mut self.next, &chunk);
            in_flight[slot.index()].tables = Some(chunk.tables().clone());
            ScanChunk { slot, chunk, loaded }
        });
        let yarns = 0..self.plan.layout().yarns().len();
        scan(&mut self.engine, ScanChunks::new(&mut in_slots, yarns, &mut watch))?;
        self.in_flight = in_flight;
        Ok(answer)
    }

    /// Stage 1: makes rings from control points. The call may return before the work is done.
    ///
    /// **Errors**: [`SessionError::OutOfOrder`] before a scan that is needed,
    /// [`SessionError::ForeignChunk`], and [`SessionError::Backend`].
    pub fn trajectory(&mut self, chunk: &Chunk) -> Result<(), SessionError> {
        let slot = self.start("trajectory", chunk)?;
        self.ensure_rings(slot, chunk)
    }

    /// Stage 2: makes vertices and indices. If the engine reads rings and stage 1 has not run for
    /// this chunk, stage 1 runs first. The call may return before the work is done.
    ///
    /// **Errors**: the errors of [`Session::trajectory`].
    pub fn mesh(&mut self, chunk: &Chunk) -> Result<(), SessionError> {
        let slot = self.start_mesh("mesh", chunk)?;
        self.in_flight[slot.index()].has_mesh = false;
        self.engine.mesh(slot, chunk)?;
        self.in_flight[slot.index()].has_mesh = true;
        Ok(())
    }

    /// Waits for this chunk's rings and lends them piece by piece, in order. If [`Session::mesh`]
    /// has made the mesh straight from control points, stage 1 runs first. If the sink answers
    /// `Break`, reading ends and the answer is returned.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`], and
    /// [`SessionError::Backend`].
    pub fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, SessionError> {
        let slot = self.find(chunk, |here| here.has_rings || here.has_mesh)?;
        self.ensure_rings(slot, chunk)?;
        let mut bytes = 0;
        let flow = self.engine.read_trajectory(slot, chunk, &mut |rings| {
            bytes += size_of_val(rings) as u64;
            sink(rings)
        });
        self.count_read(bytes);
        Ok(flow?)
    }

    /// Waits for this chunk's mesh and lends it piece by piece: all vertices in order, then all
    /// indices in order. The pieces lie in the engine's own or in mapped memory. If the sink
    /// answers `Break`, reading ends and the answer is returned.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`], and
    /// [`SessionError::Backend`].
    pub fn read_mesh(&mut self, chunk: &Chunk, sink: MeshSink<'_>) -> Result<ControlFlow<()>, SessionError> {
        let slot = self.find(chunk, |here| here.has_mesh)?;
        let mut bytes = 0;
        let flow = self.engine.read_mesh(slot, chunk, &mut |piece| {
            bytes += piece.bytes();
            sink(piece)
        });
        self.count_read(bytes);
        Ok(flow?)
    }

    /// Makes the [attributes](crate::Attribute) of each vertex of `chunk`, for shaders and
    /// textures, in memory of their own. The call may return before the work is done.
    ///
    /// ```
    /// # fn example(session: &mut texere_core::backend::Session, chunk: &texere_core::backend::Chunk) -> Result<(), texere_core::backend::SessionError> {
    /// use std::ops::ControlFlow;
    /// session.measure()?; // once after uploads
    /// session.attributes(chunk)?;
    /// let _ = session.read_attributes(chunk, &mut |first, piece| {
    ///     println!("vertex {first}: {} mm along yarn {}", piece[0].along, piece[0].yarn);
    ///     ControlFlow::Continue(())
    /// })?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`SessionError::OutOfOrder`] before [`Session::measure`],
    /// [`SessionError::ForeignChunk`], and [`SessionError::Backend`].
    pub fn attributes(&mut self, chunk: &Chunk) -> Result<(), SessionError> {
        self.check_own(chunk)?;
        if !self.measured {
            return Err(SessionError::OutOfOrder { call: "attributes", needed: "measure" });
        }
        let slot = self.seat(chunk)?;
        // The results of an earlier call are lost even if this call fails.
        self.in_flight[slot.index()].has_attributes = false;
        self.engine.attributes(slot, chunk)?;
        self.in_flight[slot.index()].has_attributes = true;
        Ok(())
    }

    /// Waits for this chunk's attributes and lends them piece by piece, in the order of its
    /// vertices. Each piece comes with the number of its first vertex. If the sink answers `Break`,
    /// reading ends and the answer is returned.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`], and
    /// [`SessionError::Backend`].
    pub fn read_attributes(
        &mut self,
        chunk: &Chunk,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, SessionError> {
        let slot = self.find(chunk, |here| here.has_attributes)?;
        let mut bytes = 0;
        let flow = self.engine.read_attributes(slot, chunk, &mut |first, piece| {
            bytes += size_of_val(piece) as u64;
            sink(first, piece)
        });
        self.count_read(bytes);
        Ok(flow?)
    }

    /// Stage 2 with packed vertices, 12 bytes each, in memory of their own. No mesh is needed.
    /// Packed vertices are in the order of the mesh's vertices, and no indices are made.
    /// [`Plan::shared_indices`] has the indices of [`Topology::Shared`](crate::Topology::Shared), a
    /// topology that needs little memory. The call may return before the work is done.
    ///
    /// ```
    /// # fn example(session: &mut texere_core::backend::Session, chunk: &texere_core::backend::Chunk) -> Result<(), texere_core::backend::SessionError> {
    /// use std::ops::ControlFlow;
    /// let (quantum, middle) = (session.plan().settings().quantum, [50.0, 50.0, 0.0]); // of a cloth of 100 by 100 mm
    /// session.packed(chunk)?;
    /// let _ = session.read_packed(chunk, &mut |first, piece| {
    ///     println!("vertex {first} lies at {:?}", piece[0].unpack(middle, quantum).position);
    ///     ControlFlow::Continue(())
    /// })?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`BackendError::NoPacking`], and the errors of [`Session::trajectory`].
    pub fn packed(&mut self, chunk: &Chunk) -> Result<(), SessionError> {
        let slot = self.start_mesh("packed", chunk)?;
        // The results of an earlier call are lost even if this call fails.
        self.in_flight[slot.index()].has_packed = false;
        self.engine.packed(slot, chunk)?;
        self.in_flight[slot.index()].has_packed = true;
        Ok(())
    }

    /// Waits for this chunk's packed vertices and lends them piece by piece, in order. Each piece
    /// comes with the number of its first vertex. If the sink answers `Break`, reading ends and the
    /// answer is returned.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`], and
    /// [`SessionError::Backend`].
    pub fn read_packed(
        &mut self,
        chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, SessionError> {
        let slot = self.find(chunk, |here| here.has_packed)?;
        let mut bytes = 0;
        let flow = self.engine.read_packed(slot, chunk, &mut |first, piece| {
            bytes += size_of_val(piece) as u64;
            sink(first, piece)
        });
        self.count_read(bytes);
        Ok(flow?)
    }

    /// Stage 2 with the results in the caller's slices, which must have exactly the planned
    /// lengths. The mesh is not in flight afterwards.
    ///
    /// **Errors**: [`SessionError::OutputLength`] for slices of another length, and the errors of
    /// [`Session::mesh`].
    pub fn mesh_into(&mut self, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), SessionError> {
        let lengths = [
            ("vertices", out.vertices.len() as u64, u64::from(chunk.vertices())),
            ("indices", out.indices.len() as u64, u64::from(chunk.indices())),
        ];
        for (what, given, planned) in lengths {
            if given != planned {
                return Err(SessionError::OutputLength { what, given, planned });
            }
        }
        let slot = self.start_mesh("mesh", chunk)?;
        self.in_flight[slot.index()].has_mesh = false;
        let bytes = size_of_val(out.vertices) + size_of_val(out.indices);
        self.engine.mesh_into(slot, chunk, out)?;
        self.count_read(bytes as u64);
        Ok(())
    }

    /// Sends the tables of `chunk` unless they are on the device, and returns their slot. No stage
    /// starts. This is for a backend that lends the tables to its caller's kernels.
    ///
    /// **Errors**: the errors of [`Session::trajectory`].
    pub fn slot_of_tables(&mut self, chunk: &Chunk) -> Result<Slot, SessionError> {
        self.start("slot_of_tables", chunk)
    }

    /// The slot of the mesh of `chunk`, for a backend that lends its memory.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], and [`SessionError::NotInFlight`] unless a
    /// [`Session::mesh`] of this chunk is in flight.
    pub fn slot_of_mesh(&self, chunk: &Chunk) -> Result<Slot, SessionError> {
        self.find(chunk, |here| here.has_mesh)
    }

    /// The slot of the attributes of `chunk`, for a backend that lends its memory.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], and [`SessionError::NotInFlight`] unless
    /// [`Session::attributes`] of this chunk are in flight.
    pub fn slot_of_attributes(&self, chunk: &Chunk) -> Result<Slot, SessionError> {
        self.find(chunk, |here| here.has_attributes)
    }

    /// The slot of the packed vertices of `chunk`, for a backend that lends its memory.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], and [`SessionError::NotInFlight`] unless
    /// vertices of [`Session::packed`] for this chunk are in flight.
    pub fn slot_of_packed(&self, chunk: &Chunk) -> Result<Slot, SessionError> {
        self.find(chunk, |here| here.has_packed)
    }

    /// The time spent in each stage so far. Waits for all work that has been launched.
    pub fn timings(&mut self) -> StageTimings {
        self.engine.timings()
    }

    /// The bytes moved between host and device so far.
    #[must_use]
    pub const fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// Forgets all earlier results, because they belong to the old points.
    fn forget_points(&mut self) {
        (self.scanned, self.measured) = (false, false);
        self.in_flight.iter_mut().for_each(InFlight::forget_results);
    }

    fn count_read(&mut self, bytes: u64) {
        if !self.engine.lends_its_own() {
            self.traffic.read += bytes;
        }
    }

    /// Checks that `chunk` belongs to this session's plan, so that its tables fit the plan's
    /// counts.
    fn check_own(&self, chunk: &Chunk) -> Result<(), SessionError> {
        if self.plan.owns(chunk) { Ok(()) } else { Err(SessionError::ForeignChunk { chunk: chunk.index() }) }
    }

    /// The slot of `chunk` for a stage, with its tables loaded.
    fn start(&mut self, call: &'static str, chunk: &Chunk) -> Result<Slot, SessionError> {
        // This is checked first, so that a refused chunk gets no slot.
        self.check_own(chunk)?;
        if self.plan.needs_scan() && !self.scanned {
            return Err(SessionError::OutOfOrder { call, needed: "scan" });
        }
        self.seat(chunk)
    }

    /// The slot of `chunk`, with its tables loaded.
    fn seat(&mut self, chunk: &Chunk) -> Result<Slot, SessionError> {
        let (slot, loaded) = claim(&mut self.in_flight, &mut self.next, chunk);
        if !loaded {
            self.engine.load(slot, chunk)?;
            self.in_flight[slot.index()].tables = Some(chunk.tables().clone());
        }
        Ok(slot)
    }

    /// The slot of `chunk` for stage 2, with the rings that stage 2 reads.
    fn start_mesh(&mut self, call: &'static str, chunk: &Chunk) -> Result<Slot, SessionError> {
        let slot = self.start(call, chunk)?;
        if self.engine.mesh_reads_rings() {
            self.ensure_rings(slot, chunk)?;
        }
        Ok(slot)
    }

    /// Runs stage 1 for the chunk in `slot` unless it has run.
    fn ensure_rings(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), SessionError> {
        if !self.in_flight[slot.index()].has_rings {
            self.engine.trajectory(slot, chunk)?;
            self.in_flight[slot.index()].has_rings = true;
        }
        Ok(())
    }

    fn find(&self, chunk: &Chunk, wanted: fn(&InFlight) -> bool) -> Result<Slot, SessionError> {
        self.check_own(chunk)?;
        slot_of(&self.in_flight, chunk)
            .filter(|slot| wanted(&self.in_flight[slot.index()]))
            .ok_or(SessionError::NotInFlight { chunk: chunk.index() })
    }
}

/// The slot that holds the tables of `chunk`, if there is one.
fn slot_of(in_flight: &[InFlight; 2], chunk: &Chunk) -> Option<Slot> {
    let holds = |slot: &Slot| in_flight[slot.index()].tables.as_ref() == Some(chunk.tables());
    Slot::BOTH.into_iter().find(holds)
}

/// The slot that holds the tables of `chunk`, and `true`. If there is none, this empties the slot
/// whose tables were loaded first, and returns that slot and `false`.
fn claim(in_flight: &mut [InFlight; 2], next: &mut Slot, chunk: &Chunk) -> (Slot, bool) {
    if let Some(slot) = slot_of(in_flight, chunk) {
        return (slot, true);
    }
    // An empty slot is used first. A chunk that could not be loaded leaves its slot empty.
    let is_empty = |slot: Slot| in_flight[slot.index()].tables.is_none();
    let slot = if is_empty(other(*next)) && !is_empty(*next) { other(*next) } else { *next };
    *next = other(slot);
    in_flight[slot.index()] = InFlight::default();
    (slot, false)
}

/// The other slot.
const fn other(slot: Slot) -> Slot {
    Slot::BOTH[1 - slot.index()]
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<Session>();
    // The sizes that a session counts as read.
    assert!(size_of::<Vertex>() == 24 && size_of::<Ring>() == 48);
};
