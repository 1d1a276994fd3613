//! The pipeline: it plans the work and drives any backend.

mod error;
mod run;

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::Arc;

use self::run::{OnProgress, Points};
use crate::backend::{Chunk, MeshMut, PaddedPoints, Plan, Trajectory, zeroed};
use crate::definitions::Ring;
use crate::settling::Settler;
use crate::{
    Attribute, Backend, Bounds, Frame, Limits, Mesh, MeshPiece, PackedVertex, Quantum, Settings, Topology,
    Undersampled, Yarns,
};

pub use self::error::PipelineError;
pub use self::run::{Progress, Run};

/// Makes a mesh of yarns on any backend.
///
/// ```
/// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_core::PipelineError> {
/// use texere_core::{Frame, Pipeline};
/// let mesh = Pipeline::new(yarns).subdivisions(3).sides(12).frame(Frame::RotationMinimizing).mesh(device)?;
/// # Ok(())
/// # }
/// ```
///
/// A pipeline borrows its yarns, or owns them. One that owns the only copy of its yarns frees their
/// control points while it sends them to the device, so that a large fabric is in memory once:
///
/// ```
/// # use texere_core::backend::NullBackend;
/// # use texere_core::{ControlPoint, Yarn, Yarns};
/// # fn example(yarns: Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_core::PipelineError> {
/// use std::ops::ControlFlow;
/// use texere_core::Pipeline;
/// let mut vertices = 0;
/// let _ = Pipeline::new(yarns).stream(device, |chunk, _| {
///     vertices += chunk.vertices();
///     ControlFlow::<()>::Continue(())
/// })?;
/// # Ok(())
/// # }
/// ```
pub struct Pipeline<'a> {
    yarns: Cow<'a, Yarns>,
    settings: Settings,
    /// Whether the number of subdivisions follows the twist of the yarns: true until the caller
    /// chooses a number.
    follows_twist: bool,
    limits: Limits,
    within: Option<Bounds>,
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
    /// A pipeline for `yarns` with the paper's settings: one point between two control points (K =
    /// 1), six sides (nc = 6), upright, indexed, no caps. If that undersamples twist, K is as large
    /// as [`Settings::following`] makes it. Tubes with a polygon section have as many sides as the
    /// polygon has corners. [`Pipeline::subdivisions`] and [`Pipeline::sides`] override both.
    #[must_use]
    pub fn new(yarns: impl Into<Cow<'a, Yarns>>) -> Self {
        let yarns = yarns.into();
        Self {
            settings: Settings::sided(&yarns),
            yarns,
            follows_twist: true,
            limits: Limits::default(),
            within: None,
            settler: None,
            progress: None,
        }
    }

    /// Sets all settings at once, subdivisions included. [`Settings::of`] gives settings that
    /// follow twist.
    #[must_use]
    pub fn settings(mut self, settings: Settings) -> Self {
        self.settings = settings;
        self.follows_twist = false;
        self
    }

    /// Sets the points inserted between two control points (K), whatever the twist needs.
    /// [`Pipeline::undersampled`] warns if there are too few.
    #[must_use]
    pub fn subdivisions(mut self, subdivisions: u32) -> Self {
        self.settings.subdivisions = subdivisions;
        self.follows_twist = false;
        self
    }

    /// Sets the sides of the tube (nc).
    #[must_use]
    pub fn sides(mut self, sides: u32) -> Self {
        self.settings.sides = sides;
        self
    }

    /// Sets the orientation of sections.
    #[must_use]
    pub fn frame(mut self, frame: Frame) -> Self {
        self.settings.frame = frame;
        self
    }

    /// Sets the encoding of triangles.
    #[must_use]
    pub fn topology(mut self, topology: Topology) -> Self {
        self.settings.topology = topology;
        self
    }

    /// Sets whether the ends of open yarns are closed with caps.
    #[must_use]
    pub fn caps(mut self, caps: bool) -> Self {
        self.settings.caps = caps;
        self
    }

    /// Sets the step of the grid that [packed](Pipeline::packed) positions lie on.
    #[must_use]
    pub fn quantum(mut self, quantum: Quantum) -> Self {
        self.settings.quantum = quantum;
        self
    }

    /// Cuts chunks to `limits` if they are stricter than the device's own. The default is
    /// [`Limits::default`]. Limits bound the memory of a [`Pipeline::stream`] and the size of one
    /// step of progress.
    #[must_use]
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Makes only the part of the mesh in a box, such as [`Bounds::rectangle`]: whole blocks of
    /// rings, with the same bits as in the whole mesh. See [`Plan::within`]. A
    /// [`Pipeline::trajectory`] is always whole.
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

    /// Takes the control points of `settler` instead of those of the yarns, whose layout stays. On
    /// the settler's own device they are not copied to the host. The yarns' own points still decide
    /// three things: which blocks lie [within](Pipeline::within) a box, which yarns are
    /// [steep](crate::Layout::is_steep), and how outlines [lean](crate::Layout::ups). If settling
    /// makes yarns run up or down in new places, or makes flattened yarns do so at all, build new
    /// [`Yarns`] from the points that are [read back](crate::settling::settled).
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

    /// Calls `progress` while control points are sent and rolls worked out, with 0 rings, and after
    /// each chunk. The last call has all rings. `Break` ends the run with
    /// [`PipelineError::Cancelled`].
    #[must_use]
    pub fn progress(mut self, progress: impl FnMut(Progress) -> ControlFlow<()> + Send + 'a) -> Self {
        self.progress = Some(Box::new(progress));
        self
    }

    /// The yarns.
    #[must_use]
    pub fn yarns(&self) -> &Yarns {
        &self.yarns
    }

    /// The settings of the mesh, with subdivisions that follow twist unless others were chosen.
    fn chosen(&self) -> Settings {
        if self.follows_twist { self.settings.following(&self.yarns) } else { self.settings }
    }

    /// The warning that the mesh undersamples the twist of the yarns, if it does.
    #[must_use]
    pub fn undersampled(&self) -> Option<Undersampled> {
        Undersampled::of(&self.yarns, &self.chosen())
    }

    /// The plan for these settings.
    ///
    /// **Errors**: [`PipelineError::Plan`] with the errors of [`Plan::new`], and
    /// [`PipelineError::Backend`] if memory is short while blocks within a box are found.
    pub fn plan(&self) -> Result<Plan, PipelineError> {
        let plan = Plan::new(self.yarns.layout().clone(), self.chosen())?;
        let Some(bounds) = &self.within else { return Ok(plan) };
        let mut points = PaddedPoints::new(&plan)?;
        points.upload(&plan, 0, self.yarns.points());
        Ok(plan.within(&points, bounds))
    }

    /// The whole mesh, in host memory.
    ///
    /// **Errors**: the errors of [`Pipeline::plan`]; [`PipelineError::Plan`] if not even one block
    /// fits the limits; [`PipelineError::Backend`] if memory is short, the device fails, or the
    /// device or its schedule can't do the work; [`PipelineError::Session`] for a settler of other
    /// yarns; and [`PipelineError::Cancelled`] if the progress callback asks to stop.
    pub fn mesh(self, device: &dyn Backend) -> Result<Mesh, PipelineError> {
        let materials = self.yarns.materials().clone();
        let (plan, chunks, run) = self.start(device)?;
        let [vertices, indices] = plan.mesh_lengths(&chunks);
        let (mut vertices, mut indices) = (zeroed("vertices", vertices)?, zeroed("indices", indices)?);
        run.mesh_into(&chunks, MeshMut { vertices: &mut vertices, indices: &mut indices })?;
        Ok(Mesh { vertices, indices, chunks, plan, materials })
    }

    /// The mesh piece by piece, each with its chunk, in bounded memory: the control points and two
    /// chunks at a time. Each chunk comes as all vertices in order, then all indices in order. A
    /// piece of indices may end anywhere, even within a triangle. No triangle comes twice. Only
    /// vertices are repeated, if a chunk ends inside a yarn. If the sink answers `Break`, the run
    /// ends and the answer is returned. At most one more chunk has been worked on by then.
    ///
    /// **Errors**: the errors of [`Pipeline::mesh`].
    pub fn stream<B>(
        self,
        device: &dyn Backend,
        sink: impl FnMut(&Chunk, MeshPiece<'_>) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B>, PipelineError> {
        let run = self.into_run(device)?;
        let (plan, limits) = (run.plan().clone(), run.limits());
        run.stream(plan.chunks(&limits)?, sink)
    }

    /// The attributes of each vertex, for shaders and textures, in host memory. They have the order
    /// of [`Pipeline::mesh`]'s vertices with the same settings and limits.
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
    /// **Errors**: the errors of [`Pipeline::mesh`], and
    /// [`BackendError::NoAttributes`](crate::BackendError::NoAttributes).
    pub fn attributes(self, device: &dyn Backend) -> Result<Vec<Attribute>, PipelineError> {
        let (plan, chunks, run) = self.start(device)?;
        let mut all = zeroed("attributes", plan.mesh_lengths(&chunks)[0])?;
        run.attributes(&chunks, copier(&mut all))?;
        Ok(all)
    }

    /// Packed vertices, 12 bytes each, in host memory. They have the order of [`Pipeline::mesh`]'s
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
    /// **Errors**: the errors of [`Pipeline::mesh`], and
    /// [`BackendError::NoPacking`](crate::BackendError::NoPacking).
    pub fn packed(self, device: &dyn Backend) -> Result<Vec<PackedVertex>, PipelineError> {
        let (plan, chunks, run) = self.start(device)?;
        let mut all = zeroed("packed vertices", plan.mesh_lengths(&chunks)[0])?;
        run.packed(&chunks, copier(&mut all))?;
        Ok(all)
    }

    /// The centrelines, without a mesh, in host memory.
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
    /// **Errors**: the errors of [`Pipeline::mesh`].
    pub fn trajectory(mut self, device: &dyn Backend) -> Result<Trajectory, PipelineError> {
        self.within = None;
        let run = self.into_run(device)?;
        let (plan, limits) = (run.plan().clone(), run.limits());
        let mut rings: Vec<Ring> = zeroed("rings", plan.counts().rings)?;
        run.trajectory(plan.chunks(&limits)?, copier(&mut rings))?;
        Ok(Trajectory { rings, offsets: plan.ring_offsets().to_vec() })
    }

    /// The run of the pipeline's plan on `device`: its control points are sent, and its rolls
    /// worked out.
    ///
    /// **Errors**: the errors of [`Pipeline::mesh`].
    pub fn into_run(self, device: &dyn Backend) -> Result<Run<'a>, PipelineError> {
        let plan = Arc::new(self.plan()?);
        let points = match self.settler {
            Some(settler) => Points::Settled(settler),
            None => Points::of(self.yarns),
        };
        let progress = self.progress.unwrap_or_else(|| Box::new(|_| ControlFlow::Continue(())));
        Run::of(device, plan, points, &self.limits, progress)
    }

    /// The plan, all its chunks for `device`, and its run.
    fn start(self, device: &dyn Backend) -> Result<(Arc<Plan>, Vec<Chunk>, Run<'a>), PipelineError> {
        let run = self.into_run(device)?;
        let plan = run.plan().clone();
        let chunks = plan.chunks(&run.limits())?.collect();
        Ok((plan, chunks, run))
    }
}

/// A sink that copies pieces to their places in `all`.
fn copier<T: Copy>(all: &mut [T]) -> impl FnMut(u64, &[T]) {
    move |first, piece| all[first as usize..][..piece.len()].copy_from_slice(piece)
}
