//! Rolls at block starts: each block adds up its own steps, then a running sum along each yarn.

use rayon::prelude::*;
use texere_core::{BLOCK_RINGS, PaddedPoints, Plan, Turn};

use super::path::Path;
use super::rings::{BlockRings, FULL};
use crate::rolls::Rolls;

/// Blocks that one rayon item adds up: 4,096 rings.
const BLOCKS_AT_ONCE: usize = 64;

pub(super) fn scan(plan: &Plan, points: &PaddedPoints) -> Rolls {
    let mut rolls = Rolls { at_block: vec![Turn::ZERO; plan.block_count() as usize], whole: Vec::new() };
    let offsets = plan.block_offsets();
    let path = Path::detect();
    rolls.at_block.par_chunks_mut(BLOCKS_AT_ONCE).enumerate().for_each(|(run, turns)| {
        path.scan_run(plan, points, (run * BLOCKS_AT_ONCE) as u64, turns);
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

/// Each block's own steps, added up; the first block is number `first` among all of the plan.
#[inline(always)]
pub(super) fn scan_run(plan: &Plan, points: &PaddedPoints, first: u64, turns: &mut [Turn]) {
    let offsets = plan.block_offsets();
    let mut rings = BlockRings::new();
    let mut yarn = offsets.partition_point(|&start| start <= first) - 1;
    for (turn, block) in turns.iter_mut().zip(first..) {
        if block == offsets[yarn + 1] {
            yarn += 1;
        }
        *turn = block_turn(&mut rings, plan, points, yarn, (block - offsets[yarn]) as u32 * BLOCK_RINGS);
    }
}

/// The steps from ring `first` of `yarn` to the first ring of the next block, or to the yarn's end, added up.
#[inline(always)]
fn block_turn(rings: &mut BlockRings, plan: &Plan, points: &PaddedPoints, yarn: usize, first: u32) -> Turn {
    let count = (plan.rings(yarn) - 1 - first).min(BLOCK_RINGS) as usize;
    rings.upright(plan, points, yarn, first, count + 1);
    let mut steps = [Turn::ZERO; FULL];
    rings.steps(plan.settings().frame, plan.twist_turns(yarn), &mut steps);
    steps.into_iter().take(count).sum()
}
