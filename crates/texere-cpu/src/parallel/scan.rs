//! Rolls at block starts: each block adds up its own steps, then a running sum along each yarn.

use rayon::prelude::*;
use texere_core::{BLOCK_RINGS, PaddedPoints, Plan, Turn};

use super::walk::Walk;
use crate::rolls::Rolls;

/// Blocks that one rayon item adds up: 4,096 rings.
const BLOCKS_AT_ONCE: usize = 64;

pub(super) fn scan(plan: &Plan, points: &PaddedPoints) -> Rolls {
    let mut rolls = Rolls { at_block: vec![Turn::ZERO; plan.block_count() as usize], whole: Vec::new() };
    let offsets = plan.block_offsets();
    rolls.at_block.par_chunks_mut(BLOCKS_AT_ONCE).enumerate().for_each(|(run, turns)| {
        let first = (run * BLOCKS_AT_ONCE) as u64;
        let mut yarn = offsets.partition_point(|&start| start <= first) - 1;
        for (turn, block) in turns.iter_mut().zip(first..) {
            if block == offsets[yarn + 1] {
                yarn += 1;
            }
            *turn = block_turn(plan, points, yarn, (block - offsets[yarn]) as u32 * BLOCK_RINGS);
        }
    });
    for bounds in offsets.windows(2) {
        let mut roll = Turn::ZERO;
        for turn in &mut rolls.at_block[bounds[0] as usize..bounds[1] as usize] {
            let here = roll;
            roll = roll + *turn;
            *turn = here;
        }
        rolls.whole.push(roll);
    }
    rolls
}

/// The steps from ring `first` of `yarn` to the first ring of the next block, or to the yarn's end, added up.
fn block_turn(plan: &Plan, points: &PaddedPoints, yarn: usize, first: u32) -> Turn {
    let steps = (plan.rings(yarn) - 1 - first).min(BLOCK_RINGS);
    let twist = plan.twist_turns(yarn);
    let mut walk = Walk::new(plan, points, yarn, first);
    let mut here = walk.step();
    (0..steps)
        .map(|_| {
            let next = walk.step();
            let chord = here.chord_to(&next);
            let turn = plan.settings().frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
            here = next;
            turn
        })
        .sum()
}
