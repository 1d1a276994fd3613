//! Cuts a plan into chunks.

use std::ops::Range;

use super::chunk::Chunk;
use super::identity::TablesId;
use super::{BLOCK_RINGS, Block, Limits, Plan};
use crate::definitions::Ring;
use crate::{ControlPoint, PlanError, Topology, Vertex};

/// A chunk's window is the range of padded control points that it reads. Windows start at multiples
/// of this number of points: 256 bytes, an offset that every device allows for a binding.
pub const WINDOW_POINTS: u64 = 16;

/// The counts of a chunk that are compared with [`Limits`].
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

    /// The error for the first limit that is exceeded, or none.
    fn excess(&self, resident: u64, limits: &Limits) -> Option<PlanError> {
        let rings = self.rings as u32;
        // In an indexed draw the first index is a `u32`, and the first vertex an `i32`.
        let (index_limit, vertex_limit) = (u64::from(u32::MAX), i32::MAX as u64);
        let counts = [
            ("blocks", self.blocks, limits.blocks),
            ("vertices", self.vertices, vertex_limit),
            ("indices", self.indices, index_limit),
        ];
        if let Some((what, needed, limit)) = counts.into_iter().find(|(_, needed, limit)| needed > limit) {
            return Some(PlanError::BlockOverCount { rings, what, needed, limit });
        }
        // Two chunks are in flight. The window is part of the resident control points.
        let each: u64 = self.buffers()[..4].iter().map(|(_, bytes)| bytes).sum();
        let memory = [("all buffers", resident + 2 * each, limits.memory_bytes)];
        let bindings = self.buffers().into_iter().map(|(what, bytes)| (what, bytes, limits.binding_bytes));
        let (what, needed, limit) =
            memory.into_iter().chain(bindings).find(|(_, needed, limit)| needed > limit)?;
        Some(PlanError::BlockTooLarge { rings, what, needed, limit })
    }
}

impl Plan {
    /// Cuts the plan into chunks that fit `limits`, in order. Two chunks and the control points
    /// together fit `limits.memory_bytes`.
    ///
    /// **Errors**: [`PlanError::BlockTooLarge`] or [`PlanError::BlockOverCount`] if not even one
    /// block fits.
    pub fn chunks(&self, limits: &Limits) -> Result<Chunks<'_>, PlanError> {
        Chunks::new(self, *limits)
    }
}

/// An iterator over the chunks of a plan. Each chunk is cut when the iterator reaches it.
#[derive(Debug, Clone)]
pub struct Chunks<'a> {
    plan: &'a Plan,
    limits: Limits,
    index: u64,
    next: Cursor,
    /// The identity of the plan's region, 0 for the whole plan.
    region: u64,
    first_vertex: u64,
    first_index: u64,
}

/// A block of a plan: its run, its number and its yarn. If `run` is the number of runs, the cursor
/// is past the last block.
#[derive(Debug, Clone, Copy)]
struct Cursor {
    run: usize,
    block: u64,
    yarn: usize,
}

impl<'a> Chunks<'a> {
    fn of(plan: &'a Plan, limits: Limits) -> Self {
        let region = if plan.is_whole() { 0 } else { TablesId::next(0..0).edit };
        let mut chunks = Self {
            plan,
            limits,
            index: 0,
            next: Cursor { run: 0, block: 0, yarn: 0 },
            region,
            first_vertex: 0,
            first_index: 0,
        };
        chunks.next = chunks.run_start(0);
        chunks
    }

    pub(super) fn new(plan: &'a Plan, limits: Limits) -> Result<Self, PlanError> {
        let chunks = Self::of(plan, limits);
        // If the largest block fits, yarns need not be checked one by one. That matters because a
        // session cuts the plan anew for each scan.
        if chunks.largest_block().excess(plan.resident_bytes(), &limits).is_none() {
            return Ok(chunks);
        }
        for yarn in 0..plan.layout().yarns().len() {
            let offsets = plan.block_offsets();
            // The first, the second and the last block of the yarn are checked. All others are as
            // large as the second.
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

    fn run_start(&self, run: usize) -> Cursor {
        let block = self.plan.runs().get(run).map_or(0, |run| run.start);
        Cursor { run, block, yarn: self.plan.yarn_of_block(block) }
    }

    /// The block after `at`, and whether it starts another run.
    fn after(&self, at: Cursor) -> (Cursor, bool) {
        let block = at.block + 1;
        if block == self.plan.runs()[at.run].end {
            return (self.run_start(at.run + 1), true);
        }
        let yarn = at.yarn + usize::from(block == self.plan.block_offsets()[at.yarn + 1]);
        (Cursor { block, yarn, ..at }, false)
    }

    /// An upper bound on the size of any block, with both its caps and the ring that it may repeat.
    fn largest_block(&self) -> Size {
        let (sides, rings) = (u64::from(self.plan.settings().sides), u64::from(BLOCK_RINGS) + 1);
        Size {
            blocks: 2,
            rings,
            vertices: (rings + 2) * sides,
            indices: (rings + 1) * sides * 6,
            // Each ring may lie in an interval of its own. The last ring, and the step to the ring
            // after it, read some more points.
            window: rings + 5 + WINDOW_POINTS,
        }
    }

    /// The padded control points read by `count` rings of `yarn` from `first`, and by the step to
    /// the ring after them.
    fn points_read(&self, yarn: usize, first: u32, count: u32) -> Range<u64> {
        let per_interval = u64::from(self.plan.settings().subdivisions) + 1;
        let start = self.plan.padded_offsets()[yarn];
        let end = self.plan.padded_offsets()[yarn + 1];
        // The ring after the last one falls in interval (first + count) / per_interval, which reads
        // four points.
        let last = (u64::from(first) + u64::from(count)) / per_interval + 4;
        start + self.first_interval(yarn, first)..(start + last).min(end)
    }

    /// The interval that ring `ring` of `yarn` is evaluated in. The last ring of an open yarn is t
    /// = 1 of the interval before.
    fn first_interval(&self, yarn: usize, ring: u32) -> u64 {
        let interval = u64::from(ring) / (u64::from(self.plan.settings().subdivisions) + 1);
        // In a plan with room, any ring may become the last of its yarn.
        let last = |ring: u32| self.plan.is_roomy() && ring > 0 || ring + 1 == self.plan.rings(yarn);
        let at_end = !self.plan.yarn(yarn).closed && last(ring);
        if at_end { interval.saturating_sub(1) } else { interval }
    }

    /// The number of caps of a block, room included. A yarn with room may end in any one of its
    /// blocks.
    fn cap_count(&self, yarn: usize, first: u32, goes_on: bool) -> u64 {
        if self.plan.settings().caps && !self.plan.yarn(yarn).closed {
            u64::from(first == 0) + u64::from(!goes_on || self.plan.is_roomy())
        } else {
            0
        }
    }

    /// `size` with one more block, for two cases: that other blocks follow, and that the chunk ends
    /// after the block and may have to repeat a ring. `window` is the start of the chunk's control
    /// points.
    fn extended(&self, size: &Size, window: Option<u64>, yarn: usize, block: u64) -> (Size, Size) {
        self.with_rings(size, window, yarn, self.plan.block_rings(yarn, block))
    }

    /// Does the work of [`Chunks::extended`] for given rings of a yarn: the first, their number,
    /// and whether other rings follow.
    fn with_rings(
        &self,
        size: &Size,
        window: Option<u64>,
        yarn: usize,
        (first, rings, goes_on): (u32, u32, bool),
    ) -> (Size, Size) {
        let (sides, indexed) =
            (u64::from(self.plan.settings().sides), self.plan.settings().topology == Topology::Indexed);
        let caps = self.cap_count(yarn, first, goes_on);
        let quads = u64::from(if goes_on { rings } else { rings - 1 });
        let points = self.points_read(yarn, first, rings + u32::from(goes_on));
        // If the window is not known, the worst case counts: the window starts WINDOW_POINTS - 1
        // points earlier, to be aligned.
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

    /// `size` with the whole yarn that begins at `at`, and the block after that yarn. `None` if no
    /// yarn begins at `at`, or if the run ends before that block. `None`, too, if the plan has
    /// room: the sizes of blocks then do not add up to that of the yarn.
    fn with_yarn(&self, size: &Size, window: u64, at: Cursor) -> Option<(Size, Cursor)> {
        let blocks = &self.plan.block_offsets()[at.yarn..at.yarn + 2];
        let is_whole = at.block == blocks[0] && blocks[1] < self.plan.runs()[at.run].end;
        if !is_whole || self.plan.is_roomy() {
            return None;
        }
        let (with, _) = self.with_rings(size, Some(window), at.yarn, (0, self.plan.rings(at.yarn), false));
        let size = Size { blocks: size.blocks + blocks[1] - blocks[0], ..with };
        Some((size, Cursor { block: blocks[1], yarn: at.yarn + 1, ..at }))
    }

    /// The end of the next chunk: the first block of the chunk after it, and the end of its window.
    fn cut(&self, window: u64) -> (Cursor, u64) {
        let (mut size, mut at) = (Size::default(), self.next);
        let mut cut = (at, window);
        while at.run < self.plan.runs().len() {
            // Most yarns fit as a whole and need not be checked block by block.
            let with_yarn = self.with_yarn(&size, window, at);
            if let Some((with, after)) =
                with_yarn.filter(|(with, _)| with.excess(self.plan.resident_bytes(), &self.limits).is_none())
            {
                (size, at) = (with, after);
                cut = (at, window + size.window);
                continue;
            }
            let (inner, ended) = self.extended(&size, Some(window), at.yarn, at.block);
            let (next, ends_run) = self.after(at);
            size = if ends_run { ended } else { inner };
            if size.excess(self.plan.resident_bytes(), &self.limits).is_some() {
                break;
            }
            at = next;
            if ended.excess(self.plan.resident_bytes(), &self.limits).is_none() {
                cut = (at, window + ended.window);
            }
        }
        cut
    }

    /// The blocks from the next one up to `end`, without `end`, as ranges.
    fn runs_to(&self, end: Cursor) -> Vec<Range<u64>> {
        let runs = (self.next.run..=end.run).filter_map(|run| {
            let all = self.plan.runs().get(run)?;
            let start = if run == self.next.run { self.next.block } else { all.start };
            Some(start..if run == end.run { end.block } else { all.end })
        });
        runs.filter(|run| !run.is_empty()).collect()
    }
}

impl Iterator for Chunks<'_> {
    type Item = Chunk;

    fn next(&mut self) -> Option<Chunk> {
        if self.next.run == self.plan.runs().len() {
            return None;
        }
        let (yarn, block) = (self.next.yarn, self.next.block);
        let (first_of_first, ..) = self.plan.block_rings(yarn, block);
        let start = self.plan.padded_offsets()[yarn] + self.first_interval(yarn, first_of_first);
        let window = start / WINDOW_POINTS * WINDOW_POINTS;
        let (end, window_end) = self.cut(window);
        let runs = self.runs_to(end);
        let blocks = block..runs.last().map_or(block, |run| run.end);
        let mut chunk = Chunk {
            plan: self.plan.id(),
            index: self.index,
            tables: TablesId { blocks, edit: self.region },
            window: window..window_end,
            blocks: Vec::with_capacity(runs.iter().map(|run| (run.end - run.start) as usize + 1).sum()),
            runs,
            parts: Vec::new(),
            caps: Vec::new(),
            repeats_ring: false,
            rings: 0,
            vertices: 0,
            indices: 0,
            first_vertex: self.first_vertex,
            first_index: self.first_index,
        };
        self.plan.fill(&mut chunk);
        self.index += 1;
        self.next = end;
        self.first_vertex += u64::from(chunk.vertices);
        self.first_index += u64::from(chunk.indices);
        Some(chunk)
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

    /// Chunks end as late as their limits allow, whether yarns are added as a whole or block by
    /// block.
    #[test]
    fn a_chunk_ends_at_the_last_block_that_fits() {
        let mut yarns = Yarns::builder();
        for count in [3, 64, 20, 66, 130, 500, 2, 2, 33] {
            let points: Vec<_> = (0..count).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect();
            yarns.yarn(Yarn { closed: count == 66, ..Yarn::default() }, &points);
        }
        let yarns = yarns.build().unwrap();
        let mut several = 0;
        for caps in [false, true] {
            let settings = Settings { caps, sides: 5, subdivisions: 2, ..Settings::default() };
            let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
            let none = Limits::NONE;
            let limits = (2..40).map(|blocks| Limits { blocks, ..none });
            let limits = limits.chain((1..60).map(|share| Limits { binding_bytes: 12_000 * share, ..none }));
            let limits = limits.chain((6..60).map(|share| Limits { memory_bytes: 40_000 * share, ..none }));
            for limits in limits {
                let Ok(mut chunks) = plan.chunks(&limits) else { continue };
                while chunks.next.run < plan.runs().len() {
                    let before = chunks.clone();
                    let Some(chunk) = chunks.next() else { break };
                    let (mut size, mut at, mut end) = (Size::default(), before.next, before.next.block);
                    while at.run < plan.runs().len() {
                        let (inner, ended) =
                            before.extended(&size, Some(chunk.window.start), at.yarn, at.block);
                        let fits = |size: &Size| size.excess(plan.resident_bytes(), &limits).is_none();
                        if !fits(&inner) {
                            break;
                        }
                        if fits(&ended) {
                            end = at.block + 1;
                        }
                        (size, (at, _)) = (inner, before.after(at));
                    }
                    assert_eq!(chunk.block_range().end, end, "{limits:?} {caps}");
                    several += u32::from(chunk.index() > 1);
                }
            }
        }
        assert!(several > 300, "{several}");
    }
}
