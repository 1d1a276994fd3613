//! Chunks: ranges of blocks that fit a device, cut also inside a yarn.

use std::ops::Range;

use super::{BLOCK_RINGS, Block, Limits, Plan, PlanId};
use crate::{ControlPoint, End, PlanError, Ring, Topology, Vertex};

/// A run of one yarn's rings in a chunk. All but `yarn` and `first_ring` count from the start of the chunk.
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
/// It holds all that a launch needs: the block table, the parts that it makes, and its place in the whole. Where it
/// ends inside a yarn it repeats the next ring, so that its triangles use its own vertices alone. Only [`Plan::chunks`]
/// makes chunks, and they can't be changed, so a kernel need not check their tables.
///
/// ```
/// use texere_core::{ControlPoint, Limits, Plan, Settings, Yarn, Yarns};
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
    plan: PlanId,
    index: u64,
    block_range: Range<u64>,
    window: Range<u64>,
    blocks: Vec<Block>,
    parts: Vec<Part>,
    caps: Vec<Cap>,
    repeats_ring: bool,
    rings: u32,
    vertices: u32,
    indices: u32,
    first_vertex: u64,
    first_index: u64,
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

    /// Its blocks among all blocks of the plan; the table has one row more where a ring is repeated. Chunks of one plan with
    /// the same range have the same tables, and differ at most in their place in the whole.
    #[must_use]
    pub const fn block_range(&self) -> Range<u64> {
        self.block_range.start..self.block_range.end
    }

    /// The padded control points that it reads, from a multiple of [`WINDOW_POINTS`] on.
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

    /// Rings, the repeated one included.
    #[must_use]
    pub const fn rings(&self) -> u32 {
        self.rings
    }

    /// Vertices, caps included.
    #[must_use]
    pub const fn vertices(&self) -> u32 {
        self.vertices
    }

    /// Indices that it holds; none but with [`Topology::Indexed`].
    #[must_use]
    pub const fn indices(&self) -> u32 {
        self.indices
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

/// Windows start at multiples of this many control points: 256 bytes, an offset that every device allows for a binding.
pub const WINDOW_POINTS: u64 = 16;

/// What a chunk takes, in the units of [`Limits`].
#[derive(Debug, Clone, Copy, Default)]
struct Size {
    blocks: u64,
    rings: u64,
    vertices: u64,
    indices: u64,
    window: u64,
}

impl Size {
    fn buffers(&self) -> [(&'static str, u64); 5] {
        let bytes = |count: u64, each: usize| count * each as u64;
        [
            ("vertices", bytes(self.vertices, size_of::<Vertex>())),
            ("indices", bytes(self.indices, 4)),
            ("rings", bytes(self.rings, size_of::<Ring>())),
            ("the block table", bytes(self.blocks, size_of::<Block>())),
            ("control points", bytes(self.window, size_of::<ControlPoint>())),
        ]
    }

    /// The first limit that is exceeded.
    fn excess(&self, resident: u64, limits: &Limits) -> Option<PlanError> {
        let rings = self.rings as u32;
        let index_limit = u64::from(u32::MAX);
        let counts = [
            ("blocks", self.blocks, limits.blocks),
            ("vertices", self.vertices, index_limit),
            ("indices", self.indices, index_limit),
        ];
        if let Some((what, needed, limit)) = counts.into_iter().find(|(_, needed, limit)| needed > limit) {
            return Some(PlanError::BlockOverCount { rings, what, needed, limit });
        }
        // Two chunks in flight; the window is part of the resident control points.
        let each: u64 = self.buffers()[..4].iter().map(|(_, bytes)| bytes).sum();
        let memory = [("all buffers", resident + 2 * each, limits.memory_bytes)];
        let bindings = self.buffers().into_iter().map(|(what, bytes)| (what, bytes, limits.binding_bytes));
        let (what, needed, limit) =
            memory.into_iter().chain(bindings).find(|(_, needed, limit)| needed > limit)?;
        Some(PlanError::BlockTooLarge { rings, what, needed, limit })
    }
}

impl Plan {
    /// Cuts the work into chunks that fit `limits`, in order. Two chunks and the control points fit
    /// `limits.memory_bytes` together.
    ///
    /// **Errors**: [`PlanError::BlockTooLarge`] or [`PlanError::BlockOverCount`] when not even one block fits.
    pub fn chunks(&self, limits: &Limits) -> Result<Chunks<'_>, PlanError> {
        Chunks::new(self, *limits)
    }
}

/// The chunks of a plan, cut as they are asked for.
#[derive(Debug, Clone)]
pub struct Chunks<'a> {
    plan: &'a Plan,
    limits: Limits,
    index: u64,
    next_block: u64,
    next_yarn: usize,
    first_vertex: u64,
    first_index: u64,
}

impl<'a> Chunks<'a> {
    pub(super) fn new(plan: &'a Plan, limits: Limits) -> Result<Self, PlanError> {
        let chunks =
            Self { plan, limits, index: 0, next_block: 0, next_yarn: 0, first_vertex: 0, first_index: 0 };
        // Where any block fits, yarns need not be looked at one by one: a session asks for chunks with each scan.
        if chunks.largest_block().excess(plan.resident_bytes(), &limits).is_none() {
            return Ok(chunks);
        }
        for yarn in 0..plan.layout().yarns().len() {
            let offsets = plan.block_offsets();
            // The first, the last and, standing for those between, the second block of the yarn.
            let (first, end) = (offsets[yarn], offsets[yarn + 1]);
            for block in [first, (first + 1).min(end - 1), end - 1] {
                let size = chunks.extended(&Size::default(), None, yarn, block).1;
                if let Some(excess) = size.excess(plan.resident_bytes(), &limits) {
                    return Err(excess);
                }
            }
        }
        Ok(chunks)
    }

    /// No less than any block takes, with both its caps and the ring that it may repeat.
    fn largest_block(&self) -> Size {
        let (sides, rings) = (u64::from(self.plan.settings().sides), u64::from(BLOCK_RINGS) + 1);
        Size {
            blocks: 2,
            rings,
            vertices: (rings + 2) * sides,
            indices: (rings + 1) * sides * 6,
            // Each ring in an interval of its own, then the other points that the last one and the step to the next ring read.
            window: rings + 5 + WINDOW_POINTS,
        }
    }

    /// Rings of block `block` of `yarn`: first, count, and whether the yarn goes on after it.
    fn block_rings(&self, yarn: usize, block: u64) -> (u32, u32, bool) {
        let first = (block - self.plan.block_offsets()[yarn]) as u32 * BLOCK_RINGS;
        let left = self.plan.rings(yarn) - first;
        (first, left.min(BLOCK_RINGS), left > BLOCK_RINGS)
    }

    /// The padded control points that `count` rings of `yarn` from `first` read, and the step to the ring after them.
    fn points_read(&self, yarn: usize, first: u32, count: u32) -> Range<u64> {
        let per_interval = u64::from(self.plan.settings().subdivisions) + 1;
        let start = self.plan.padded_offsets()[yarn];
        let end = self.plan.padded_offsets()[yarn + 1];
        // The ring after the last one read falls in interval (first + count) / (K + 1), which reads four points.
        let last = (u64::from(first) + u64::from(count)) / per_interval + 4;
        start + self.first_interval(yarn, first)..(start + last).min(end)
    }

    /// The interval whose points ring `ring` of `yarn` is evaluated from: the last ring of an open yarn is t = 1 of the
    /// interval before.
    fn first_interval(&self, yarn: usize, ring: u32) -> u64 {
        let interval = u64::from(ring) / (u64::from(self.plan.settings().subdivisions) + 1);
        let at_end = !self.plan.yarn(yarn).closed && ring + 1 == self.plan.rings(yarn);
        if at_end { interval - 1 } else { interval }
    }

    fn cap_count(&self, yarn: usize, first: u32, goes_on: bool) -> u64 {
        if self.plan.settings().caps && !self.plan.yarn(yarn).closed {
            u64::from(first == 0) + u64::from(!goes_on)
        } else {
            0
        }
    }

    /// `size` with one block more: as it is when others follow, and as it is when the chunk ends there, where a ring
    /// may have to be repeated. `window` is where the chunk's control points start.
    fn extended(&self, size: &Size, window: Option<u64>, yarn: usize, block: u64) -> (Size, Size) {
        let (sides, indexed) =
            (u64::from(self.plan.settings().sides), self.plan.settings().topology == Topology::Indexed);
        let (first, rings, goes_on) = self.block_rings(yarn, block);
        let caps = self.cap_count(yarn, first, goes_on);
        let quads = u64::from(if goes_on { rings } else { rings - 1 });
        let points = self.points_read(yarn, first, rings + u32::from(goes_on));
        // Where the window is not known yet, the worst case: it starts up to WINDOW_POINTS - 1 points earlier, to be aligned.
        let window = window.unwrap_or(points.start.saturating_sub(WINDOW_POINTS - 1));
        let inner = Size {
            blocks: size.blocks + 1,
            rings: size.rings + u64::from(rings),
            vertices: size.vertices + (u64::from(rings) + caps) * sides,
            indices: size.indices + if indexed { quads * sides * 6 + caps * (sides - 2) * 3 } else { 0 },
            window: points.end - window,
        };
        let repeat = u64::from(goes_on);
        let ended = Size {
            blocks: inner.blocks + repeat,
            rings: inner.rings + repeat,
            vertices: inner.vertices + repeat * sides,
            ..inner
        };
        (inner, ended)
    }

    /// The end of the next chunk: one past its last block, and the end of its window.
    fn cut(&self, window: u64) -> (u64, u64) {
        let (mut size, mut block, mut yarn) = (Size::default(), self.next_block, self.next_yarn);
        let mut cut = (block, window);
        while block < self.plan.block_count() {
            let (inner, ended) = self.extended(&size, Some(window), yarn, block);
            if inner.excess(self.plan.resident_bytes(), &self.limits).is_some() {
                break;
            }
            block += 1;
            if ended.excess(self.plan.resident_bytes(), &self.limits).is_none() {
                cut = (block, window + ended.window);
            }
            if block == self.plan.block_offsets()[yarn + 1] {
                yarn += 1;
            }
            size = inner;
        }
        cut
    }
}

impl Iterator for Chunks<'_> {
    type Item = Chunk;

    fn next(&mut self) -> Option<Chunk> {
        if self.next_block == self.plan.block_count() {
            return None;
        }
        let (first_of_first, ..) = self.block_rings(self.next_yarn, self.next_block);
        let start =
            self.plan.padded_offsets()[self.next_yarn] + self.first_interval(self.next_yarn, first_of_first);
        let window = start / WINDOW_POINTS * WINDOW_POINTS;
        let (end_block, window_end) = self.cut(window);
        let mut chunk = Chunk {
            plan: self.plan.id(),
            index: self.index,
            block_range: self.next_block..end_block,
            window: window..window_end,
            blocks: Vec::with_capacity((end_block - self.next_block) as usize + 1),
            parts: Vec::new(),
            caps: Vec::new(),
            repeats_ring: false,
            rings: 0,
            vertices: 0,
            indices: 0,
            first_vertex: self.first_vertex,
            first_index: self.first_index,
        };
        self.fill(&mut chunk);
        self.index += 1;
        self.next_block = end_block;
        self.first_vertex += u64::from(chunk.vertices);
        self.first_index += u64::from(chunk.indices);
        Some(chunk)
    }
}

impl Chunks<'_> {
    /// Writes the block table, the parts and the caps of `chunk`, and moves on to the yarn after it.
    fn fill(&mut self, chunk: &mut Chunk) {
        let settings = self.plan.settings();
        let (sides, indexed) = (settings.sides, settings.topology == Topology::Indexed);
        let mut yarn = self.next_yarn;
        for number in chunk.block_range.clone() {
            let (first, rings, goes_on) = self.block_rings(yarn, number);
            let starts_part = number == chunk.block_range.start || first == 0;
            if starts_part {
                chunk.parts.push(Part {
                    yarn: yarn as u32,
                    first_ring: first,
                    rings: 0,
                    first_vertex: chunk.rings * sides,
                    first_index: chunk.indices,
                });
            }
            if settings.caps && !self.plan.yarn(yarn).closed {
                note_caps(chunk, yarn, first, rings, goes_on);
            }
            chunk.repeats_ring = goes_on && number + 1 == chunk.block_range.end;
            self.push_block(chunk, yarn, first, rings, if goes_on { rings } else { rings - 1 });
            if chunk.repeats_ring {
                self.push_block(chunk, yarn, first + rings, 1, 0);
            }
            if !goes_on {
                yarn += 1;
            }
        }
        self.next_yarn = yarn;
        chunk.vertices = chunk.rings * sides;
        for cap in &mut chunk.caps {
            cap.first_vertex = chunk.vertices;
            cap.first_index = chunk.indices;
            chunk.vertices += sides;
            chunk.indices += if indexed { (sides - 2) * 3 } else { 0 };
        }
    }

    fn push_block(&self, chunk: &mut Chunk, yarn: usize, first_ring: u32, rings: u32, quads: u32) {
        let settings = self.plan.settings();
        // Kernels work out interval and remainder alike for all rings, so the table has the plain interval of the first.
        let interval = u64::from(first_ring) / (u64::from(settings.subdivisions) + 1);
        let point = self.plan.padded_offsets()[yarn] + interval;
        chunk.blocks.push(Block {
            yarn: yarn as u32,
            first_ring,
            rings,
            quads,
            first_point: (point - chunk.window.start) as u32,
            chunk_ring: chunk.rings,
            first_vertex: chunk.rings * settings.sides,
            first_index: chunk.indices,
        });
        chunk.rings += rings;
        if settings.topology == Topology::Indexed {
            chunk.indices += quads * settings.sides * 6;
        }
        if let Some(part) = chunk.parts.last_mut() {
            part.rings += rings;
        }
    }
}

/// Notes the caps that a block brings; their places are known only after the last tube vertex.
fn note_caps(chunk: &mut Chunk, yarn: usize, first: u32, rings: u32, goes_on: bool) {
    let ends = [(End::Start, first == 0, 0), (End::Finish, !goes_on, rings - 1)];
    for (end, present, ring) in ends {
        if present {
            let chunk_ring = chunk.rings + ring;
            chunk.caps.push(Cap { yarn: yarn as u32, end, chunk_ring, first_vertex: 0, first_index: 0 });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, Settings, Yarn, Yarns};

    #[test]
    fn no_block_takes_more_than_the_largest() {
        let mut yarns = Yarns::builder();
        for count in [3, 64, 65, 66, 130, 500] {
            let points: Vec<_> = (0..count).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect();
            yarns.yarn(Yarn::default(), &points);
            yarns.yarn(Yarn { closed: true, ..Yarn::default() }, &points);
        }
        let yarns = yarns.build().unwrap();
        for (sides, subdivisions, caps) in
            [(3, 0, true), (3, 0, false), (6, 1, true), (256, 0, true), (5, 7, false)]
        {
            let settings =
                Settings { sides, subdivisions, caps, frame: Frame::Upright, ..Settings::default() };
            let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
            let chunks = plan.chunks(&Limits::NONE).unwrap();
            let largest = chunks.largest_block();
            for yarn in 0..plan.layout().yarns().len() {
                for block in plan.block_offsets()[yarn]..plan.block_offsets()[yarn + 1] {
                    let size = chunks.extended(&Size::default(), None, yarn, block).1;
                    let pairs = [
                        (size.blocks, largest.blocks),
                        (size.rings, largest.rings),
                        (size.vertices, largest.vertices),
                        (size.indices, largest.indices),
                        (size.window, largest.window),
                    ];
                    assert!(pairs.iter().all(|(size, largest)| size <= largest), "{size:?} of {largest:?}");
                }
            }
        }
    }
}
