//! A plan that is run on a device, chunk by chunk.

use std::borrow::{Borrow, Cow};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::error::PipelineError;
use crate::backend::{Chunk, MeshMut, Plan, Session, SessionError, WorkWatch};
use crate::definitions::Ring;
use crate::settling::Settler;
use crate::{Attribute, Backend, ControlPoint, Limits, MeshPiece, PackedVertex, Topology, Yarns};

/// Control points per call of upload: 16 MB. Between two calls progress is reported and a
/// cancellation noticed.
const UPLOAD_POINTS: usize = 1 << 20;

/// The progress of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Rings whose mesh (or trajectory) has been delivered.
    pub rings: u64,
    /// Rings in all.
    pub total: u64,
}

pub(super) type OnProgress<'a> = Box<dyn FnMut(Progress) -> ControlFlow<()> + Send + 'a>;

/// The origin of control points.
pub(super) enum Points<'a> {
    Given(&'a [ControlPoint]),
    /// Points whose memory is freed while they are sent, unless something else holds them.
    Owned(Arc<Vec<ControlPoint>>),
    Settled(&'a mut dyn Settler),
}

impl<'a> Points<'a> {
    /// The points of `yarns`. The rest of owned yarns is dropped.
    pub(super) fn of(yarns: Cow<'a, Yarns>) -> Self {
        match yarns {
            Cow::Borrowed(yarns) => Self::Given(yarns.points()),
            Cow::Owned(yarns) => Self::Owned(yarns.into_points()),
        }
    }
}

/// A plan that is run on a device, chunk by chunk, with its results in the caller's memory. A
/// program that already has a plan and its chunks can use a run instead of a
/// [`Pipeline`](crate::Pipeline), which plans and cuts each time.
///
/// ```
/// use std::ops::ControlFlow;
/// use std::sync::Arc;
/// use texere_core::backend::{MeshMut, NullBackend, Plan, Run};
/// use texere_core::{ControlPoint, Limits, Settings, Vertex, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let (yarns, device) = (yarns.build()?, NullBackend::default());
/// let (plan, limits) = (Arc::new(Plan::new(yarns.layout().clone(), Settings::default())?), Limits::default());
/// let chunks: Vec<_> = plan.chunks(&limits)?.collect();
/// let [vertices, indices] = plan.mesh_lengths(&chunks).map(|length| length as usize);
/// let run = Run::start(&device, plan, yarns.points(), limits, |_| ControlFlow::Continue(()))?;
/// let (mut vertices, mut indices) = (vec![Vertex::default(); vertices], vec![0; indices]);
/// run.mesh_into(&chunks, MeshMut { vertices: &mut vertices, indices: &mut indices })?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Run<'a> {
    plan: Arc<Plan>,
    /// The limits to which chunks are cut.
    limits: Limits,
    session: Session,
    progress: OnProgress<'a>,
    /// Rings delivered so far.
    done: u64,
}

impl fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Run").field("done", &self.done).finish_non_exhaustive()
    }
}

impl<'a> Run<'a> {
    /// Starts a run: opens a session of `plan` on `device`, sends `points`, the control points of
    /// the plan's yarns, and works out rolls. `progress` is called as
    /// [`Pipeline::progress`](crate::Pipeline::progress) says.
    ///
    /// `limits` are those that the caller cuts chunks to. Where the device's own limits are
    /// stricter, the device's count. If chunks are cut to other limits, the results are equal, but
    /// tables that were sent for the scan of rolls are sent again.
    ///
    /// **Errors**: the errors of [`Pipeline::mesh`](crate::Pipeline::mesh).
    pub fn start(
        device: &dyn Backend,
        plan: Arc<Plan>,
        points: &[ControlPoint],
        limits: Limits,
        progress: impl FnMut(Progress) -> ControlFlow<()> + Send + 'a,
    ) -> Result<Self, PipelineError> {
        Self::of(device, plan, Points::Given(points), &limits, Box::new(progress))
    }

    pub(super) fn of(
        device: &dyn Backend,
        plan: Arc<Plan>,
        points: Points<'_>,
        limits: &Limits,
        progress: OnProgress<'a>,
    ) -> Result<Self, PipelineError> {
        let limits = limits.min(&device.info().limits);
        let session = Session::new(device, plan.clone())?.with_limits(&limits);
        let mut run = Self { plan, limits, session, progress, done: 0 };
        match points {
            Points::Settled(settler) => {
                run.session.take_settled(settler)?;
                run.report()?;
            }
            Points::Given(all) => {
                let mut first = 0;
                for points in all.chunks(UPLOAD_POINTS) {
                    run.session.upload(first, points)?;
                    first += points.len() as u64;
                    run.report()?;
                }
            }
            Points::Owned(mut points) => {
                // The last points are sent first, so that the memory behind the first ones can be
                // given back. The cuts are those of given points.
                let mut end = points.len();
                while end > 0 {
                    let first = (end - 1) / UPLOAD_POINTS * UPLOAD_POINTS;
                    run.session.upload(first as u64, &points[first..end])?;
                    if let Some(points) = Arc::get_mut(&mut points) {
                        points.truncate(first);
                        points.shrink_to_fit();
                    }
                    end = first;
                    run.report()?;
                }
            }
        }
        run.watched(Session::scan_watched)?;
        Ok(run)
    }

    /// The plan.
    #[must_use]
    pub const fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// The limits that the plan is cut to: those that were given, and those of the device.
    #[must_use]
    pub const fn limits(&self) -> Limits {
        self.limits
    }

    /// The session, for stages one by one.
    #[must_use]
    pub fn into_session(self) -> Session {
        self.session
    }

    /// Makes the mesh of `chunks`, which are all chunks of the plan in order. `out` has the lengths
    /// that [`Plan::mesh_lengths`] says. Indices are those of a [`Mesh`](crate::Mesh): chunk after
    /// chunk, or the shared pattern.
    ///
    /// **Errors**: [`SessionError::OutputLength`] for slices of another length, and the errors of
    /// [`Pipeline::mesh`](crate::Pipeline::mesh).
    pub fn mesh_into(mut self, chunks: &[Chunk], out: MeshMut<'_>) -> Result<(), PipelineError> {
        let [vertices, indices] = self.plan.mesh_lengths(chunks);
        for (what, given, planned) in
            [("vertices", out.vertices.len(), vertices), ("indices", out.indices.len(), indices)]
        {
            if given as u64 != planned {
                return Err(SessionError::OutputLength { what, given: given as u64, planned }.into());
            }
        }
        let (mut vertices_left, mut indices_left) = (out.vertices, out.indices);
        if self.plan.settings().topology == Topology::Shared {
            indices_left.iter_mut().zip(self.plan.shared()).for_each(|(place, index)| *place = index);
            indices_left = &mut [];
        }
        for chunk in chunks {
            let (vertices, others) = vertices_left.split_at_mut(chunk.vertices() as usize);
            let (indices, other_indices) = indices_left.split_at_mut(chunk.indices() as usize);
            (vertices_left, indices_left) = (others, other_indices);
            self.session.mesh_into(chunk, MeshMut { vertices, indices })?;
            self.advance(chunk)?;
        }
        Ok(())
    }

    /// Makes the mesh of `chunks` piece by piece, as [`Pipeline::stream`](crate::Pipeline::stream)
    /// does.
    ///
    /// **Errors**: the errors of [`Pipeline::mesh`](crate::Pipeline::mesh).
    pub fn stream<B>(
        mut self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        sink: impl FnMut(&Chunk, MeshPiece<'_>) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B>, PipelineError> {
        self.pieces(chunks, sink, Self::advance)
    }

    /// Makes the mesh of `chunks` piece by piece as [`Run::stream`] does, for a program that has to
    /// see all of it before it can use any of it, such as one that looks for its bounds. The rings
    /// don't count as delivered. The run can then make the mesh again.
    ///
    /// **Errors**: the errors of [`Pipeline::mesh`](crate::Pipeline::mesh).
    pub fn survey<B>(
        &mut self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        sink: impl FnMut(&Chunk, MeshPiece<'_>) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B>, PipelineError> {
        self.pieces(chunks, sink, |run, _| run.report())
    }

    /// Makes the mesh of `chunks` piece by piece, and calls `done` after each chunk.
    fn pieces<B>(
        &mut self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        mut sink: impl FnMut(&Chunk, MeshPiece<'_>) -> ControlFlow<B>,
        done: impl Fn(&mut Self, &Chunk) -> Result<(), PipelineError>,
    ) -> Result<ControlFlow<B>, PipelineError> {
        let mut chunks = chunks.into_iter();
        let mut waiting = chunks.next();
        if let Some(chunk) = &waiting {
            self.session.mesh(chunk.borrow())?;
        }
        while let Some(chunk) = waiting {
            // The device works on the next chunk while this one is read.
            waiting = chunks.next();
            if let Some(next) = &waiting {
                self.session.mesh(next.borrow())?;
            }
            let (chunk, mut answer) = (chunk.borrow(), None);
            let _ = self.session.read_mesh(chunk, &mut |piece| match sink(chunk, piece) {
                ControlFlow::Continue(()) => ControlFlow::Continue(()),
                ControlFlow::Break(value) => {
                    answer = Some(value);
                    ControlFlow::Break(())
                }
            })?;
            if let Some(value) = answer {
                return Ok(ControlFlow::Break(value));
            }
            done(self, chunk)?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Makes the attributes of the vertices of `chunks`. `sink` takes them piece by piece, each
    /// piece with the number of its first vertex among all.
    ///
    /// **Errors**: the errors of [`Pipeline::attributes`](crate::Pipeline::attributes).
    pub fn attributes(
        mut self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        mut sink: impl FnMut(u64, &[Attribute]),
    ) -> Result<(), PipelineError> {
        self.watched(Session::measure_watched)?;
        self.each(chunks, |session, chunk, _| {
            session.attributes(chunk)?;
            session.read_attributes(chunk, &mut |first, piece| {
                sink(chunk.first_vertex() + u64::from(first), piece);
                ControlFlow::Continue(())
            })
        })
    }

    /// Makes the packed vertices of `chunks`. `sink` takes them piece by piece, each with the
    /// number of its first vertex among all.
    ///
    /// **Errors**: the errors of [`Pipeline::packed`](crate::Pipeline::packed).
    pub fn packed(
        self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        mut sink: impl FnMut(u64, &[PackedVertex]),
    ) -> Result<(), PipelineError> {
        self.each(chunks, |session, chunk, _| {
            session.packed(chunk)?;
            session.read_packed(chunk, &mut |first, piece| {
                sink(chunk.first_vertex() + u64::from(first), piece);
                ControlFlow::Continue(())
            })
        })
    }

    /// Makes the rings of `chunks`. `sink` takes them piece by piece, each with the number of its
    /// first ring among all. A ring that two chunks share comes twice, with equal bits.
    ///
    /// **Errors**: the errors of [`Pipeline::mesh`](crate::Pipeline::mesh).
    pub fn trajectory(
        self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        mut sink: impl FnMut(u64, &[Ring]),
    ) -> Result<(), PipelineError> {
        self.each(chunks, |session, chunk, done| {
            session.trajectory(chunk)?;
            let mut first = done;
            session.read_trajectory(chunk, &mut |piece| {
                sink(first, piece);
                first += piece.len() as u64;
                ControlFlow::Continue(())
            })
        })
    }

    /// Calls `make` for each chunk, with the number of rings before it.
    fn each(
        mut self,
        chunks: impl IntoIterator<Item = impl Borrow<Chunk>>,
        mut make: impl FnMut(&mut Session, &Chunk, u64) -> Result<ControlFlow<()>, SessionError>,
    ) -> Result<(), PipelineError> {
        for chunk in chunks {
            let _ = make(&mut self.session, chunk.borrow(), self.done)?;
            self.advance(chunk.borrow())?;
        }
        Ok(())
    }

    /// Counts a chunk as delivered.
    fn advance(&mut self, chunk: &Chunk) -> Result<(), PipelineError> {
        self.done += u64::from(chunk.rings()) - u64::from(chunk.repeats_ring());
        self.report()
    }

    fn report(&mut self) -> Result<(), PipelineError> {
        self.watched(|_, watch| Ok(watch()))
    }

    /// Calls `work` with a watch that reports progress. Fails if the progress callback asks to
    /// stop.
    fn watched(
        &mut self,
        work: impl FnOnce(&mut Session, WorkWatch<'_>) -> Result<ControlFlow<()>, SessionError>,
    ) -> Result<(), PipelineError> {
        let now = Progress { rings: self.done, total: self.plan.counts().rings };
        match work(&mut self.session, &mut || (self.progress)(now))? {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(PipelineError::Cancelled),
        }
    }
}
