//! Algorithm 1 of the paper: for each yarn, for each control interval, K + 1 points of the spline.

use texere_core::{Chunk, Ring};

use crate::engine::Work;

pub(super) fn trajectory(work: &Work, chunk: &Chunk, out: &mut [Ring]) {
    let plan = &work.plan;
    for (block, number) in chunk.blocks().iter().zip(chunk.block_range().start..) {
        let yarn = block.yarn as usize;
        let (padded, rings, closed) =
            (work.points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
        let twist = plan.twist_turns(yarn);
        let at = |ring| plan.sampling().sample(padded, ring, rings, closed);
        let level = plan.settings().frame.is_level(twist);

        let mut roll = work.rolls.at_block(number);
        let mut here = at(block.first_ring);
        for k in 0..block.rings {
            let ring = block.first_ring + k;
            let place = (block.chunk_ring + k) as usize;
            out[place] = Ring::new(&here.sample, work.rolls.closed_up(plan, yarn, ring, roll));
            if k + 1 < block.rings {
                let next = at(ring + 1);
                if !level {
                    let chord = here.chord_to(&next);
                    roll = roll
                        + plan.settings().frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
                }
                here = next;
            }
        }
    }
}
