//! The live mesh: a whole mesh that stays on its device while yarns are edited.

mod edits;

use std::collections::BTreeMap;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use crate::backend::{Chunk, PaddedPoints, Part, Plan, SessionError, Traffic};
use crate::engine::{AttributeSink, Engine, MeshSink, ScanChunk, ScanChunks, Slot, StageTimings};
use crate::plan::BLOCK_RINGS;
use crate::work_watch::WorkWatch;
use crate::{Backend, BackendError, Limits, OutOfMemory, Topology, Vertex};

/// The whole mesh of a fabric on a device. Yarns can be edited. After an edit only the changed
/// yarns are sent and scanned again, and only the changed parts of the mesh are made again.
///
/// A [`Session`](crate::backend::Session) works chunk by chunk in the memory of two chunks, while a
/// live mesh keeps the meshes of all chunks. With [room](Plan::with_room) in the plan, a yarn may
/// get more or fewer control points, and the meshes of all other yarns stay in place.
///
/// ```
/// use std::sync::Arc;
/// use texere_core::backend::{LiveMesh, NullBackend, Plan};
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # for y in 0..3 {
/// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.1)));
/// # }
/// # let yarns = yarns.build()?;
/// let device = NullBackend::default(); // any backend
/// let plan = Plan::with_room(yarns.layout().clone(), Settings::default(), |_| 16)?; // three yarns of three points
/// let mut live = LiveMesh::new(&device, Arc::new(plan))?;
/// live.upload(0, yarns.points())?;
/// live.update()?; // the whole mesh
///
/// // Yarn 1 is raised in its middle, and gets a fourth point.
/// let raised = [(0.0, 0.0), (0.8, 0.2), (1.2, 0.2), (2.0, 0.0)].map(|(x, z)| ControlPoint::new(x, 1.0, z, 0.1));
/// live.set_yarn(1, *live.plan().yarn(1), &raised)?;
/// let changes = live.update()?;
/// assert_eq!(live.plan().rings(1), 7);
/// assert_eq!(changes[0].vertices.len(), 7 * 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct LiveMesh<E: Engine + ?Sized = dyn Engine> {
    plan: Arc<Plan>,
    chunks: Vec<Chunk>,
    /// All control points. They are kept because whether a yarn is steep also depends on points
    /// beside those that are uploaded.
    points: PaddedPoints,
    /// The rings to be made again, yarn by yarn.
    stale: BTreeMap<usize, Range<u32>>,
    /// Whether attributes are made as well as the mesh.
    attributes: bool,
    traffic: Traffic,
    engine: Box<E>,
}

/// The vertices that a watched update makes between two calls of its watch, some 20 ms of a slow
/// core.
const WATCHED_VERTICES: usize = 700_000;

/// Part of a chunk that an update has made again. Vertices and indices are counted from the chunk's
/// start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The chunk's index in [`LiveMesh::chunks`].
    pub chunk: usize,
    /// The vertices that were made again, without those of caps, which follow after all others.
    pub vertices: Range<u32>,
    /// The indices that were made again, without those of caps. Empty unless the topology is
    /// [`Topology::Indexed`].
    pub indices: Range<u32>,
    /// The caps that were made again, as a range of indices into [`Chunk::caps`].
    pub caps: Range<usize>,
}

impl LiveMesh {
    /// Makes room for the whole mesh of `plan` on `device`, in chunks cut to the device's limits.
    ///
    /// **Errors**: [`SessionError::Backend`] if memory is short, the device fails, or the device or
    /// its schedule can't do the work, and the errors of [`LiveMesh::with_engine`].
    pub fn new(device: &dyn Backend, plan: Arc<Plan>) -> Result<Self, SessionError> {
        Self::with_engine(device.engine(plan.clone())?, &device.info().limits, plan)
    }
}

impl<E: Engine + ?Sized> LiveMesh<E> {
    /// Makes room for the whole mesh of `plan` with an engine that was opened for `plan`, on a
    /// device with `limits`. This is for backends whose engines can do more than the trait
    /// [`Engine`].
    ///
    /// **Errors**: [`SessionError::Region`] for a plan of a region, [`SessionError::Plan`] if not
    /// even one block fits, [`BackendError::OutOfMemory`] if all chunks together do not fit or the
    /// host's memory is short, and [`BackendError::NoEditing`] for an engine that is not
    /// [editable](Engine::is_editable).
    pub fn with_engine(engine: Box<E>, limits: &Limits, plan: Arc<Plan>) -> Result<Self, SessionError> {
        if !engine.is_editable() {
            return Err(BackendError::NoEditing.into());
        }
        if !plan.is_whole() {
            return Err(SessionError::Region);
        }
        let chunks: Vec<_> = plan.chunks(limits)?.collect();
        let bytes = |chunk: &Chunk| {
            u64::from(chunk.vertices()) * size_of::<Vertex>() as u64 + u64::from(chunk.indices()) * 4
        };
        let bytes = plan.resident_bytes() + chunks.iter().map(bytes).sum::<u64>();
        if bytes > limits.memory_bytes {
            return Err(BackendError::OutOfMemory(OutOfMemory { what: "the whole mesh", bytes }).into());
        }
        let all = (0..plan.layout().yarns().len()).map(|yarn| (yarn, 0..plan.rings(yarn)));
        Ok(Self {
            stale: all.collect(),
            points: PaddedPoints::new(&plan)?,
            plan,
            chunks,
            attributes: false,
            traffic: Traffic::default(),
            engine,
        })
    }

    /// The present plan.
    #[must_use]
    pub const fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// The present chunks. Each has its own memory on the device, in the [slot](Slot) of its index.
    #[must_use]
    pub fn chunks(&self) -> &[Chunk] {
        &self.chunks
    }

    /// The parts of chunks that hold the rings of a yarn, each with the chunk's index in
    /// [`LiveMesh::chunks`].
    ///
    /// **Panics** past the last yarn.
    pub fn parts(&self, yarn: usize) -> impl Iterator<Item = (usize, &Part)> {
        self.chunks_of(yarn).filter_map(move |number| {
            let parts = self.chunks[number].parts();
            let at = parts.binary_search_by_key(&yarn, |part| part.yarn as usize).ok()?;
            Some((number, &parts[at]))
        })
    }

    /// The engine that does the work.
    #[must_use]
    pub const fn engine(&self) -> &E {
        &self.engine
    }

    /// The bytes moved so far.
    #[must_use]
    pub const fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// The time spent in each stage so far. Waits for all work that has been launched.
    pub fn timings(&mut self) -> StageTimings {
        self.engine.timings()
    }

    /// Makes again everything that has changed, and returns the changes, chunk by chunk. The call
    /// may return before the device's work is done. Later reads and draws come after that work.
    ///
    /// **Errors**: [`SessionError::Backend`]. The next update then makes the same changes.
    pub fn update(&mut self) -> Result<Vec<Change>, SessionError> {
        let made = self.remake(usize::MAX, &mut || ControlFlow::Continue(()))?;
        Ok(match made {
            ControlFlow::Continue(changes) => changes,
            ControlFlow::Break(()) => Vec::new(),
        })
    }

    /// [`LiveMesh::update`], which ends early if `watch` answers `Break`, and returns that answer.
    /// The next update then makes the same changes. `watch` is called after each 700,000 vertices
    /// or so.
    ///
    /// **Errors**: the errors of [`LiveMesh::update`].
    pub fn update_watched(
        &mut self,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), Vec<Change>>, SessionError> {
        let sides = self.plan.settings().sides as usize;
        self.remake(WATCHED_VERTICES.div_ceil(BLOCK_RINGS as usize * sides), watch)
    }

    /// Makes again everything that has changed, `most` rows of a chunk's block table at a time.
    fn remake(
        &mut self,
        most: usize,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), Vec<Change>>, SessionError> {
        if self.plan.needs_scan() && self.go_through(E::scan, watch)?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        if self.attributes && self.go_through(E::measure, watch)?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let mut changes = Vec::new();
        for (number, rows) in self.stale_rows() {
            for rows in pieces(&rows, most) {
                let patch = self.plan.patch(&self.chunks[number], &rows);
                let slot = Slot::new(number as u32);
                self.engine.load(slot, &patch)?;
                if self.engine.mesh_reads_rings() {
                    self.engine.trajectory(slot, &patch)?;
                }
                self.engine.mesh(slot, &patch)?;
                if self.attributes {
                    self.engine.attributes(slot, &patch)?;
                }
                if watch().is_break() {
                    return Ok(ControlFlow::Break(()));
                }
            }
            changes.extend(rows.into_iter().map(|rows| self.change(number, rows)));
        }
        self.stale.clear();
        Ok(ControlFlow::Continue(changes))
    }

    /// Makes [attributes](crate::Attribute), too, from the next update on. That update makes
    /// everything again. From then on an edit changes the whole yarn, because the length along the
    /// yarn changes everywhere behind the edit.
    pub fn keep_attributes(&mut self) {
        if !self.attributes {
            self.attributes = true;
            (0..self.plan.layout().yarns().len()).for_each(|yarn| self.note(yarn, 0..self.plan.rings(yarn)));
        }
    }

    /// Whether attributes are made as well as the mesh.
    #[must_use]
    pub const fn keeps_attributes(&self) -> bool {
        self.attributes
    }

    /// Waits for the attributes of chunk number `chunk` of [`LiveMesh::chunks`] and lends them
    /// piece by piece, in the order of the mesh's vertices, as
    /// [`Session::read_attributes`](crate::backend::Session::read_attributes) does.
    ///
    /// **Errors**: [`SessionError::OutOfOrder`] before [`LiveMesh::keep_attributes`], and the
    /// errors of [`LiveMesh::read_mesh`].
    pub fn read_attributes(
        &mut self,
        chunk: usize,
        sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, SessionError> {
        if !self.attributes {
            return Err(SessionError::OutOfOrder { call: "read_attributes", needed: "keep_attributes" });
        }
        if !self.is_made("read_attributes", chunk)? {
            return Ok(ControlFlow::Continue(()));
        }
        let here = &self.chunks[chunk];
        let mut bytes = 0;
        let flow = self.engine.read_attributes(Slot::new(chunk as u32), here, &mut |first, piece| {
            bytes += size_of_val(piece) as u64;
            sink(first, piece)
        });
        self.count_read(bytes);
        Ok(flow?)
    }

    /// Waits for the mesh of chunk number `chunk` of [`LiveMesh::chunks`] and lends it piece by
    /// piece, as [`Session::read_mesh`](crate::backend::Session::read_mesh) does. Unused room is
    /// lent too, with contents that mean nothing. [`Chunk::parts`] has the places of yarns.
    ///
    /// **Errors**: [`SessionError::OutOfOrder`] before an update that is needed,
    /// [`SessionError::NoChunk`] past the last chunk, and [`SessionError::Backend`].
    pub fn read_mesh(&mut self, chunk: usize, sink: MeshSink<'_>) -> Result<ControlFlow<()>, SessionError> {
        if !self.is_made("read_mesh", chunk)? {
            return Ok(ControlFlow::Continue(()));
        }
        let here = &self.chunks[chunk];
        let mut bytes = 0;
        let flow = self.engine.read_mesh(Slot::new(chunk as u32), here, &mut |piece| {
            bytes += piece.bytes();
            sink(piece)
        });
        self.count_read(bytes);
        Ok(flow?)
    }

    /// Whether a chunk has anything for `call` to read. A chunk may consist of room only.
    fn is_made(&self, call: &'static str, chunk: usize) -> Result<bool, SessionError> {
        let here =
            self.chunks.get(chunk).ok_or(SessionError::NoChunk { chunk, chunks: self.chunks.len() })?;
        if !self.stale.is_empty() {
            return Err(SessionError::OutOfOrder { call, needed: "update" });
        }
        Ok(!here.parts().is_empty())
    }

    fn count_read(&mut self, bytes: u64) {
        if !self.engine.lends_its_own() {
            self.traffic.read += bytes;
        }
    }

    fn note(&mut self, yarn: usize, rings: Range<u32>) {
        let stale = self.stale.entry(yarn).or_insert(rings.clone());
        *stale = stale.start.min(rings.start)..stale.end.max(rings.end);
    }

    /// The chunks that hold part of `yarn` or of its room.
    fn chunks_of(&self, yarn: usize) -> Range<usize> {
        let blocks = &self.plan.block_offsets()[yarn..yarn + 2];
        let first = self.chunks.partition_point(|chunk| chunk.block_range().end <= blocks[0]);
        let end = self.chunks.partition_point(|chunk| chunk.block_range().start < blocks[1]);
        first..end
    }

    /// Calls `scan` for all yarns that have changed, once for each run of neighbours, until `watch`
    /// answers `Break`.
    fn go_through(
        &mut self,
        scan: impl Fn(&mut E, ScanChunks<'_>) -> Result<(), BackendError>,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<()>, SessionError> {
        let stale: Vec<_> = self.stale.keys().copied().collect();
        for yarns in runs(&stale) {
            let chunks = self.chunks_of(yarns.start).start..self.chunks_of(yarns.end - 1).end;
            let (plan, cut) = (&self.plan, &self.chunks);
            let mut patches = chunks.filter_map(|number| {
                let chunk = &cut[number];
                let all = 0..u32::MAX;
                let rows = chunk.rows(yarns.start, all.clone()).start..chunk.rows(yarns.end - 1, all).end;
                let chunk = (!rows.is_empty()).then(|| plan.patch(chunk, &[rows]))?;
                Some(ScanChunk { slot: Slot::new(number as u32), chunk, loaded: false })
            });
            scan(&mut self.engine, ScanChunks::new(&mut patches, yarns.clone(), watch))?;
            if watch().is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// The rows of each chunk to be made again.
    fn stale_rows(&self) -> BTreeMap<usize, Vec<Range<usize>>> {
        let mut stale = BTreeMap::<usize, Vec<Range<usize>>>::new();
        for (&yarn, rings) in &self.stale {
            for number in self.chunks_of(yarn) {
                let rows = self.chunks[number].rows(yarn, rings.clone());
                if rows.is_empty() {
                    continue;
                }
                let all = stale.entry(number).or_default();
                match all.last_mut() {
                    Some(last) if last.end == rows.start => last.end = rows.end,
                    _ => all.push(rows),
                }
            }
        }
        stale
    }

    fn change(&self, number: usize, rows: Range<usize>) -> Change {
        let (chunk, sides) = (&self.chunks[number], self.plan.settings().sides);
        let [first, last] = [&chunk.blocks()[rows.start], &chunk.blocks()[rows.end - 1]];
        let indexed = self.plan.settings().topology == Topology::Indexed;
        let indices = if indexed { last.quads * sides * 6 } else { 0 };
        let before = |yarn: u32| chunk.caps().partition_point(|cap| cap.yarn < yarn);
        Change {
            chunk: number,
            vertices: first.first_vertex..last.first_vertex + last.rings * sides,
            indices: first.first_index..last.first_index + indices,
            caps: before(first.yarn)..before(last.yarn + 1),
        }
    }
}

/// `rows`, ranges in order, cut after each `most` rows.
fn pieces(rows: &[Range<usize>], most: usize) -> Vec<Vec<Range<usize>>> {
    let (mut all, mut room) = (Vec::<Vec<Range<usize>>>::new(), 0);
    for rows in rows {
        let mut start = rows.start;
        while start < rows.end {
            if room == 0 {
                all.push(Vec::new());
                room = most;
            }
            let end = rows.end.min(start.saturating_add(room));
            all.last_mut().into_iter().for_each(|last| last.push(start..end));
            (room, start) = (room - (end - start), end);
        }
    }
    all
}

/// The runs of neighbouring numbers among `yarns`, which are in order.
fn runs(yarns: &[usize]) -> impl Iterator<Item = Range<usize>> {
    yarns.chunk_by(|one, next| one + 1 == *next).map(|run| run[0]..run[run.len() - 1] + 1)
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<LiveMesh>();
};
