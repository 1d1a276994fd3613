//! Chunks: the blocks of a plan in portions that fit a device. A cut may lie inside a yarn.

use std::ops::Range;

use super::Block;
use super::identity::{PlanId, TablesId};
use crate::End;

/// A run of one yarn's rings in a chunk. `first_vertex` and `first_index` count from the start of
/// the chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// Number of the first ring, counted from the yarn's start.
    pub first_ring: u32,
    /// The number of rings, including the ring that is repeated at a cut.
    pub rings: u32,
    /// Number of the first of `rings * sides` vertices.
    pub first_vertex: u32,
    /// Number of the first of `(rings - 1) * sides * 6` indices, if the topology is indexed.
    pub first_index: u32,
}

/// The cap on an end of a yarn: `sides` vertices after all tube vertices of the chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cap {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// The end that the cap closes.
    pub end: End,
    /// Number of the ring under the cap, among the chunk's rings.
    pub chunk_ring: u32,
    /// Number of the first vertex, counted from the start of the chunk.
    pub first_vertex: u32,
    /// Number of the first index, counted from the start of the chunk, if the topology is indexed.
    pub first_index: u32,
}

/// Blocks that are launched, read and drawn together. They follow one another, but a chunk of a
/// [region](crate::backend::Plan::within) may skip some.
///
/// A chunk holds the tables for a launch: the block table, the parts, the caps, and the chunk's
/// place in the whole. If it ends inside a yarn, it repeats the next ring, so that its triangles
/// use only its own vertices. Only a plan makes chunks, and they can't be changed, so a kernel need
/// not check their tables.
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
    /// The chunk's blocks, in order, as ranges of their numbers among all blocks of the plan. A
    /// patch has the blocks of its chunk here.
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
    /// The identity of the chunk's plan.
    pub(crate) const fn plan(&self) -> PlanId {
        self.plan
    }

    /// The chunk's number among the chunks of the same cut, counted from 0.
    #[must_use]
    pub const fn index(&self) -> u64 {
        self.index
    }

    /// The range from the chunk's first to its last block among all blocks of the plan. A chunk of
    /// a [region](crate::backend::Plan::within) may skip some blocks. In the block table each
    /// repeated ring has a row of its own, and blocks of unused room have none.
    #[must_use]
    pub(crate) const fn block_range(&self) -> Range<u64> {
        self.tables.blocks.start..self.tables.blocks.end
    }

    /// The identity of the chunk's tables.
    #[must_use]
    pub const fn tables(&self) -> &TablesId {
        &self.tables
    }

    /// The range of padded control points that the chunk reads. It starts at a multiple of
    /// [`WINDOW_POINTS`](crate::backend::WINDOW_POINTS).
    #[must_use]
    pub const fn window(&self) -> Range<u64> {
        self.window.start..self.window.end
    }

    /// The block table, in order of yarn and ring.
    #[must_use]
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The chunk's parts, in order: each is a run of rings of one yarn.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The chunk's caps, in order. Empty without [`Settings::caps`](crate::Settings::caps).
    #[must_use]
    pub fn caps(&self) -> &[Cap] {
        &self.caps
    }

    /// Whether the chunk's last ring is repeated as the first of the next chunk.
    #[must_use]
    pub const fn repeats_ring(&self) -> bool {
        self.repeats_ring
    }

    /// The number of rings, including repeated rings and unused
    /// [room](crate::backend::Plan::with_room).
    #[must_use]
    pub const fn rings(&self) -> u32 {
        self.rings
    }

    /// The number of vertices, including caps and unused room.
    #[must_use]
    pub const fn vertices(&self) -> u32 {
        self.vertices
    }

    /// The number of indices, including caps and unused room. 0 unless the topology is
    /// [`Topology::Indexed`](crate::Topology::Indexed).
    #[must_use]
    pub const fn indices(&self) -> u32 {
        self.indices
    }

    /// The range of rows of the block table that hold any of `rings` of `yarn`. For no rings it may
    /// hold a row.
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

    /// The number of vertices in all chunks before this one.
    #[must_use]
    pub const fn first_vertex(&self) -> u64 {
        self.first_vertex
    }

    /// The number of indices in all chunks before this one.
    #[must_use]
    pub const fn first_index(&self) -> u64 {
        self.first_index
    }
}

impl Cap {
    /// The cap at place `place` among the chunk's caps, counted from 0. For now `first_vertex` and
    /// `first_index` are this place. `Plan::fill` replaces them when it has counted all tubes.
    pub(super) fn at(place: u32, yarn: usize, end: End, chunk_ring: u32) -> Self {
        Self { yarn: yarn as u32, end, chunk_ring, first_vertex: place, first_index: place }
    }
}
