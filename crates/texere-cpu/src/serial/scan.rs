//! Rolls at block starts, added up ring by ring.

use std::ops::Range;

use texere_core::BackendError;
use texere_core::backend::{BLOCK_RINGS, PaddedPoints, Plan};
use texere_core::definitions::Turn;

use crate::engine::resize;
use crate::rolls::Rolls;

pub(super) fn scan(
    plan: &Plan,
    points: &PaddedPoints,
    rolls: &mut Rolls,
    yarns: Range<usize>,
) -> Result<(), BackendError> {
    resize("rolls", &mut rolls.at_block, plan.block_count())?;
    resize("whole turns", &mut rolls.whole, plan.counts().yarns)?;
    for yarn in yarns {
        let first = plan.block_offsets()[yarn] as usize;
        rolls.whole[yarn] = scan_yarn(plan, points, yarn, &mut rolls.at_block[first..]);
    }
    Ok(())
}

/// Writes the rolls at the block starts of `yarn` to `at_block`, and returns the yarn's total turn.
pub(crate) fn scan_yarn(plan: &Plan, points: &PaddedPoints, yarn: usize, at_block: &mut [Turn]) -> Turn {
    let (padded, rings, closed) = (points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
    let (frame, twist) = (plan.frame(yarn), plan.turns_per_mm(yarn));
    let at = |ring| plan.sampling().sample(padded, ring, rings, closed);

    let mut roll = Turn::ZERO;
    let mut here = at(0);
    for ring in 0..rings {
        if ring % BLOCK_RINGS == 0 {
            at_block[(ring / BLOCK_RINGS) as usize] = roll;
        }
        if ring + 1 < rings {
            let next = at(ring + 1);
            let chord = here.chord_to(&next);
            roll = roll + frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
            here = next;
        }
    }
    roll
}
