//! Chunks: ranges of blocks that fit a device, cut also inside a yarn.

use std::ops::Range;

use super::Block;
use super::identity::{PlanId, TablesId};
use crate::End;

/// A run of one yarn's rings in a chunk. All but `yarn` and `first_ring` count from the start of
/// the chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// The yarn, from 0 among all.
    pub yarn: u32,
    /// The first ring, from the yarn's start.
    pub first_ring: u32,
    /// Rings, the one that a cut repeats included.
    pub rings: u32,
    /// The first vertex; `rings * sides` follow.
    pub first_vertex: u32,
    /// The first index; `(rings - 1) * sides * 6` follow where the topology is indexed.
    pub first_index: u32,
}

/// The closed end of a yarn: `sides` vertices after all tube vertices of the chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cap {
    /// The yarn, from 0 among all.
    pub yarn: u32,
    /// Which end.
    pub end: End,
    /// The ring that the cap closes, among the chunk's.
    pub chunk_ring: u32,
    /// The first vertex, from the start of the chunk.
    pub first_vertex: u32,
    /// The first index, from the start of the chunk, where the topology is indexed.
    pub first_index: u32,
}

/// A range of blocks that is launched, read and drawn together.
///
/// It holds all that a launch needs: the block table, the parts that it makes, and its place in the
/// whole. Where it ends inside a yarn it repeats the next ring, so that its triangles use its own
/// vertices alone. Only [`Plan::chunks`](crate::backend::Plan::chunks) makes chunks, and they can't
/// be changed, so a kernel need not check their tables.
///
/// ```
/// use texere_core::backend::Plan;
/// use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};
/// let points: Vec<_> = (0..100).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect();
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &points);
/// let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
/// // 199 rings: three full blocks of 64 and one of 7. Two rows of the block table have room for one block and the ring
/// // that it repeats, or for the last two blocks.
/// let chunks: Vec<_> = plan.chunks(&Limits { blocks: 2, ..Limits::NONE })?.collect();
/// let rings: Vec<_> = chunks.iter().map(|chunk| (chunk.parts()[0].first_ring, chunk.rings())).collect();
/// assert_eq!(rings, [(0, 65), (64, 65), (128, 71)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chunk {
    pub(super) plan: PlanId,
    pub(super) index: u64,
    pub(super) tables: TablesId,
    /// The blocks that it holds, in order.
    pub(super) runs: Vec<Range<u64>>,
    pub(super) window: Range<u64>,
    pub(super) blocks: Vec<Block>,
    pub(super) parts: Vec<Part>,
    pub(super) caps: Vec<Cap>,
    pub(super) repeats_ring: bool,
    pub(super) rings: u32,
    pub(super) vertices: u32,
    pub(super) indices: u32,
    pub(super) first_vertex: u64,
    pub(super) first_index: u64,
}

impl Chunk {
    /// The plan that it was cut from.
    pub(crate) const fn plan(&self) -> PlanId {
        self.plan
    }

    /// Its number among the chunks of the same cut, from 0.
    #[must_use]
    pub const fn index(&self) -> u64 {
        self.index
    }

    /// Its blocks among all blocks of the plan, the first to the last; those of a plan of a
    /// [region](crate::backend::Plan::within) may be fewer. The table has a row more for each ring
    /// that is repeated.
    #[must_use]
    pub(crate) const fn block_range(&self) -> Range<u64> {
        self.tables.blocks.start..self.tables.blocks.end
    }

    /// What its tables are known by.
    #[must_use]
    pub const fn tables(&self) -> &TablesId {
        &self.tables
    }

    /// The padded control points that it reads, from a multiple of
    /// [`WINDOW_POINTS`](crate::backend::WINDOW_POINTS) on.
    #[must_use]
    pub const fn window(&self) -> Range<u64> {
        self.window.start..self.window.end
    }

    /// The block table, in order of yarn and ring.
    #[must_use]
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Its parts: one run of rings for each yarn that it holds some of.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Its caps, in order; none unless [`Settings::caps`](crate::Settings::caps) asks for them.
    #[must_use]
    pub fn caps(&self) -> &[Cap] {
        &self.caps
    }

    /// Whether the last ring is the first of the next chunk.
    #[must_use]
    pub const fn repeats_ring(&self) -> bool {
        self.repeats_ring
    }

    /// Rings, the repeated one included, and those that there is only
    /// [room](crate::backend::Plan::with_room) for.
    #[must_use]
    pub const fn rings(&self) -> u32 {
        self.rings
    }

    /// Vertices, caps included, likewise.
    #[must_use]
    pub const fn vertices(&self) -> u32 {
        self.vertices
    }

    /// Indices that it holds, likewise; none but with
    /// [`Topology::Indexed`](crate::Topology::Indexed).
    #[must_use]
    pub const fn indices(&self) -> u32 {
        self.indices
    }

    /// The rows of the block table that hold a ring of `rings` of `yarn`.
    #[must_use]
    pub fn rows(&self, yarn: usize, rings: Range<u32>) -> Range<usize> {
        let before = |yarn: usize, ring: u32| {
            self.blocks.partition_point(|row| {
                (row.yarn as usize, row.first_ring + row.rings.saturating_sub(1)) < (yarn, ring)
            })
        };
        let first = before(yarn, rings.start);
        let end = self.blocks.partition_point(|row| (row.yarn as usize, row.first_ring) < (yarn, rings.end));
        first..end.max(first)
    }

    /// Vertices of all chunks before it.
    #[must_use]
    pub const fn first_vertex(&self) -> u64 {
        self.first_vertex
    }

    /// Indices of all chunks before it.
    #[must_use]
    pub const fn first_index(&self) -> u64 {
        self.first_index
    }
}

impl Cap {
    /// At place `place` among the chunk's caps; where their vertices and indices begin is known
    /// only after the last tube's.
    pub(super) fn at(place: u32, yarn: usize, end: End, chunk_ring: u32) -> Self {
        Self { yarn: yarn as u32, end, chunk_ring, first_vertex: place, first_index: place }
    }
}
