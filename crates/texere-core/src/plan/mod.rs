//! The plan: all counts, offsets and byte sizes, worked out on the host before anything is
//! launched.

mod block;
mod bounds;
mod chunk;
mod chunk_tables;
mod counts;
mod cut;
mod edits;
mod error;
mod identity;
mod leans;
mod limits;
mod locate;
mod offsets;
mod region;
mod settings;

pub use block::{BLOCK_RINGS, Block};
pub use bounds::Bounds;
pub use chunk::{Cap, Chunk, Part};
pub use counts::Counts;
pub use cut::{Chunks, WINDOW_POINTS};
pub use error::PlanError;
pub use identity::TablesId;
pub use limits::Limits;
pub use locate::MeshPlace;
pub use offsets::{RINGS_MAX, YARN_RINGS_MAX};
pub use settings::{Settings, check_sides};

use identity::PlanId;
use offsets::Offsets;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::definitions::{Ring, Sample, Sampling, Turn};
use crate::section::triangulate;
use crate::{ControlPoint, Frame, Layout, SectionPoint, Topology, Yarn};

/// The counts and offsets of a fabric for one choice of settings.
///
/// ```
/// use texere_core::backend::Plan;
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
/// // Two intervals, one inserted point in each: 5 rings of 6 vertices, 4 gaps of 12 triangles.
/// assert_eq!((plan.counts().rings, plan.counts().vertices, plan.counts().triangles), (5, 30, 48));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Plan {
    id: PlanId,
    layout: Arc<Layout>,
    settings: Settings,
    sampling: Sampling,
    offsets: Arc<Offsets>,
    /// Ranges of the blocks that the plan makes, in order. They are all blocks, unless the plan is
    /// of a [region](Plan::within).
    runs: Arc<[Range<u64>]>,
    needs_scan: bool,
    /// The lean of each ring of the yarns that lean, by the yarns' numbers.
    leans: BTreeMap<usize, Arc<[Turn]>>,
    outlines: Vec<SectionPoint>,
    cap_triangles: Vec<Vec<[u32; 3]>>,
    counts: Counts,
}

impl Plan {
    /// The plan of `layout` with `settings`.
    ///
    /// **Errors**: [`PlanError`] for settings out of range, a polygon section whose corners differ
    /// in number from the sides, more than [`YARN_RINGS_MAX`] rings in a yarn, and more than
    /// [`RINGS_MAX`] in all.
    pub fn new(layout: Arc<Layout>, settings: Settings) -> Result<Self, PlanError> {
        Self::planned(layout, settings, None)
    }

    /// A plan with room for more control points. `room` gets a yarn's number and gives the most
    /// control points that the yarn may have. The offsets leave space for that many, so that
    /// [`Plan::edited`] changes the number of points but no offset.
    ///
    /// ```
    /// use texere_core::backend::Plan;
    /// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// # let yarns = yarns.build()?;
    /// let plan = Plan::with_room(yarns.layout().clone(), Settings::default(), |_| 10)?; // one yarn of three points
    /// let points = |count| (0..count).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect::<Vec<_>>();
    /// let longer = plan.edited(0, *plan.yarn(0), &points(7))?;
    /// assert_eq!((plan.rings(0), longer.rings(0)), (5, 13));
    /// assert_eq!(plan.padded_offsets(), longer.padded_offsets());
    /// assert!(plan.edited(0, *plan.yarn(0), &points(11)).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Errors**: the errors of [`Plan::new`], where rings count as if all room were used.
    pub fn with_room(
        layout: Arc<Layout>,
        settings: Settings,
        room: impl Fn(usize) -> u64,
    ) -> Result<Self, PlanError> {
        Self::planned(layout, settings, Some(&room))
    }

    fn planned(
        layout: Arc<Layout>,
        settings: Settings,
        room: Option<&dyn Fn(usize) -> u64>,
    ) -> Result<Self, PlanError> {
        let sampling = Sampling::new(&layout, settings.subdivisions)?;
        check_sides(settings.sides, layout.sections())?;
        let offsets = Arc::new(Offsets::new(&layout, &sampling, room)?);
        let outlines = layout.sections().iter().flat_map(|section| section.outline(settings.sides)).collect();
        let blocks = offsets.blocks.last().copied().unwrap_or(0);
        let mut plan = Self {
            id: PlanId::next(),
            runs: std::iter::once(0..blocks).collect(),
            needs_scan: false,
            leans: BTreeMap::new(),
            layout,
            settings,
            sampling,
            offsets,
            outlines,
            cap_triangles: Vec::new(),
            counts: Counts::default(),
        };
        plan.cap_triangles =
            (0..plan.layout.sections().len()).map(|section| triangulate(plan.outline(section))).collect();
        let leaning = plan.layout.all_leaning().par_iter();
        plan.leans = leaning.map(|(yarn, _)| (*yarn, plan.leans_of(*yarn))).collect();
        plan.counts = plan.count();
        plan.needs_scan = (0..plan.layout.yarns().len()).any(|yarn| plan.turns(yarn));
        Ok(plan)
    }

    /// This plan with triangles in another encoding. The new plan has chunks of its own.
    ///
    /// ```
    /// use texere_core::backend::Plan;
    /// use texere_core::{ControlPoint, Settings, Topology, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
    /// let bare = plan.with_topology(Topology::None);
    /// assert_eq!((plan.counts().indices, bare.counts().indices), (144, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_topology(&self, topology: Topology) -> Self {
        let mut plan = self.clone();
        plan.settings.topology = topology;
        plan.id = PlanId::next();
        plan.counts = plan.count();
        plan
    }

    /// Whether the tables of `chunk` fit this plan's offsets. They do if `chunk` was cut from this
    /// plan or a clone, or if this plan and the chunk's come from the same plan by
    /// [edits](Plan::edited) or by a [region](Plan::within).
    #[must_use]
    pub fn owns(&self, chunk: &Chunk) -> bool {
        chunk.plan() == self.id
    }

    /// Whether all offsets of this plan and of `other` are equal because both are clones, or come
    /// from the same plan by [edits](Plan::edited) or by a [region](Plan::within).
    #[must_use]
    pub fn shares_offsets(&self, other: &Self) -> bool {
        self.id == other.id
    }

    /// Whether the plan was made with room for more control points.
    pub(crate) fn is_roomy(&self) -> bool {
        self.offsets.roomy
    }

    /// The identity that the plan's chunks carry.
    pub(crate) const fn id(&self) -> PlanId {
        self.id
    }

    /// The layout: yarns and sections.
    #[must_use]
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// The settings of the mesh.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The sampling of the splines.
    #[must_use]
    pub const fn sampling(&self) -> &Sampling {
        &self.sampling
    }

    /// The counts of everything that the plan makes, before it is cut into chunks.
    #[must_use]
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    /// The start of each yarn's rings among all rings, and the number of all rings last (the
    /// paper's Ωp). There is one value more than there are yarns. Multiplied by the number of
    /// sides, these values are the paper's ΩM. [Room](Plan::with_room) counts as if it were used,
    /// in these and all other offsets.
    #[must_use]
    pub fn ring_offsets(&self) -> &[u64] {
        &self.offsets.rings
    }

    /// The start of each yarn's *padded* control points, and the number of all padded points last.
    /// There is one value more than there are yarns.
    ///
    /// A yarn of m control points is stored as `[virtual start, m points, virtual end]` if open and
    /// as `[P[m-1], m points, P[0], P[1], P[2]]` if closed. Interval j reads `padded[j..j + 4]`,
    /// without special cases at the ends. The last ring of a closed yarn falls in interval m, whose
    /// points are those of interval 0.
    #[must_use]
    pub fn padded_offsets(&self) -> &[u64] {
        &self.offsets.padded
    }

    /// The start of each yarn's blocks among all blocks, and the number of all blocks last. There
    /// is one value more than there are yarns.
    #[must_use]
    pub fn block_offsets(&self) -> &[u64] {
        &self.offsets.blocks
    }

    /// The range of the padded control points of `yarn` among all padded points, without unused
    /// room.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn padded_range(&self, yarn: usize) -> Range<u64> {
        let (first, points) = (self.offsets.padded[yarn], self.layout.offsets());
        first..first + points[yarn + 1] - points[yarn] + offsets::virtual_points(self.yarn(yarn).closed)
    }

    /// The number of blocks of all yarns.
    #[must_use]
    pub fn block_count(&self) -> u64 {
        self.offsets.blocks.last().copied().unwrap_or(0)
    }

    /// The number of rings of `yarn`.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn rings(&self, yarn: usize) -> u32 {
        let points = self.layout.offsets();
        self.sampling.rings(points[yarn + 1] - points[yarn], self.yarn(yarn).closed) as u32
    }

    /// The data of `yarn`: material, section, twist, origin, and whether it is closed.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn yarn(&self, yarn: usize) -> &Yarn {
        &self.layout.yarns()[yarn]
    }

    /// A yarn's twist ([`Yarn::twist`]) in turns per mm, the unit of
    /// [`Frame::step`](crate::Frame::step) and of the kernels.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn turns_per_mm(&self, yarn: usize) -> f32 {
        (f64::from(self.yarn(yarn).twist) / std::f64::consts::TAU) as f32
    }

    /// The frame of the sections of `yarn`. It is that of the settings, unless the yarn is
    /// [steep](Layout::is_steep).
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn frame(&self, yarn: usize) -> Frame {
        self.settings.frame.of(self.layout.is_steep(yarn))
    }

    /// Whether any roll of `yarn` may differ from zero, so that its rolls are scanned.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn turns(&self, yarn: usize) -> bool {
        self.leans.contains_key(&yarn) || !self.frame(yarn).is_level(self.yarn(yarn).twist)
    }

    /// The lean of each ring of `yarn`. `None` for a yarn without [up directions](Layout::ups), and
    /// past the last yarn.
    #[must_use]
    #[inline]
    pub fn leans(&self, yarn: usize) -> Option<&[Turn]> {
        self.leans.get(&yarn).map(|leans| &**leans)
    }

    /// Ring number `ring` of `yarn`, at `sample`, with the roll `scanned` from the scan. The yarn's
    /// lean is added.
    ///
    /// **Panics** past the last yarn, and past the last ring of a yarn that leans.
    #[must_use]
    #[inline]
    pub fn ring(&self, yarn: usize, ring: u32, sample: &Sample, scanned: Turn) -> Ring {
        let Some(leans) = self.leans(yarn) else { return Ring::new(sample, scanned) };
        let lean = leans[ring as usize];
        // An upright section leans with its outline. A section in a rotation minimising frame
        // starts with the lean of the first ring.
        let start = match self.frame(yarn) {
            Frame::Upright => lean,
            Frame::RotationMinimizing => leans[0],
        };
        Ring { lean, ..Ring::new(sample, scanned + start) }
    }

    /// The outlines of all sections, one after the other, `sides` points each.
    #[must_use]
    pub fn outlines(&self) -> &[SectionPoint] {
        &self.outlines
    }

    /// The outline of `section`: `sides` points.
    ///
    /// **Panics** past the last section.
    #[must_use]
    pub fn outline(&self, section: usize) -> &[SectionPoint] {
        let sides = self.settings.sides as usize;
        &self.outlines[section * sides..][..sides]
    }

    /// The triangles of an end cap of `section`, facing along the tangent, as numbers of corners.
    ///
    /// **Panics** past the last section.
    #[must_use]
    pub(crate) fn cap_triangles(&self, section: usize) -> &[[u32; 3]] {
        &self.cap_triangles[section]
    }

    /// Whether the rolls of any yarn have to be scanned. For an [edited](Plan::edited) plan, the
    /// yarns of the plans that it was edited from count, too.
    #[must_use]
    pub const fn needs_scan(&self) -> bool {
        self.needs_scan
    }

    /// The bytes of the padded control points, which stay for as long as a session lives.
    #[must_use]
    pub fn resident_bytes(&self) -> u64 {
        self.offsets.padded.last().copied().unwrap_or(0) * size_of::<ControlPoint>() as u64
    }

    /// The peak bytes of host memory that [`Pipeline::mesh`](crate::Pipeline::mesh) needs on a CPU:
    /// those of the mesh, the padded control points, the block table, leans, and the rolls if any
    /// yarn turns. The caller's yarns do not count.
    #[must_use]
    pub fn host_bytes(&self) -> u64 {
        let rings = self.offsets.rings.last().copied().unwrap_or(0);
        let rolls = if self.needs_scan() { rings * size_of::<Turn>() as u64 } else { 0 };
        let blocks = self.block_count() * size_of::<Block>() as u64;
        let leans = self.leans.values().map(|leans| size_of_val(&**leans) as u64).sum::<u64>();
        self.counts.bytes() + blocks + self.resident_bytes() + rolls + leans
    }

    /// The bytes of all rings.
    #[must_use]
    pub fn trajectory_bytes(&self) -> u64 {
        self.counts.rings * size_of::<Ring>() as u64
    }
}
