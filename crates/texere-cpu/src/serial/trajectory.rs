//! Algorithm 1 of the paper: for each yarn and each control interval, K + 1 points of the spline,
//! where K is the number of subdivisions.

use texere_core::backend::{BLOCK_RINGS, Chunk};
use texere_core::definitions::Ring;

use crate::engine::Work;

pub(super) fn trajectory(work: &Work, chunk: &Chunk, out: &mut [Ring]) {
    for block in chunk.blocks() {
        let out = &mut out[block.chunk_ring as usize..][..block.rings as usize];
        rings(work, block.yarn as usize, block.first_ring, out);
    }
}

/// Writes the rings of `yarn` from `first_ring` on to `out`. `first_ring` must be the first ring of
/// a block.
pub(crate) fn rings(work: &Work, yarn: usize, first_ring: u32, out: &mut [Ring]) {
    let plan = &work.plan;
    let (padded, rings, closed) = (work.points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
    let twist = plan.turns_per_mm(yarn);
    let at = |ring| plan.sampling().sample(padded, ring, rings, closed);
    let (frame, level) = (plan.frame(yarn), !plan.turns(yarn));

    let mut roll = work.rolls.at_block(plan.block_offsets()[yarn] + u64::from(first_ring / BLOCK_RINGS));
    let mut here = at(first_ring);
    let count = out.len() as u32;
    for (k, place) in (0..count).zip(out) {
        let ring = first_ring + k;
        *place = plan.ring(yarn, ring, &here.sample, work.rolls.closed_up(plan, yarn, ring, roll));
        if k + 1 < count {
            let next = at(ring + 1);
            if !level {
                let chord = here.chord_to(&next);
                roll = roll + frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
            }
            here = next;
        }
    }
}
