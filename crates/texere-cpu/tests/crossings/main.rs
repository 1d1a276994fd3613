//! Crossings at rest: cloths at setts that mills weave, the energy against an independent oracle,
//! and both backends against one another.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod cloths;
mod measure;
mod oracle;
mod seen;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::NullBackend;
use texere_core::crossings::{
    CrossingState, CrossingThread, Crossings, CrossingsPass, CrossingsPlan, CrossingsRest, Level, Set,
    StraightPassage, settle,
};
use texere_core::{Backend, BackendError, CrossingsError};
use texere_cpu::{ParallelBackend, SerialBackend};

use cloths::{Cloth, cloths};

fn rest(backend: &dyn Backend, problem: &Crossings) -> (CrossingsPlan, Vec<CrossingState>, CrossingsRest) {
    let plan = Arc::new(CrossingsPlan::new(problem).unwrap());
    let mut settler = backend.crossings_settler(Arc::clone(&plan)).unwrap();
    let rest = settle(&plan, &mut *settler, |_, _| ControlFlow::Continue(())).unwrap();
    let mut crossings = vec![CrossingState::default(); plan.crossings()];
    settler.read(&mut crossings).unwrap();
    ((*plan).clone(), crossings, rest)
}

/// A pseudo-random number between -1 and 1.
fn chance(seed: &mut u64) -> f32 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    ((*seed >> 40) as f32 / (1_u64 << 23) as f32) - 1.0
}

/// A cloth of uneven threads in an irregular drawdown.
fn uneven(ends: usize, picks: usize, repeats: bool) -> Crossings {
    let mut seed = 7;
    let mut threads = |count: usize, pitch: f32| -> Vec<CrossingThread> {
        let thread = |_| CrossingThread {
            pitch: pitch * (1.0 + 0.2 * chance(&mut seed)),
            diameter: 0.3 * (1.0 + 0.3 * chance(&mut seed)),
            stiffness: 1.0 + 0.5 * chance(&mut seed),
            firmness: 1.0 + 0.5 * chance(&mut seed),
            flatness: 1.0 + 0.3 * chance(&mut seed),
            ..CrossingThread::new(0.0, 0.0)
        };
        (0..count).map(thread).collect()
    };
    let (warp, weft) = (threads(ends, 0.45), threads(picks, 0.5));
    let ups = (0..ends * picks).map(|_| chance(&mut seed) > 0.0).collect();
    Crossings::new(ups, warp, weft).repeats(repeats, repeats).tension(0.7, 1.4).press(2.0)
}

#[test]
fn cloths_of_the_mills_come_to_rest() {
    for Cloth { name, problem, tex, crimp, area, grams } in cloths() {
        let (plan, crossings, rest) = rest(&SerialBackend::new(), &problem);
        let found = measure::measures(&plan, &crossings, tex);
        println!(
            "{name:10} {:3} passes, step {:.0e}, clearance {:.3}, by outlines {:.3}, area {:.2} {:.2} ({:.2} {:.2}), crimp {:.1} {:.1} %, \
             ground {:.1} %, weft {:.0} %, {:.2} mm, {:.0} g/m2",
            rest.passes,
            rest.seen.step,
            rest.seen.clearance,
            found.clearance,
            found.area[0],
            found.area[1],
            found.least_area[0],
            found.least_area[1],
            found.crimp[0],
            found.crimp[1],
            found.ground,
            found.weft_on_face,
            found.thickness,
            found.weight,
        );
        assert!(rest.seen.step < 1e-2, "{name} still moves by {}", rest.seen.step);
        assert!(rest.seen.clearance > 0.995, "{name}: {}", rest.seen.clearance);
        assert!(found.clearance > 0.99, "{name}: {} by outlines", found.clearance);
        for set in 0..2 {
            assert!((found.crimp[set] - crimp[set]).abs() < 4.0, "{name}: crimp {:?}", found.crimp);
            assert!(found.area[set] > area[set], "{name}: area {:?}", found.area);
        }
        assert!(
            grams.is_none_or(|weight| (found.weight / weight - 1.0).abs() < 0.1),
            "{name}: {}",
            found.weight
        );
    }
}

/// A cloth of uneven threads. Its ends, its picks or both lie on two or three levels. In figured
/// cloth the levels change by place.
fn uneven_layers(
    [ends, picks]: [usize; 2],
    repeats: bool,
    [across, along]: [u32; 2],
    is_figured: bool,
) -> Crossings {
    let mut seed = 14;
    let mut threads = |count: usize, pitch: f32| -> Vec<CrossingThread> {
        let thread = |_| CrossingThread {
            pitch: pitch * (1.0 + 0.2 * chance(&mut seed)),
            diameter: 0.3 * (1.0 + 0.3 * chance(&mut seed)),
            stiffness: 1.0 + 0.5 * chance(&mut seed),
            ..CrossingThread::new(0.0, 0.0)
        };
        (0..count).map(thread).collect()
    };
    let (warp, weft) = (threads(ends, 0.34), threads(picks, 0.40));
    let levels = |end: usize, pick: usize| {
        let turned = u32::from(is_figured && (end >= ends / 2) != (pick >= picks / 2));
        [(end as u32 + turned) % across, (pick as u32 + turned) % along]
    };
    let level = |set: usize| {
        let level = |number: usize| {
            let [number, of] = [levels(number % ends, number / ends)[set], [across, along][set]];
            // In figured cloth of three levels, binders take the place of the lowest.
            let is_binder = is_figured && of == 3 && number == 0;
            if is_binder { Level::BINDER } else { Level { number: number as u8, of: of as u8 } }
        };
        (0..ends * picks).map(level).collect()
    };
    let mut up = |end: usize, pick: usize| {
        let levels = levels(end, pick);
        if across == along && levels[0] != levels[1] {
            levels[0] > levels[1]
        } else {
            chance(&mut seed) > 0.0
        }
    };
    let ups = (0..ends * picks).map(|number| up(number % ends, number / ends)).collect();
    Crossings::new(ups, warp, weft).levels(level(0), level(1)).repeats(repeats, repeats)
}

#[test]
fn gradients_are_the_energys() {
    let layers = [[1, 2], [2, 2], [3, 1], [3, 3]];
    // Each pair of levels is tried as a repeat, as a piece with open edges, and as a repeat whose
    // levels change by place.
    let kinds = [[true, false], [false, false], [true, true]];
    let layered = layers.into_iter().flat_map(|levels| kinds.map(|kind| (levels, kind)));
    let held = (uneven(5, 6, true).held(), [1.0, 2.4], 0..5, true);
    let single = [true, false].map(|repeats| (uneven(5, 6, repeats), [1.0, 2.4], 0..5, false));
    let problems = single.into_iter().chain([held]).chain(layered.map(|(levels, [repeats, is_figured])| {
        let both = levels[0] == levels[1];
        let problem = uneven_layers([6, 6], repeats, levels, is_figured);
        (problem, [0.2, 1.9], if both { 5..8 } else { 6..8 }, false)
    }));
    for (problem, shape, wanted, is_held) in problems {
        let plan = CrossingsPlan::new(&problem).unwrap();
        let mut seed = 5;
        // Thick threads near one another, so that all kinds of contact occur.
        let crossings: Vec<CrossingState> = plan
            .start()
            .unwrap()
            .iter()
            .map(|crossing| oracle::stirred(crossing, shape, &mut seed))
            .collect();
        let pass = CrossingsPass { penalty: 40.0, area: 0.8 };
        let mut kinds = [0; oracle::KINDS];
        for number in 0..plan.crossings() {
            let block = plan.block(&pass, &crossings, plan.site(number));
            let expected = oracle::gradient(&plan, &pass, &crossings, number, &mut kinds);
            let size = expected.iter().fold(1.0, |size: f64, slope| size.max(slope.abs()));
            let step = block.step();
            for (unknown, (found, expected)) in block.gradient.iter().zip(expected).enumerate() {
                if unknown % 4 == 0 && is_held {
                    // A held thread is no unknown, whatever pushes it.
                    assert!(*found == 0.0 && step[unknown] == 0.0, "crossing {number}: {found}");
                    continue;
                }
                let off = (2.0 * f64::from(*found) - expected).abs() / size;
                assert!(off < 2e-4, "crossing {number}, unknown {unknown}: {found} twice, not {expected}");
            }
        }
        assert!(kinds[wanted].iter().all(|&count| count > 0), "no contact of some kind: {kinds:?}");
    }
}

#[test]
fn energy_goes_down_while_penalties_stay() {
    for problem in [uneven(8, 6, true), uneven(8, 6, true).held()] {
        let plan = CrossingsPlan::new(&problem).unwrap();
        let pass = CrossingsPass::of(60);
        let mut crossings = rest(&SerialBackend::new(), &problem.passes(61)).1;
        let mut before = oracle::energy(&plan, &pass, &crossings, &mut [0; oracle::KINDS]);
        let first = before;
        for _ in 0..40 {
            let step = |number| {
                let site = plan.site(number);
                plan.moved(&crossings[number], &plan.block(&pass, &crossings, site), site)
            };
            crossings = (0..plan.crossings()).map(step).collect();
            let energy = oracle::energy(&plan, &pass, &crossings, &mut [0; oracle::KINDS]);
            assert!(energy < before * 1.02, "{energy} after {before}");
            before = energy;
        }
        assert!(before < first);
    }
}

/// At rest, the energy of held threads can't be less in any unknown but their shifts, which are 0.
#[test]
fn held_threads_rest_where_their_energy_is_least() {
    let problem = uneven(8, 6, true).held().passes(3000);
    let (plan, crossings, rest) = rest(&SerialBackend::new(), &problem);
    assert!(rest.at_rest, "{rest:?}");
    let pass = CrossingsPass::of(rest.passes - 1);
    for number in 0..plan.crossings() {
        let lies = Set::BOTH.map(|set| *crossings[number].thread(set));
        assert!(lies.iter().all(|lie| lie.shift == 0.0), "{lies:?}");
        let slopes = oracle::gradient(&plan, &pass, &crossings, number, &mut [0; oracle::KINDS]);
        let [warp, weft] = [&slopes[1..4], &slopes[5..8]];
        println!("{number}: {slopes:.3?}");
        for slope in warp.iter().chain(weft) {
            assert!(slope.abs() < 0.05, "crossing {number}: {slopes:?}");
        }
    }
}

#[test]
fn balanced_plain_weave_is_alike_both_ways() {
    for pitch in [0.36, 0.4, 0.5] {
        let thread = CrossingThread::new(pitch, 0.2);
        let problem = Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]);
        let (_, crossings, rest) = rest(&SerialBackend::new(), &problem);
        assert!(rest.at_rest, "{rest:?}");
        let [up, down] = [crossings[0], crossings[1]];
        // The cloth looks the same after it is turned over and then turned by a right angle. Half a
        // repeat away, the cloth is upside down. The weft is tauter by 0.4 %.
        for (one, other, sign) in [
            (up.warp, up.weft, -1.0),
            (up.warp, down.weft, 1.0),
            (up.warp, down.warp, -1.0),
            (up.warp, crossings[3].warp, 1.0),
        ] {
            assert!((one.height - sign * other.height).abs() < 1e-3, "{pitch}: {one:?}, {other:?}");
            assert!((one.half_width - other.half_width).abs() < 1e-3, "{pitch}: {one:?}, {other:?}");
            assert!((one.half_height - other.half_height).abs() < 1e-3, "{pitch}: {one:?}, {other:?}");
            assert!(one.shift.abs() < 1e-3, "{pitch}: {one:?}");
        }
    }
}

#[test]
fn far_from_its_edges_a_piece_rests_as_a_repeat() {
    let (warp, weft) = (CrossingThread::new(0.2, 0.15), CrossingThread::new(0.3, 0.15));
    let piece = |ends: usize, picks: usize| {
        let ups = (0..ends * picks).map(|number| (number % ends + number / ends).is_multiple_of(2));
        Crossings::new(ups.collect(), vec![warp; ends], vec![weft; picks])
    };
    let (_, repeat, _) = rest(&SerialBackend::new(), &piece(2, 2));
    let (_, open, found) = rest(&SerialBackend::new(), &piece(24, 20).repeats(false, false));
    assert!(found.seen.clearance > 0.995 && found.seen.step < 1e-3, "{found:?}");
    let (middle, repeat) = (open[10 * 24 + 12], repeat[0]);
    for set in Set::BOTH {
        let (middle, repeat) = (middle.thread(set), repeat.thread(set));
        assert!((middle.height - repeat.height).abs() < 0.02, "{middle:?}, not {repeat:?}");
        assert!((middle.half_width - repeat.half_width).abs() < 0.02, "{middle:?}, not {repeat:?}");
        assert!((middle.half_height - repeat.half_height).abs() < 0.02, "{middle:?}, not {repeat:?}");
    }
    // Nothing holds the outermost threads, which give way. From the fourth thread on none gives
    // way by more than 0.03.
    for end in 3..21 {
        assert!(open[10 * 24 + end].warp.shift.abs() < 0.03, "end {end}: {:?}", open[10 * 24 + end]);
    }
    let outwards = [open[10 * 24].warp.shift, -open[10 * 24 + 23].warp.shift];
    assert!(outwards.iter().all(|shift| *shift < 0.0), "{outwards:?}");
}

#[test]
fn mirrored_cloth_rests_mirrored() {
    let [ends, picks] = [6, 4];
    let problem = |mirrored: bool| {
        let up = |pick: usize, end: usize| (3 * end + pick) % 5 < 3;
        let ups = (0..ends * picks).map(|number| {
            let (pick, end) = (number / ends, number % ends);
            up(pick, if mirrored { ends - 1 - end } else { end })
        });
        let thread = CrossingThread::new(0.4, 0.25);
        Crossings::new(ups.collect(), vec![thread; ends], vec![thread; picks]).repeats(true, false).passes(30)
    };
    let one = rest(&SerialBackend::new(), &problem(false)).1;
    let other = rest(&SerialBackend::new(), &problem(true)).1;
    for pick in 0..picks {
        for end in 0..ends {
            let (one, other) = (one[pick * ends + end], other[pick * ends + ends - 1 - end]);
            assert!((one.warp.height - other.warp.height).abs() < 1e-3, "{one:?}, {other:?}");
            assert!((one.warp.shift + other.warp.shift).abs() < 1e-3, "{one:?}, {other:?}");
            assert!((one.weft.half_width - other.weft.half_width).abs() < 1e-3, "{one:?}, {other:?}");
        }
    }
}

#[test]
fn all_cores_give_the_bits_of_one() {
    for repeats in [true, false] {
        let problem = uneven(37, 29, repeats).passes(130);
        let one = rest(&SerialBackend::new(), &problem);
        let all = rest(&ParallelBackend::open().unwrap(), &problem);
        assert_eq!(bytemuck::cast_slice::<_, u32>(&one.1), bytemuck::cast_slice::<_, u32>(&all.1));
        assert_eq!(one.2, all.2);
    }
}

#[test]
fn round_threads_jam_where_peirce_says() {
    // Between circles the best slope is at right angles to the line between their middles. The room
    // is then the distance of the middles, whose square is across² + rise², less all three radii.
    let mut seed = 14;
    for _ in 0..200 {
        let mut some = |low: f32, high: f32| low + (high - low) * f32::midpoint(1.0, chance(&mut seed));
        let (across, rise, radii, thread) =
            (some(0.4, 3.0), some(0.01, 2.0), [some(0.2, 1.0), some(0.2, 1.0)], some(0.2, 2.0));
        let passage = StraightPassage::new(across, rise, radii.map(|radius| [radius; 2]), thread);
        let room = across.hypot(rise) - radii[0] - radii[1] - thread;
        assert!((passage.room - room).abs() < 1e-5, "{passage:?}, not {room}");
    }
}

#[test]
fn a_passage_takes_the_best_slope() {
    let mut seed = 5;
    for _ in 0..2000 {
        let mut some = |low: f32, high: f32| low + (high - low) * f32::midpoint(1.0, chance(&mut seed));
        let halves = [[some(0.3, 1.2), some(0.2, 0.8)], [some(0.3, 1.2), some(0.2, 0.8)]];
        // Neighbours overlap by at most 5 % of the sum of their half widths.
        let across = (halves[0][0] + halves[1][0]) * some(0.95, 3.0);
        let rise = some(-0.5, 2.0);
        let found = StraightPassage::new(across, rise, halves, 0.7).room;
        let best = oracle::room(across.into(), rise.into(), halves.map(|half| half.map(f64::from)), 0.7).0;
        assert!(
            f64::from(found) < best + 1e-5 && f64::from(found) > best - 2e-3,
            "{found}, not {best}: {across} {rise} {halves:?}"
        );
    }
}

#[test]
fn what_is_wrong_is_named() {
    let thread = CrossingThread::new(0.4, 0.2);
    let plan = |problem: &Crossings| CrossingsPlan::new(problem).map(|_| ());
    let plain = || Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]);
    let few = Crossings::new(vec![true; 2], vec![thread; 2], vec![thread; 1]);
    assert_eq!(plan(&few), Err(CrossingsError::TooFew { what: "pick", count: 1, least: 2 }));
    let short = Crossings::new(vec![true; 3], vec![thread; 2], vec![thread; 2]);
    assert_eq!(plan(&short), Err(CrossingsError::Drawdown { ups: 3, ends: 2, picks: 2 }));
    for wrong in [f32::NAN, f32::INFINITY, -1.0, 0.0] {
        for of in [
            CrossingThread { pitch: wrong, ..thread },
            CrossingThread { diameter: wrong, ..thread },
            CrossingThread { stiffness: wrong, ..thread },
            CrossingThread { firmness: wrong, ..thread },
            CrossingThread { flatness: wrong, ..thread },
        ] {
            let problem = Crossings::new(vec![true; 4], vec![thread, of], vec![thread; 2]);
            let found = plan(&problem).unwrap_err();
            assert!(matches!(found, CrossingsError::Thread { set: "warp", thread: 1, .. }), "{found:?}");
        }
    }
    for problem in
        [plain().tension(-1.0, 1.0), plain().tension(1.0, f32::NAN), plain().press(11.0), plain().passes(0)]
    {
        assert!(matches!(plan(&problem), Err(CrossingsError::Setting { .. })));
    }
    let single = vec![Level::SINGLE; 4];
    let short = plan(&plain().levels(single.clone(), single[..3].to_vec())).unwrap_err();
    assert_eq!(short, CrossingsError::Levels { set: "weft", levels: 3, crossings: 4 });
    for (number, of) in [(1, 1), (0, 9), (1, 0)] {
        let mut levels = single.clone();
        levels[1] = Level { number, of };
        let wrong = plan(&plain().levels(levels, single.clone())).unwrap_err();
        let expected = CrossingsError::Level { set: "warp", end: 1, pick: 0, number, of, most: 8 };
        assert_eq!(wrong, expected, "{wrong}");
    }
    let null = NullBackend::default().crossings_settler(Arc::new(CrossingsPlan::new(&plain()).unwrap()));
    assert!(matches!(null, Err(BackendError::NoCrossings { .. })));
}

#[test]
fn nothing_flies_apart_whatever_the_sett() {
    // These setts are far denser or more open than any loom's. The result stays finite, and its
    // clearance says how much room is lacking.
    for pitch in [0.06, 0.1, 5.0] {
        let thread = CrossingThread::new(pitch, 0.2);
        let problem =
            Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]).passes(200);
        let (_, crossings, rest) = rest(&SerialBackend::new(), &problem);
        let values = bytemuck::cast_slice::<_, f32>(&crossings);
        assert!(values.iter().all(|value| value.is_finite()) && rest.seen.clearance.is_finite());
        assert_eq!(rest.seen.clearance < 0.99, pitch < 0.2, "{pitch}: {rest:?}");
    }
    assert_eq!(Set::Warp.other().other(), Set::Warp);
}
