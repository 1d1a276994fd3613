//! The pipeline: plans the work and drives any backend.

mod error;

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::backend::{Chunk, MeshMut, PaddedPoints, Plan, Session, SessionError, Trajectory, zeroed};
use crate::definitions::Ring;
use crate::settling::Settler;
use crate::{
    Attribute, Backend, Bounds, Frame, Limits, Mesh, MeshPiece, PackedVertex, Quantum, Settings, Topology,
    Undersampled, Yarns,
};

pub use self::error::PipelineError;

/// Control points a call of upload: 16 MB, so that progress is reported and a cancellation noticed
/// in between.
const UPLOAD_POINTS: usize = 1 << 20;

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Rings whose mesh (or trajectory) has been handed over.
    pub rings: u64,
    /// Rings in all.
    pub total: u64,
}

type OnProgress<'a> = Box<dyn FnMut(Progress) -> ControlFlow<()> + Send + 'a>;

/// From yarns to a mesh on any backend.
///
/// ```
/// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_core::PipelineError> {
/// use texere_core::{Frame, Pipeline};
/// let mesh = Pipeline::new(yarns).subdivisions(3).sides(12).frame(Frame::RotationMinimizing).mesh(device)?;
/// # Ok(())
/// # }
/// ```
pub struct Pipeline<'a> {
    yarns: &'a Yarns,
    settings: Settings,
    /// Whether there are as many subdivisions as the twist of the yarns needs, since nobody chose
    /// others.
    follows_twist: bool,
    limits: Limits,
    within: Option<Bounds>,
    /// Rings handed over so far.
    done: u64,
    settler: Option<&'a mut dyn Settler>,
    progress: Option<OnProgress<'a>>,
}

impl std::fmt::Debug for Pipeline<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Pipeline")
            .field("settings", &self.settings)
            .field("limits", &self.limits)
            .finish_non_exhaustive()
    }
}

impl<'a> Pipeline<'a> {
    /// A pipeline for `yarns` with the paper's settings: K = 1, nc = 6, upright, indexed, no caps.
    /// Where that undersamples twist, K is as large as [`Settings::following`] says, and tubes of a
    /// polygon have as many sides as it has corners, unless these are chosen.
    #[must_use]
    pub fn new(yarns: &'a Yarns) -> Self {
        Self {
            yarns,
            settings: Settings::sided(yarns),
            follows_twist: true,
            limits: Limits::default(),
            within: None,
            done: 0,
            settler: None,
            progress: None,
        }
    }

    /// Takes all settings at once, also the subdivisions: those of [`Settings::of`] follow twist.
    #[must_use]
    pub fn settings(mut self, settings: Settings) -> Self {
        self.settings = settings;
        self.follows_twist = false;
        self
    }

    /// Points inserted between two control points (K), whatever twist needs:
    /// [`Pipeline::undersampled`] tells.
    #[must_use]
    pub fn subdivisions(mut self, subdivisions: u32) -> Self {
        self.settings.subdivisions = subdivisions;
        self.follows_twist = false;
        self
    }

    /// Sides of the tube (nc).
    #[must_use]
    pub fn sides(mut self, sides: u32) -> Self {
        self.settings.sides = sides;
        self
    }

    /// How sections are oriented.
    #[must_use]
    pub fn frame(mut self, frame: Frame) -> Self {
        self.settings.frame = frame;
        self
    }

    /// How triangles are encoded.
    #[must_use]
    pub fn topology(mut self, topology: Topology) -> Self {
        self.settings.topology = topology;
        self
    }

    /// Whether yarn ends are closed.
    #[must_use]
    pub fn caps(mut self, caps: bool) -> Self {
        self.settings.caps = caps;
        self
    }

    /// The grid that [packed](Pipeline::packed) positions lie on.
    #[must_use]
    pub fn quantum(mut self, quantum: Quantum) -> Self {
        self.settings.quantum = quantum;
        self
    }

    /// Cuts chunks to `limits` where the device's own are wider, instead of to [`Limits::default`]:
    /// bounds the memory of a [`Pipeline::stream`], and how far one step of progress goes.
    #[must_use]
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Makes only what lies in a box, such as [`Bounds::rectangle`]: whole blocks of rings, and of
    /// each the same bits as in the whole mesh. More in [`Plan::within`]. A
    /// [`Pipeline::trajectory`] is whole all the same.
    ///
    /// ```
    /// # use texere_core::backend::NullBackend;
    /// # use texere_core::{ControlPoint, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # for y in 0..100 {
    /// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.1)));
    /// # }
    /// # let (yarns, device) = (yarns.build()?, NullBackend::default());
    /// use texere_core::{Bounds, Pipeline};
    /// // A hundred yarns along x, a millimetre apart.
    /// let mesh = Pipeline::new(&yarns).within(Bounds::rectangle([0.0, 39.5], [1.0, 44.5])).mesh(&device)?;
    /// assert_eq!(mesh.chunks[0].parts().iter().map(|part| part.yarn).collect::<Vec<_>>(), [40, 41, 42, 43, 44]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn within(mut self, bounds: Bounds) -> Self {
        self.within = Some(bounds);
        self
    }

    /// Takes control points from where `settler` has left them instead of those of the yarns, whose
    /// layout stays: on the device that it works on they don't leave it. What lies
    /// [within](Pipeline::within) a box is still told by those of the yarns, and so is which yarns
    /// are [steep](crate::Layout::is_steep) and how outlines [lean](crate::Layout::ups): where
    /// yarns settle so far that they run up or down elsewhere, or where flattened ones do at all,
    /// make new [`Yarns`] of what has been [read back](crate::settling::settled).
    ///
    /// ```
    /// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), Box<dyn std::error::Error>> {
    /// use std::ops::ControlFlow;
    /// use texere_core::settling::{Settling, SettlingPlan, settle};
    /// use texere_core::Pipeline;
    /// let plan = std::sync::Arc::new(SettlingPlan::new(&Settling::new(yarns))?);
    /// let mut settler = device.settler(plan.clone())?;
    /// let rest = settle(&plan, &mut *settler, |_, _| ControlFlow::Continue(()))?;
    /// let mesh = Pipeline::new(yarns).settled(&mut *settler).mesh(device)?;
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn settled(mut self, settler: &'a mut dyn Settler) -> Self {
        self.settler = Some(settler);
        self
    }

    /// Calls `progress` while control points are uploaded, with no rings done, and after each
    /// chunk; the last call has all rings done. `Break` ends the run there with
    /// [`PipelineError::Cancelled`].
    #[must_use]
    pub fn progress(mut self, progress: impl FnMut(Progress) -> ControlFlow<()> + Send + 'a) -> Self {
        self.progress = Some(Box::new(progress));
        self
    }

    /// The yarns.
    #[must_use]
    pub const fn yarns(&self) -> &'a Yarns {
        self.yarns
    }

    /// The settings that the mesh is made with.
    #[must_use]
    pub fn chosen(&self) -> Settings {
        if self.follows_twist { self.settings.following(self.yarns) } else { self.settings }
    }

    /// What the mesh will not show of the twist of the yarns, if anything: a warning, written out.
    #[must_use]
    pub fn undersampled(&self) -> Option<Undersampled> {
        Undersampled::of(self.yarns, &self.chosen())
    }

    /// The plan for these settings.
    ///
    /// **Errors**: those of [`Plan::new`], and [`PipelineError::Backend`] where there is no memory
    /// to find what lies within a box.
    pub fn plan(&self) -> Result<Plan, PipelineError> {
        let plan = Plan::new(self.yarns.layout().clone(), self.chosen())?;
        let Some(bounds) = &self.within else { return Ok(plan) };
        let mut points = PaddedPoints::new(&plan)?;
        points.upload(&plan, 0, self.yarns.points());
        Ok(plan.within(&points, bounds))
    }

    /// The limits that chunks on `device` are cut to.
    #[must_use]
    pub fn limits_on(&self, device: &dyn Backend) -> Limits {
        self.limits.min(&device.info().limits)
    }

    /// The whole mesh, in host memory.
    ///
    /// **Errors**: [`PipelineError`] where the settings can't be planned for, memory does not
    /// suffice, the device fails, or progress asked to stop.
    pub fn mesh(mut self, device: &dyn Backend) -> Result<Mesh, PipelineError> {
        let (plan, mut session) = self.start(device)?;
        let chunks: Vec<_> = plan.chunks(&self.limits_on(device))?.collect();
        let total = |count: fn(&Chunk) -> u32| chunks.iter().map(|chunk| u64::from(count(chunk))).sum();
        let mut vertices = zeroed("vertices", total(|chunk| chunk.vertices()))?;
        let mut indices = zeroed("indices", total(|chunk| chunk.indices()))?;
        let (mut vertices_left, mut indices_left) = (&mut vertices[..], &mut indices[..]);
        for chunk in &chunks {
            let (chunk_vertices, others) = vertices_left.split_at_mut(chunk.vertices() as usize);
            let (chunk_indices, other_indices) = indices_left.split_at_mut(chunk.indices() as usize);
            (vertices_left, indices_left) = (others, other_indices);
            session.mesh_into(chunk, MeshMut { vertices: chunk_vertices, indices: chunk_indices })?;
            self.tell(&plan, chunk)?;
        }
        if plan.settings().topology == Topology::Shared {
            indices = plan.shared_indices();
        }
        Ok(Mesh { vertices, indices, chunks, plan, materials: self.yarns.materials().clone() })
    }

    /// The mesh piece by piece, each with the chunk that it belongs to, in bounded memory: the
    /// control points and two chunks at a time. Of each chunk come all vertices in order, then all
    /// indices in order; a piece of indices may end anywhere, also within a triangle. No triangle
    /// comes twice: what a chunk repeats of another are vertices. A sink that answers `Break` ends
    /// the run, and its answer comes back; by then at most one chunk more has been worked on.
    ///
    /// **Errors**: those of [`Pipeline::mesh`].
    pub fn stream<B>(
        mut self,
        device: &dyn Backend,
        mut sink: impl FnMut(&Chunk, MeshPiece<'_>) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B>, PipelineError> {
        let (plan, mut session) = self.start(device)?;
        let mut chunks = plan.chunks(&self.limits_on(device))?;
        let mut waiting = chunks.next();
        if let Some(chunk) = &waiting {
            session.mesh(chunk)?;
        }
        while let Some(chunk) = waiting {
            // The next chunk is worked on while this one is read.
            waiting = chunks.next();
            if let Some(next) = &waiting {
                session.mesh(next)?;
            }
            let mut answer = None;
            let _ = session.read_mesh(&chunk, &mut |piece| match sink(&chunk, piece) {
                ControlFlow::Continue(()) => ControlFlow::Continue(()),
                ControlFlow::Break(value) => {
                    answer = Some(value);
                    ControlFlow::Break(())
                }
            })?;
            if let Some(value) = answer {
                return Ok(ControlFlow::Break(value));
            }
            self.tell(&plan, &chunk)?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// What shaders and textures ask of each vertex, in host memory: in the order of
    /// [`Pipeline::mesh`]'s vertices with the same settings and limits.
    ///
    /// ```
    /// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_core::PipelineError> {
    /// use texere_core::Pipeline;
    /// let mesh = Pipeline::new(yarns).mesh(device)?;
    /// let attributes = Pipeline::new(yarns).attributes(device)?;
    /// for (vertex, attribute) in mesh.vertices.iter().zip(&attributes) {
    ///     println!("{:?} lies {} mm along yarn {}", vertex.position, attribute.along, attribute.yarn);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: those of [`Pipeline::mesh`], and
    /// [`BackendError::NoAttributes`](crate::BackendError::NoAttributes).
    pub fn attributes(self, device: &dyn Backend) -> Result<Vec<Attribute>, PipelineError> {
        self.of_vertices(device, "attributes", |session, chunk, out: &mut [Attribute]| {
            session.measure()?;
            session.attributes(chunk)?;
            session.read_attributes(chunk, &mut |first, piece| {
                out[first as usize..][..piece.len()].copy_from_slice(piece);
                ControlFlow::Continue(())
            })
        })
    }

    /// Packed vertices, 12 bytes each, in host memory: in the order of [`Pipeline::mesh`]'s
    /// vertices with the same settings and limits.
    ///
    /// ```
    /// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_core::PipelineError> {
    /// use texere_core::{Pipeline, Quantum};
    /// let quantum = Quantum::reaching(750.0); // a cloth of 1.5 by 1.5 m
    /// for vertex in Pipeline::new(yarns).quantum(quantum).packed(device)? {
    ///     println!("{:?}", vertex.unpack([750.0, 750.0, 0.0], quantum).position);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: those of [`Pipeline::mesh`], and
    /// [`BackendError::NoPacking`](crate::BackendError::NoPacking).
    pub fn packed(self, device: &dyn Backend) -> Result<Vec<PackedVertex>, PipelineError> {
        self.of_vertices(device, "packed vertices", |session, chunk, out: &mut [PackedVertex]| {
            session.packed(chunk)?;
            session.read_packed(chunk, &mut |first, piece| {
                out[first as usize..][..piece.len()].copy_from_slice(piece);
                ControlFlow::Continue(())
            })
        })
    }

    /// What `make` makes of all vertices, chunk by chunk, in host memory.
    fn of_vertices<T: bytemuck::Zeroable>(
        mut self,
        device: &dyn Backend,
        what: &'static str,
        make: impl Fn(&mut Session, &Chunk, &mut [T]) -> Result<ControlFlow<()>, SessionError>,
    ) -> Result<Vec<T>, PipelineError> {
        let (plan, mut session) = self.start(device)?;
        let chunks: Vec<_> = plan.chunks(&self.limits_on(device))?.collect();
        let mut all = zeroed(what, chunks.iter().map(|chunk| u64::from(chunk.vertices())).sum())?;
        for chunk in &chunks {
            let own = &mut all[chunk.first_vertex() as usize..][..chunk.vertices() as usize];
            let _ = make(&mut session, chunk, own)?;
            self.tell(&plan, chunk)?;
        }
        Ok(all)
    }

    /// The centrelines alone, in host memory.
    ///
    /// ```
    /// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_core::PipelineError> {
    /// let trajectory = texere_core::Pipeline::new(yarns).subdivisions(7).trajectory(device)?;
    /// let first_yarn = trajectory.yarn(0).unwrap_or_default();
    /// println!("{} rings, the first at {:?}", first_yarn.len(), first_yarn[0].centre);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: those of [`Pipeline::mesh`].
    pub fn trajectory(mut self, device: &dyn Backend) -> Result<Trajectory, PipelineError> {
        self.within = None;
        let (plan, mut session) = self.start(device)?;
        let mut rings: Vec<Ring> = zeroed("rings", plan.counts().rings)?;
        let mut done = 0;
        for chunk in plan.chunks(&self.limits_on(device))? {
            session.trajectory(&chunk)?;
            // A repeated ring is the first of the next chunk, which overwrites it.
            let mut at = done;
            let _ = session.read_trajectory(&chunk, &mut |piece| {
                rings[at..at + piece.len()].copy_from_slice(piece);
                at += piece.len();
                ControlFlow::Continue(())
            })?;
            done += chunk.rings() as usize - usize::from(chunk.repeats_ring());
            self.tell(&plan, &chunk)?;
        }
        Ok(Trajectory { rings, offsets: plan.ring_offsets().to_vec() })
    }

    /// Plans, opens a session, uploads and scans.
    fn start(&mut self, device: &dyn Backend) -> Result<(Arc<Plan>, Session), PipelineError> {
        let plan = Arc::new(self.plan()?);
        let mut session = Session::new(device, plan.clone())?.with_limits(&self.limits);
        let total = plan.counts().rings;
        if let Some(settler) = &mut self.settler {
            session.take_settled(&mut **settler)?;
            self.report(Progress { rings: 0, total })?;
        } else {
            let mut first = 0;
            for points in self.yarns.points().chunks(UPLOAD_POINTS) {
                session.upload(first, points)?;
                first += points.len() as u64;
                self.report(Progress { rings: 0, total })?;
            }
        }
        if plan.needs_scan() {
            session.scan()?;
        }
        Ok((plan, session))
    }

    /// Counts a chunk as handed over.
    fn tell(&mut self, plan: &Plan, chunk: &Chunk) -> Result<(), PipelineError> {
        self.done += u64::from(chunk.rings()) - u64::from(chunk.repeats_ring());
        self.report(Progress { rings: self.done, total: plan.counts().rings })
    }

    fn report(&mut self, progress: Progress) -> Result<(), PipelineError> {
        match self.progress.as_mut().map(|tell| tell(progress)) {
            Some(ControlFlow::Break(())) => Err(PipelineError::Cancelled),
            _ => Ok(()),
        }
    }
}
