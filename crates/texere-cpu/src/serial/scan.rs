//! Rolls at block starts, added up ring by ring.

use texere_core::{BLOCK_RINGS, PaddedPoints, Plan, Turn};

use crate::rolls::Rolls;

pub(super) fn scan(plan: &Plan, points: &PaddedPoints) -> Rolls {
    let mut rolls = Rolls::default();
    for yarn in 0..plan.layout().yarns().len() {
        let (padded, rings, closed) = (points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
        let twist = plan.twist_turns(yarn);
        let at = |ring| plan.sampling().sample(padded, ring, rings, closed);

        let mut roll = Turn::ZERO;
        let mut here = at(0);
        for ring in 0..rings {
            if ring % BLOCK_RINGS == 0 {
                rolls.at_block.push(roll);
            }
            if ring + 1 < rings {
                let next = at(ring + 1);
                let chord = here.chord_to(&next);
                roll =
                    roll + plan.settings().frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
                here = next;
            }
        }
        rolls.whole.push(roll);
    }
    rolls
}
