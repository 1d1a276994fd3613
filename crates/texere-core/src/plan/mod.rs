//! The plan: every count, offset and byte size, worked out on the host before anything is launched.

mod block;
mod chunk;
mod limits;

pub use block::{BLOCK_RINGS, Block};
pub use chunk::{Cap, Chunk, Chunks, Part, WINDOW_POINTS};
pub use limits::Limits;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::{
    Frame, Layout, PlanError, Ring, SIDES_MAX, SIDES_MIN, Sampling, Section, SectionPoint, Topology, Turn,
    Vertex, Yarn, triangulate,
};

/// The choices that a mesh is made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Tension of the spline, in \[0, 1).
    pub tension: f32,
    /// Points inserted between two control points (the paper's K).
    pub subdivisions: u32,
    /// Sides of the tube (the paper's nc).
    pub sides: u32,
    /// How sections are oriented.
    pub frame: Frame,
    /// How triangles are encoded.
    pub topology: Topology,
    /// Whether the ends of open yarns are closed with a cap, which makes every yarn watertight.
    pub caps: bool,
}

impl Default for Settings {
    /// The paper's: tension 0, K = 1, nc = 6, no caps.
    fn default() -> Self {
        Self {
            tension: 0.0,
            subdivisions: 1,
            sides: 6,
            frame: Frame::Upright,
            topology: Topology::Indexed,
            caps: false,
        }
    }
}

/// The most rings that one plan may have, 2³⁶. More would be over ten terabytes of mesh with six sides: a mistake in the
/// input.
pub const RINGS_MAX: u64 = 1 << 36;

/// The most rings that one yarn may have: what a `u32` counts.
pub const YARN_RINGS_MAX: u64 = u32::MAX as u64;

/// How many of everything a plan makes, uncut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Yarns.
    pub yarns: u64,
    /// Control points.
    pub control_points: u64,
    /// Rings of all yarns.
    pub rings: u64,
    /// Vertices, caps included.
    pub vertices: u64,
    /// Triangles that get drawn, caps included.
    pub triangles: u64,
    /// Indices that are stored; with [`Topology::Shared`] far fewer than three a triangle.
    pub indices: u64,
}

impl Counts {
    /// Bytes of the mesh: 24 a vertex, 4 an index.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.vertices * size_of::<Vertex>() as u64 + self.indices * 4
    }
}

/// A fabric's counts and offsets for one choice of settings.
///
/// ```
/// use texere_core::{ControlPoint, Plan, Settings, Yarn, Yarns};
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
    offsets: Offsets,
    outlines: Vec<SectionPoint>,
    cap_triangles: Vec<Vec<[u32; 3]>>,
    counts: Counts,
}

impl Plan {
    /// Plans `layout` with `settings`.
    ///
    /// **Errors**: [`PlanError`] for settings out of range, a polygon section whose corners are not as many as the
    /// sides, more than [`YARN_RINGS_MAX`] rings in a yarn or [`RINGS_MAX`] in all.
    pub fn new(layout: Arc<Layout>, settings: Settings) -> Result<Self, PlanError> {
        let sampling = Sampling::new(settings.tension, settings.subdivisions)?;
        if !(SIDES_MIN..=SIDES_MAX).contains(&settings.sides) {
            return Err(PlanError::Sides { sides: settings.sides, low: SIDES_MIN, high: SIDES_MAX });
        }
        for (section, shape) in layout.sections().iter().enumerate() {
            match shape {
                Section::Polygon(corners) if corners.len() != settings.sides as usize => {
                    let (corners, sides) = (corners.len(), settings.sides);
                    return Err(PlanError::PolygonSides { section, corners, sides });
                }
                _ => {}
            }
        }
        let offsets = Offsets::new(&layout, &sampling)?;
        let outlines = layout.sections().iter().flat_map(|section| section.outline(settings.sides)).collect();
        let mut plan = Self {
            id: PlanId::next(),
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
        plan.counts = plan.count();
        Ok(plan)
    }

    fn count(&self) -> Counts {
        let (yarns, sides) = (self.layout.yarns(), u64::from(self.settings.sides));
        let rings = self.offsets.rings.last().copied().unwrap_or(0);
        let gaps = rings - yarns.len() as u64;
        let open = yarns.iter().filter(|yarn| !yarn.closed).count() as u64;
        let caps = if self.settings.caps { 2 * open } else { 0 };
        let triangles = 2 * sides * gaps + caps * (sides - 2);
        Counts {
            yarns: yarns.len() as u64,
            control_points: self.layout.point_count(),
            rings,
            vertices: sides * (rings + caps),
            triangles,
            indices: match self.settings.topology {
                Topology::Indexed => 3 * triangles,
                Topology::Shared => self.shared_index_count(),
                Topology::None => 0,
            },
        }
    }

    /// Whether `chunk` was cut from this plan, or a clone of it, so that its tables fit the plan's counts.
    #[must_use]
    pub fn owns(&self, chunk: &Chunk) -> bool {
        chunk.plan() == self.id
    }

    /// The identity that its chunks carry.
    pub(crate) const fn id(&self) -> PlanId {
        self.id
    }

    /// Yarns and sections.
    #[must_use]
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// The settings.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// How the spline is sampled.
    #[must_use]
    pub const fn sampling(&self) -> &Sampling {
        &self.sampling
    }

    /// How many of everything there are, uncut.
    #[must_use]
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Where each yarn's rings start among all, and their total last (the paper's Ωp): yarns + 1 values. Times sides,
    /// these are the paper's ΩM.
    #[must_use]
    pub fn ring_offsets(&self) -> &[u64] {
        &self.offsets.rings
    }

    /// Where each yarn's *padded* control points start, and their total last: yarns + 1 values.
    ///
    /// A yarn of m control points is stored as `[virtual start, m points, virtual end]` when open and as
    /// `[P[m-1], m points, P[0], P[1], P[2]]` when closed. Interval j reads `padded[j..j + 4]`, without end cases; the
    /// last ring of a closed yarn falls in interval m, whose points are those of interval 0.
    #[must_use]
    pub fn padded_offsets(&self) -> &[u64] {
        &self.offsets.padded
    }

    /// Where each yarn's blocks start among all, and their total last: yarns + 1 values.
    #[must_use]
    pub fn block_offsets(&self) -> &[u64] {
        &self.offsets.blocks
    }

    /// Blocks of all yarns.
    #[must_use]
    pub fn block_count(&self) -> u64 {
        self.offsets.blocks.last().copied().unwrap_or(0)
    }

    /// Rings of `yarn`.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn rings(&self, yarn: usize) -> u32 {
        (self.offsets.rings[yarn + 1] - self.offsets.rings[yarn]) as u32
    }

    /// Material, section, twist and origin of `yarn`.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn yarn(&self, yarn: usize) -> &Yarn {
        &self.layout.yarns()[yarn]
    }

    /// A yarn's twist in turns per mm, as the kernels take it.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn twist_turns(&self, yarn: usize) -> f32 {
        (f64::from(self.yarn(yarn).twist) / std::f64::consts::TAU) as f32
    }

    /// All outlines, section after section, `sides` points each.
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

    /// The triangles of an end cap of `section`, facing along the tangent.
    ///
    /// **Panics** past the last section.
    #[must_use]
    pub fn cap_triangles(&self, section: usize) -> &[[u32; 3]] {
        &self.cap_triangles[section]
    }

    /// Whether any yarn needs its rolls scanned.
    #[must_use]
    pub fn needs_scan(&self) -> bool {
        self.layout.yarns().iter().any(|yarn| !self.settings.frame.is_level(yarn.twist))
    }

    /// Bytes that the padded control points take, for as long as a session lives.
    #[must_use]
    pub fn resident_bytes(&self) -> u64 {
        self.offsets.padded.last().copied().unwrap_or(0) * size_of::<crate::ControlPoint>() as u64
    }

    /// Bytes of host memory that [`Pipeline::mesh`](crate::Pipeline::mesh) takes on a CPU at its peak: the mesh, the padded
    /// control points, the block table and, where any yarn turns, the rolls. The yarns, which the caller has, are not in it.
    #[must_use]
    pub fn host_bytes(&self) -> u64 {
        let rolls = if self.needs_scan() { self.counts.rings * size_of::<Turn>() as u64 } else { 0 };
        let blocks = self.block_count() * size_of::<Block>() as u64;
        self.counts.bytes() + blocks + self.resident_bytes() + rolls
    }

    /// Bytes of all rings.
    #[must_use]
    pub fn trajectory_bytes(&self) -> u64 {
        self.counts.rings * size_of::<Ring>() as u64
    }
}

/// Identifies a plan within the process. A plan never changes, so its clones have the same identity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlanId(u64);

impl PlanId {
    fn next() -> Self {
        static PLANS: AtomicU64 = AtomicU64::new(0);
        Self(PLANS.fetch_add(1, Ordering::Relaxed))
    }
}

/// Prefix sums over the yarns: yarns + 1 values each.
#[derive(Debug, Clone)]
struct Offsets {
    padded: Vec<u64>,
    rings: Vec<u64>,
    blocks: Vec<u64>,
}

impl Offsets {
    fn new(layout: &Layout, sampling: &Sampling) -> Result<Self, PlanError> {
        let mut offsets = Self { padded: vec![0], rings: vec![0], blocks: vec![0] };
        let (mut padded, mut rings, mut blocks) = (0, 0, 0);
        for (index, (yarn, bounds)) in layout.yarns().iter().zip(layout.offsets().windows(2)).enumerate() {
            let points = bounds[1] - bounds[0];
            // 2^32 points of 2^10 rings fit a u64; more points are too many whatever their rings.
            let own = if points > YARN_RINGS_MAX { points } else { sampling.rings(points, yarn.closed) };
            if own > YARN_RINGS_MAX {
                return Err(PlanError::YarnRings { yarn: index, rings: own, limit: YARN_RINGS_MAX });
            }
            padded += points + if yarn.closed { 4 } else { 2 };
            rings += own;
            blocks += own.div_ceil(u64::from(BLOCK_RINGS));
            if rings > RINGS_MAX {
                return Err(PlanError::Rings { rings, limit: RINGS_MAX });
            }
            offsets.padded.push(padded);
            offsets.rings.push(rings);
            offsets.blocks.push(blocks);
        }
        Ok(offsets)
    }
}
