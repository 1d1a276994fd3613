//! Whether a chunk is a plan's own. Kernels run without bounds checks, and a chunk is plain data that anyone can make.

use super::{BLOCK_RINGS, Block, Cap, Chunk, Plan, WINDOW_POINTS};
use crate::{End, Topology};

impl Plan {
    /// Whether `chunk` is one that this plan may have cut: its tables say what the plan says of its blocks.
    ///
    /// A backend whose kernels don't check bounds asks before it launches anything on a chunk. It takes time in
    /// proportion to the chunk's blocks.
    #[must_use]
    pub fn holds(&self, chunk: &Chunk) -> bool {
        let (range, window) = (&chunk.block_range, &chunk.window);
        let rows = (range.end.saturating_sub(range.start)).saturating_add(chunk.repeats_ring.into());
        let sound = range.start < range.end
            && range.end <= self.block_count() - u64::from(chunk.repeats_ring)
            && rows == chunk.blocks.len() as u64
            && window.start.is_multiple_of(WINDOW_POINTS)
            && window.start < window.end
            && self.padded_offsets().last().is_some_and(|points| window.end <= *points);
        sound && Walk::new(self, chunk).is_some_and(|walk| walk.ends_as(chunk))
    }
}

/// A walk over the blocks of a chunk, and what they have come to so far.
struct Walk<'a> {
    plan: &'a Plan,
    yarn: usize,
    rings: u64,
    indices: u64,
}

impl<'a> Walk<'a> {
    /// Walks over all rows; `None` where one of them is not the plan's.
    fn new(plan: &'a Plan, chunk: &Chunk) -> Option<Self> {
        let offsets = plan.block_offsets();
        let yarn = offsets.partition_point(|first| *first <= chunk.block_range.start).checked_sub(1)?;
        let mut walk = Self { plan, yarn, rings: 0, indices: 0 };
        for (number, block) in (chunk.block_range.start..).zip(&chunk.blocks) {
            if offsets[walk.yarn + 1] == number {
                walk.yarn += 1;
            }
            if !walk.takes(chunk, number, block) {
                return None;
            }
        }
        Some(walk)
    }

    /// Whether `block` is what the plan says of block `number`, or of its first ring where that is repeated.
    fn takes(&mut self, chunk: &Chunk, number: u64, block: &Block) -> bool {
        let (plan, yarn) = (self.plan, self.yarn);
        let (sides, per_interval) =
            (u64::from(plan.settings().sides), u64::from(plan.settings().subdivisions) + 1);
        let first = (number - plan.block_offsets()[yarn]) * u64::from(BLOCK_RINGS);
        let left = u64::from(plan.rings(yarn)) - first;
        let (rings, quads) = if number == chunk.block_range.end {
            (1, 0)
        } else {
            (left.min(BLOCK_RINGS.into()), (left - 1).min(BLOCK_RINGS.into()))
        };
        let point = (plan.padded_offsets()[yarn] + first / per_interval).checked_sub(chunk.window.start);
        let row =
            [block.yarn, block.first_ring, block.rings, block.quads, block.chunk_ring, block.first_vertex];
        let planned = [yarn as u64, first, rings, quads, self.rings, self.rings * sides];
        let same = row.map(u64::from) == planned
            && point == Some(block.first_point.into())
            && self.indices == block.first_index.into()
            && self.in_window(chunk, first)
            && self.in_window(chunk, first + quads.max(rings - 1));
        self.rings += rings;
        if plan.settings().topology == Topology::Indexed {
            self.indices += quads * sides * 6;
        }
        same
    }

    /// Whether the four points of ring `ring` lie in the window.
    fn in_window(&self, chunk: &Chunk, ring: u64) -> bool {
        let per_interval = u64::from(self.plan.settings().subdivisions) + 1;
        // The last ring of an open yarn is t = 1 of the interval before.
        let at_end = !self.plan.yarn(self.yarn).closed && ring + 1 == u64::from(self.plan.rings(self.yarn));
        let point = self.plan.padded_offsets()[self.yarn] + ring / per_interval - u64::from(at_end);
        chunk.window.start <= point && point + 4 <= chunk.window.end
    }

    /// Whether the chunk's caps and counts are right, too.
    fn ends_as(&self, chunk: &Chunk) -> bool {
        let sides = u64::from(self.plan.settings().sides);
        let corners = if self.plan.settings().topology == Topology::Indexed { 3 * (sides - 2) } else { 0 };
        let caps = chunk.caps.len() as u64;
        let counts = [chunk.rings, chunk.vertices, chunk.indices].map(u64::from);
        counts == [self.rings, (self.rings + caps) * sides, self.indices + caps * corners]
            && (0..).zip(&chunk.caps).all(|(number, cap)| {
                u64::from(cap.first_vertex) == (self.rings + number) * sides
                    && u64::from(cap.first_index) == self.indices + number * corners
                    && self.has_end(chunk, cap)
            })
    }

    /// Whether the chunk holds the end of an open yarn that `cap` closes.
    fn has_end(&self, chunk: &Chunk, cap: &Cap) -> bool {
        let row = chunk.blocks.partition_point(|block| block.chunk_ring <= cap.chunk_ring).checked_sub(1);
        row.and_then(|row| chunk.blocks.get(row)).is_some_and(|block| {
            let within = cap.chunk_ring - block.chunk_ring;
            let end = match cap.end {
                End::Start => 0,
                End::Finish => self.plan.rings(block.yarn as usize) - 1,
            };
            cap.yarn == block.yarn
                && within < block.rings
                && block.first_ring + within == end
                && !self.plan.yarn(block.yarn as usize).closed
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::{ControlPoint, Limits, Settings, Yarn, Yarns};

    use super::*;

    fn plans() -> Vec<Arc<Plan>> {
        let mut plans = Vec::new();
        for (subdivisions, sides) in [(0, 3), (1, 6), (7, 5)] {
            for topology in [Topology::Indexed, Topology::Shared] {
                for caps in [true, false] {
                    let mut yarns = Yarns::builder();
                    for (points, closed) in [(2, false), (65, false), (64, true), (130, false), (3, true)] {
                        let points: Vec<_> =
                            (0..points).map(|k| ControlPoint::new(k as f32, 0.0, 0.0, 0.1)).collect();
                        yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
                    }
                    let settings = Settings { subdivisions, sides, topology, caps, ..Settings::default() };
                    let layout = yarns.build().unwrap().layout().clone();
                    plans.push(Arc::new(Plan::new(layout, settings).unwrap()));
                }
            }
        }
        plans
    }

    #[test]
    fn every_chunk_of_a_plan_belongs() {
        for plan in plans() {
            for blocks in [2, 3, 5, u64::MAX] {
                for chunk in plan.chunks(&Limits { blocks, ..Limits::NONE }).unwrap() {
                    assert!(plan.holds(&chunk), "{chunk:?}");
                }
            }
        }
    }

    #[test]
    fn a_chunk_with_any_number_changed_does_not() {
        let changes: [fn(&mut Chunk); 19] = [
            |chunk| chunk.block_range.start += 1,
            |chunk| chunk.block_range.end += 1,
            |chunk| chunk.block_range = 5..u64::MAX,
            |chunk| chunk.window.end = u64::MAX,
            |chunk| chunk.window.end -= 1,
            |chunk| chunk.window.start += 1,
            |chunk| chunk.repeats_ring = !chunk.repeats_ring,
            |chunk| chunk.rings += 1,
            |chunk| chunk.vertices += 1,
            |chunk| chunk.indices += 1,
            |chunk| chunk.blocks.clear(),
            |chunk| chunk.blocks[0].yarn = u32::MAX,
            |chunk| chunk.blocks[0].first_ring += 64,
            |chunk| chunk.blocks[0].rings = 1 << 20,
            |chunk| chunk.blocks[0].quads += 1,
            |chunk| chunk.blocks[0].first_point = u32::MAX,
            |chunk| chunk.blocks[0].chunk_ring = 1,
            |chunk| chunk.blocks[0].first_vertex = u32::MAX,
            |chunk| chunk.blocks[0].first_index = 6,
        ];
        let cap_changes: [fn(&mut Cap); 7] = [
            |cap| cap.end = if cap.end == End::Start { End::Finish } else { End::Start },
            |cap| cap.chunk_ring += 64,
            |cap| cap.yarn = u32::MAX,
            |cap| cap.yarn += 1,
            |cap| cap.chunk_ring = u32::MAX,
            |cap| cap.first_vertex += 1,
            |cap| cap.first_index += 1,
        ];
        for plan in plans() {
            for chunk in plan.chunks(&Limits { blocks: 3, ..Limits::NONE }).unwrap() {
                for (number, change) in changes.iter().enumerate() {
                    let mut changed = chunk.clone();
                    change(&mut changed);
                    assert!(!plan.holds(&changed), "change {number} of {chunk:?}");
                }
                for (number, change) in cap_changes.iter().enumerate().filter(|_| !chunk.caps.is_empty()) {
                    let mut changed = chunk.clone();
                    change(&mut changed.caps[0]);
                    assert!(!plan.holds(&changed), "change {number} to a cap of {chunk:?}");
                }
            }
        }
    }
}
