//! Attributes of vertices, from the length of each yarn at each block's start.

use std::ops::Range;

use texere_core::backend::{BLOCK_RINGS, Block, Chunk, PaddedPoints, Plan};
use texere_core::definitions::corner_angle;
use texere_core::{ArcLength, Attribute};

use crate::engine::Work;
use crate::rolls::block_number;

/// The length of `yarn` from the first ring of its block number `block` to the first ring of the
/// next block, or to the yarn's last ring.
pub(crate) fn block_length(plan: &Plan, points: &PaddedPoints, yarn: usize, block: u32) -> ArcLength {
    let (padded, first) = (points.yarn(plan, yarn), block * BLOCK_RINGS);
    let end = (first + BLOCK_RINGS).min(plan.rings(yarn) - 1);
    (first..end).map(|ring| plan.sampling().step_length(padded, ring)).sum()
}

/// Replaces the length of each block of a yarn by the total length of the blocks before it.
pub(crate) fn sum_up(blocks: &mut [ArcLength]) {
    let mut along = ArcLength::ZERO;
    for block in blocks {
        along = along + std::mem::replace(block, along);
    }
}

/// The numbers of a yarn's blocks, counted over all yarns.
pub(crate) fn blocks_of(plan: &Plan, yarn: usize) -> Range<usize> {
    let first = plan.block_offsets()[yarn] as usize;
    first..first + plan.rings(yarn).div_ceil(BLOCK_RINGS) as usize
}

/// Writes the attributes of a block's vertices to `out`.
pub(crate) fn block(work: &Work, block: &Block, out: &mut [Attribute]) {
    let (plan, yarn) = (&work.plan, block.yarn as usize);
    let (padded, rings, closed) = (work.points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
    let (sampling, sides) = (plan.sampling(), plan.settings().sides);
    let mut along = work.lengths[block_number(plan, block) as usize];
    for (ring, corners) in (block.first_ring..).zip(out.chunks_exact_mut(sides as usize)) {
        let tangent = sampling.sample(padded, ring, rings, closed).sample.tangent.to_array();
        for (corner, attribute) in (0..sides).zip(corners) {
            *attribute = Attribute {
                yarn: block.yarn,
                angle: corner_angle(corner, sides),
                along: along.mm(),
                tangent,
            };
        }
        if ring + 1 < rings {
            along = along + sampling.step_length(padded, ring);
        }
    }
}

/// Writes the attributes of caps. They equal those of the end rings, which must be in `out`
/// already.
pub(crate) fn caps(work: &Work, chunk: &Chunk, out: &mut [Attribute]) {
    let sides = work.plan.settings().sides as usize;
    for cap in chunk.caps() {
        let ring = cap.chunk_ring as usize * sides;
        out.copy_within(ring..ring + sides, cap.first_vertex as usize);
    }
}
