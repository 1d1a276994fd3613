//! The least clearance that a pass reports, against all clearances of a cloth.

use texere_core::crossings::{
    CrossingState, CrossingThread, Crossings, CrossingsPass, CrossingsPlan, Set, StraightPassage,
};

use crate::chance;
use crate::measure::further;

/// The clearances of plain weave, kind by kind: of crossings, passages, neighbours at crossings,
/// and neighbours half way.
fn clearances(plan: &CrossingsPlan, all: &[CrossingState]) -> [f32; 4] {
    let mut least = [f32::INFINITY; 4];
    for number in 0..all.len() {
        for set in Set::BOTH {
            let (site, crossed) = (plan.site(number), set.other());
            let [here, next, beside, opposite] = [[0, 0], [1, 0], [0, 1], [1, 1]]
                .map(|[along, across]| all[plan.number(further(plan, site, set, along, across))]);
            let side = plan.side(site, set);
            let (own, over, last) = (here.thread(set), here.thread(crossed), next.thread(crossed));
            let contact = side * (own.height - over.height) / (own.half_height + over.half_height);

            let gap = |set: Set| plan.rows(set)[site.thread(set)].gap;
            let halves = [over, last].map(|thread| [thread.half_width, thread.half_height]);
            let passage = StraightPassage::new(
                gap(crossed) + last.shift - over.shift,
                side * (last.height - over.height),
                halves,
                own.half_height + next.thread(set).half_height,
            );

            let other = beside.thread(set);
            let neighbours = (gap(set) + other.shift - own.shift) / (own.half_width + other.half_width);

            let mean = |one: &CrossingState, two: &CrossingState| {
                let [one, two]: [[f32; 4]; 2] = [one, two].map(|at| bytemuck::cast(*at.thread(set)));
                [0, 1, 2, 3].map(|unknown| f32::midpoint(one[unknown], two[unknown]))
            };
            let (one, two) = (mean(&here, &next), mean(&beside, &opposite));
            let x = (gap(set) + two[0] - one[0]) / (one[2] + two[2]);
            let z = (two[1] - one[1]) / (one[3] + two[3]);

            let found = [contact, passage.clearance(), neighbours, x.hypot(z)];
            least = std::array::from_fn(|kind| least[kind].min(found[kind]));
        }
    }
    least
}

/// A pass leaves out contacts with room to spare. It must report the least clearance all the same,
/// whichever contact has it.
#[test]
fn the_least_clearance_is_seen() {
    let (mut seed, mut decided) = (21, [0; 4]);
    for _ in 0..400 {
        let mut some = |low: f32, high: f32| low + (high - low) * f32::midpoint(1.0, chance(&mut seed));
        let thread = CrossingThread::new(some(0.7, 2.5), 1.0);
        let ups = (0..16).map(|number| (number % 4 + number / 4) % 2 == 0).collect();
        let plan = CrossingsPlan::new(&Crossings::new(ups, vec![thread; 4], vec![thread; 4])).unwrap();
        let (high, wide, tall) = (some(0.3, 1.5), some(0.2, 0.8), some(0.2, 0.6));
        let mut lie = |side: f32| {
            let state = [some(-0.1, 0.1), side * high, wide, tall];
            [state[0], state[1] * some(0.9, 1.1), state[2] * some(0.9, 1.1), state[3] * some(0.9, 1.1)]
        };
        let all: Vec<CrossingState> = (0..16)
            .map(|number| {
                let side = plan.side(plan.site(number), Set::Warp);
                bytemuck::cast([lie(side), lie(-side)])
            })
            .collect();
        let expected = clearances(&plan, &all);
        let least = expected.into_iter().fold(f32::INFINITY, f32::min);
        decided[expected.iter().position(|clearance| *clearance == least).unwrap()] += 1;
        let pass = CrossingsPass::of(200);
        let blocks = (0..16).map(|number| plan.block(&pass, &all, plan.site(number)).clearance);
        let found = blocks.fold(f32::INFINITY, f32::min);
        assert!((found - least).abs() < 1e-5 * least.abs().max(1.0), "{found}, not {least}: {expected:?}");
    }
    // Half way, neighbours are no nearer than at one of the two crossings.
    assert!(decided[..3].iter().all(|times| *times > 5), "kinds that were least: {decided:?}");
}
