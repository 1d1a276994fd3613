//! One repeat of a cloth has the same measures as many repeats.

use std::ops::ControlFlow;

use proptest::prelude::*;
use texere_core::crossings::Set;
use texere_core::{Material, Section};
use texere_cpu::ParallelBackend;
use texere_fabric::warp::{Bar, Chain, WarpKnitted};
use texere_fabric::weft::{
    Beds, CarrierSet, Chart, Direction, Gauge, Instruction, KnitYarn, Knitted, Machine, Needle, Operation,
    Program,
};
use texere_fabric::{BySet, Drawdown, Finish, Measures, Structure, Thread, Weave, Woven};

fn materials() -> Vec<Material> {
    [20.0, 30.0].map(|tex| Material { tex: Some(tex), ..Material::default() }).to_vec()
}

/// Cloth of a weave. Its ends take the given spacings and materials in turn. Its picks lie 1 mm
/// apart and have material 0.
fn woven(notation: &str, size: [usize; 2], spacing: &[f64], materials_of: &[u32]) -> Woven {
    let thread = |number: usize| Thread {
        material: materials_of[number % materials_of.len()],
        ..Thread::new(spacing[number % spacing.len()], 0.1)
    };
    let drawdown = Weave::parse(notation).unwrap().drawdown(size[0], size[1]).unwrap();
    let warp = (0..size[0]).map(thread).collect();
    Woven::new(drawdown, warp, vec![Thread::new(1.0, 0.1); size[1]], materials(), vec![Section::Circle])
        .unwrap()
}

fn close(one: f64, other: f64, within: f64) -> bool {
    (one / other - 1.0).abs() < within
}

/// Weight, 1 + crimp of warp and weft, 1 + cover, and ends and picks per cm.
fn numbers(cloth: &Woven, measures: &Measures) -> [f64; 6] {
    let BySet { warp, weft } = measures.crimp.unwrap();
    let BySet { warp: ends, weft: picks } = cloth.setts().map(|sett| sett.per_cm);
    [measures.areal_weight.unwrap(), 1.0 + warp, 1.0 + weft, 1.0 + measures.cover.unwrap().cloth, ends, picks]
}

#[test]
fn two_ends_of_an_uneven_sett_have_the_numbers_of_two_hundred() {
    let [one, many] = [2, 200].map(|size| {
        let cloth = woven("plain", [size; 2], &[0.9, 0.3], &[1]);
        let [width, height] = cloth.size_mm();
        assert!(close(width, 0.6 * size as f64, 1e-9) && close(height, size as f64, 1e-9));
        numbers(&cloth, &Measures::new(&cloth, &cloth.yarns().unwrap()).unwrap())
    });
    assert!(close(one[4], 10.0 / 0.6, 1e-9), "{one:?}");
    assert!(one.iter().zip(many).all(|(one, many)| close(*one, many, 2e-4)), "{one:?} {many:?}");
}

/// A small cloth is measured between copies of itself. The copies are drawn with the tension of its
/// yarns.
#[test]
fn a_small_cloth_has_the_crimp_of_a_large_one_at_any_tension() {
    let crimp = |size: usize, tension: f32| {
        let cloth = woven("2/2", [size; 2], &[0.8], &[1]);
        let yarns = cloth.yarns().unwrap().with_tension(tension).unwrap();
        Measures::new(&cloth, &yarns).unwrap().crimp.unwrap()
    };
    for tension in [0.0, 0.3, 0.9] {
        let (small, large) = (crimp(4, tension), crimp(200, tension));
        assert!(Set::BOTH.into_iter().all(|set| close(small[set], large[set], 1e-2)), "{small:?} {large:?}");
    }
    assert!(!close(crimp(4, 0.0).warp, crimp(4, 0.9).warp, 1e-1));
}

#[test]
fn straight_threads_weigh_what_they_are() {
    // All ends lie on the face: 20 ends of 30 tex and 10 picks of 20 tex per cm, without crimp.
    for size in [1, 2, 3, 7] {
        let mut cloth = woven("plain", [size; 2], &[0.5], &[1]);
        let drawdown = Drawdown::from_fn(size, size, |_, _| true).unwrap();
        let (warp, weft) = (cloth.warp().to_vec(), cloth.weft().to_vec());
        cloth = Woven::new(drawdown, warp, weft, materials(), vec![Section::Circle]).unwrap();
        let measures = Measures::new(&cloth, &cloth.yarns().unwrap()).unwrap();
        let by_hand = 0.1 * (20.0 * 30.0 + 10.0 * 20.0);
        assert!(close(measures.areal_weight.unwrap(), by_hand, 1e-6), "{:?}", measures.areal_weight);
    }
}

#[test]
fn a_pattern_of_thick_and_thin_counts_by_whole_repeats() {
    // Ends of 20 and 30 tex alternate. Three ends are one repeat and a thread.
    let [one, more] = [2, 3].map(|ends| {
        let cloth = woven("plain", [ends, 4], &[0.8], &[0, 1]);
        Measures::new(&cloth, &cloth.yarns().unwrap()).unwrap().areal_weight.unwrap()
    });
    let by_hand = |crimped: f64| 0.1 * (12.5 * 25.0 + 10.0 * 20.0) * crimped;
    assert!((by_hand(1.0)..by_hand(1.15)).contains(&one), "{one}");
    assert!(close(one, more, 1e-5), "{one} {more}");
}

/// Straight ends, 2 per mm, below straight picks of 20 tex, 1 per mm. The ends take the yarns of
/// `order` in turn.
fn straight(tex: &[f32], order: &[u32], ends: usize) -> Measures {
    let materials = [20.0].iter().chain(tex).map(|tex| Material { tex: Some(*tex), ..Material::default() });
    let warp =
        (0..ends).map(|end| Thread { material: 1 + order[end % order.len()], ..Thread::new(0.5, 0.1) });
    let cloth = Woven::new(
        Drawdown::new(ends, 4).unwrap(),
        warp.collect(),
        vec![Thread::new(1.0, 0.1); 4],
        materials.collect(),
        vec![Section::Circle],
    )
    .unwrap();
    Measures::new(&cloth, &cloth.yarns().unwrap()).unwrap()
}

#[test]
fn yarns_that_repeat_over_more_threads_than_the_weave_count_by_their_own_repeat() {
    // Each case has the mean tex of the ends and the cover factor of the warp. Peirce's cover
    // factor is ends to the inch over √Ne, with Ne = 590.5 / tex; 2 ends to the mm are 50.8 to the
    // inch.
    let factor = |tex: f64| 50.8 * (tex / 590.5).sqrt();
    let orders: [(&[u32], f64, f64); 3] = [
        (&[0, 1, 2], 40.0, (factor(10.0) + factor(30.0) + factor(80.0)) / 3.0),
        (&[0, 0, 0, 2], 27.5, factor(10.0) * 0.75 + factor(80.0) * 0.25),
        (&[0, 0, 0, 0, 0, 1, 2], 160.0 / 7.0, (factor(10.0) * 5.0 + factor(30.0) + factor(80.0)) / 7.0),
    ];
    for (order, tex, factor) in orders {
        for ends in [order.len(), 2 * order.len(), 2 * order.len() + 1, 3 * order.len()] {
            let measures = straight(&[10.0, 30.0, 80.0], order, ends);
            let weight = measures.areal_weight.unwrap();
            assert!(close(weight, 2.0 * tex + 20.0, 1e-6), "{order:?} on {ends} ends: {weight}");
            let found = measures.cover.unwrap().factor.unwrap().warp;
            assert!(close(found, factor, 1e-3), "{order:?} on {ends} ends: {found} for {factor}");
        }
    }
}

#[test]
fn flat_threads_among_round_ones_are_part_of_the_repeat() {
    // All threads have one radius. Every third one is three times as wide as high, so that it rises
    // less than the others, and threads that cross it rise less.
    let cloth = |size: usize| {
        let thread = |number: usize| Thread {
            flatness: if number.is_multiple_of(3) { 3.0 } else { 1.0 },
            ..Thread::new(0.8, 0.1)
        };
        let threads: Vec<_> = (0..size).map(thread).collect();
        let drawdown = Weave::parse("plain").unwrap().drawdown(size, size).unwrap();
        Woven::new(drawdown, threads.clone(), threads, materials(), vec![Section::Circle]).unwrap()
    };
    let [one, many] = [cloth(6), cloth(36)]
        .map(|cloth| numbers(&cloth, &Measures::new(&cloth, &cloth.yarns().unwrap()).unwrap()));
    assert!(one.iter().zip(many).all(|(one, many)| close(*one, many, 2e-4)), "{one:?} {many:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 24, ..ProptestConfig::default() })]
    #[test]
    fn yarns_of_one_repeat_have_the_weight_of_many(
        notation in prop::sample::select(vec!["plain", "2/1", "2/2", "satin 5"]),
        yarns in prop::sample::subsequence(vec![0, 1, 2, 3, 4, 5], 2..6).prop_shuffle(),
        times in [1_usize..4, 1..4],
    ) {
        let tex: Vec<_> = [10.0, 15.0, 30.0, 45.0, 80.0, 200.0].iter()
            .map(|tex| Material { tex: Some(*tex), ..Material::default() }).collect();
        let repeat = Weave::parse(notation).unwrap().repeat().0 * yarns.len();
        let cloth = |size: [usize; 2]| {
            let thread = |number: usize| Thread { material: yarns[number % yarns.len()], ..Thread::new(0.8, 0.1) };
            let drawdown = Weave::parse(notation).unwrap().drawdown(size[0], size[1]).unwrap();
            let [warp, weft] = size.map(|size| (0..size).map(thread).collect());
            Woven::new(drawdown, warp, weft, tex.clone(), vec![Section::Circle]).unwrap()
        };
        // The second cloth may have one or two threads more than whole repeats.
        let [one, many] = [[repeat; 2], times.map(|times| times * repeat + times - 1)].map(cloth).map(|cloth| {
            Measures::new(&cloth, &cloth.yarns().unwrap()).unwrap().areal_weight.unwrap()
        });
        prop_assert!(close(one, many, 2e-4), "{} {}", one, many);
    }

    #[test]
    fn a_weave_of_one_repeat_has_the_numbers_of_many(
        notation in prop::sample::select(vec!["plain", "2/1", "2/2", "3/1", "satin 5"]),
        spacing in 0.5..1.0_f64,
        second in 0_u32..2,
        times in [1_usize..4, 1..4],
    ) {
        let repeat = Weave::parse(notation).unwrap().repeat();
        let repeat = if repeat.0 == 2 { 2 } else { 2 * repeat.0 };
        let (spacing, materials) = ([spacing], [0, second]);
        let one = woven(notation, [repeat; 2], &spacing, &materials);
        let many = woven(notation, times.map(|times| times * repeat), &spacing, &materials);
        let [first, second] = [&one, &many].map(|cloth| {
            numbers(cloth, &Measures::new(cloth, &cloth.yarns().unwrap()).unwrap())
        });
        for (one, many) in first.iter().zip(second) {
            prop_assert!(close(*one, many, 2e-4), "{:?} {:?}", first, second);
        }
    }
}

#[test]
fn woven_cloth_at_rest_has_the_same_numbers_small_and_large() {
    let device = ParallelBackend::open().unwrap();
    let measured = |size| {
        let cloth = woven("2/2", [size; 2], &[0.5], &[1]);
        let rest = cloth.at_rest(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(())).unwrap();
        numbers(&cloth, &Measures::new(&cloth, &rest.yarns).unwrap())
    };
    let [one, many] = [measured(4), measured(24)];
    assert!(one.iter().zip(many).all(|(one, many)| close(*one, many, 2e-3)), "{one:?} {many:?}");
}

fn jersey(size: u32) -> Structure {
    let stitches =
        Machine::default().knit(&Chart::parse("k", Beds::One).unwrap().program().unwrap()).unwrap();
    let (yarns, sections) = (vec![KnitYarn::new(0.09)], vec![Section::Circle]);
    let gauge = Gauge::munden(3.5);
    Structure::Weft(Knitted::new(stitches.stitches, gauge, yarns, materials(), sections, [size; 2]).unwrap())
}

fn locknit(size: u32) -> Structure {
    let bars = ["1-0/2-3//", "1-2/1-0//"].map(|chain| Bar::new(Chain::parse(chain, 1).unwrap())).to_vec();
    let (yarns, sections) = (vec![KnitYarn::new(0.05)], vec![Section::Circle]);
    let gauge = Gauge::new(1.0, 0.75);
    Structure::Warp(WarpKnitted::new(bars, gauge, 4, 4, yarns, materials(), sections, [size; 2]).unwrap())
}

#[test]
fn knits_have_the_same_numbers_small_and_large() {
    let device = ParallelBackend::open().unwrap();
    for (small, large) in [(jersey(4), jersey(16)), (locknit(1), locknit(3))] {
        let [one, many] = [small, large].map(|structure| {
            let settled =
                structure.settle(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(())).unwrap();
            [structure.yarns().unwrap(), settled.into_yarns()].map(|yarns| {
                let measures = structure.measures(&yarns).unwrap();
                let knit = measures.knit.unwrap();
                [
                    knit.loop_length_mm,
                    measures.areal_weight.unwrap(),
                    knit.tightness.unwrap(),
                    measures.thickness_mm,
                ]
            })
        });
        let pairs = one.iter().flatten().zip(many.iter().flatten());
        assert!(pairs.into_iter().all(|(one, many)| close(*one, *many, 1e-4)), "{one:?} {many:?}");
    }
}

#[test]
fn yarns_of_few_points_a_repeat_have_the_same_numbers_small_and_large() {
    // An inlay has two points a course. Its repeat has fewer points than the yarn has beyond the
    // cloth.
    let net = |copies: [u32; 2]| {
        let bars = ["1-0/0-1//", "0-0/1-1//", "0-0//"]
            .map(|chain| Bar::new(Chain::parse(chain, 1).unwrap()))
            .to_vec();
        let (yarns, sections) = (vec![KnitYarn::new(0.05)], vec![Section::Circle]);
        let gauge = Gauge::new(1.0, 0.75);
        let knit = WarpKnitted::new(bars, gauge, 1, 2, yarns, materials(), sections, copies).unwrap();
        let yarns = knit.yarns().unwrap();
        let run_ins: Vec<_> = knit.run_ins(&yarns).iter().map(|bar| bar.reached_mm).collect();
        let measures = knit.measures(&yarns);
        (run_ins, measures.areal_weight.unwrap())
    };
    let (one, many) = (net([1, 1]), net([6, 6]));
    assert!(close(one.1, many.1, 1e-4), "{one:?} {many:?}");
    assert!(one.0.iter().zip(&many.0).all(|(one, many)| close(*one, *many, 1e-4)), "{one:?} {many:?}");
}

#[test]
fn stripes_of_a_knit_count_by_their_own_courses() {
    // Two courses of 20 tex and one of 30 tex. The loops are alike, so that together they weigh as
    // much as loops of the mean, 70/3 tex.
    let knit = |yarns: Vec<u32>, copies: [u32; 2]| {
        let chart = Chart::parse("k", Beds::One).unwrap().with_yarns(&yarns).unwrap();
        let program = chart.program().unwrap();
        let stitches = Machine::default().knit(&program).unwrap().stitches;
        let yarns = [0, 1].map(|material| KnitYarn { material, ..KnitYarn::new(0.09) }).to_vec();
        let (gauge, sections) = (Gauge::munden(3.5), vec![Section::Circle]);
        let yarns = yarns[..program.carriers.len().min(2)].to_vec();
        let knit = Knitted::new(stitches, gauge, yarns, materials(), sections, copies).unwrap();
        knit.measures(&knit.yarns().unwrap()).unwrap()
    };
    let plain = knit(vec![0], [6, 6]);
    for copies in [[1, 1], [2, 3], [7, 5]] {
        let striped = knit(vec![0, 0, 1], copies);
        let by_hand = plain.areal_weight.unwrap() * (70.0 / 60.0);
        assert!(close(striped.areal_weight.unwrap(), by_hand, 1e-4), "{copies:?}: {striped:?} {by_hand}");
        assert!(close(striped.length_mm[0], 2.0 * striped.length_mm[1], 1e-4), "{copies:?}: {striped:?}");
    }
}

#[test]
fn a_jersey_has_the_loops_that_were_asked_for() {
    let structure = jersey(4);
    let settled = structure
        .settle(&Finish::default(), 0.0, &ParallelBackend::open().unwrap(), |_| ControlFlow::Continue(()))
        .unwrap();
    let measures = structure.measures(settled.yarns()).unwrap();
    let knit = measures.knit.unwrap();
    assert!(close(knit.loop_length_mm, 3.5, 0.01), "{}", knit.loop_length_mm);
    // Tightness is √tex over the loop length in cm. Weight is loops to the m² times their length
    // times tex.
    assert!(close(knit.tightness.unwrap(), 20_f64.sqrt() / (0.1 * knit.loop_length_mm), 1e-9));
    let per_m2 = 1e6 / (3.5 / 4.2 * 3.5 / 5.5);
    assert!(close(measures.areal_weight.unwrap(), per_m2 * knit.loop_length_mm * 20e-6, 1e-9));
}

#[test]
fn half_a_needle_of_rack_is_no_wale() {
    let operation = |instruction| Operation { instruction, carriers: CarrierSet(1), source: 0 };
    let mut operations = vec![operation(Instruction::In), operation(Instruction::Rack(0.5))];
    for _ in 0..2 {
        for needle in 0..8 {
            for needle in [Needle::front(needle), Needle::back(needle)] {
                operations.push(operation(Instruction::Knit(Direction::Right, needle)));
            }
        }
    }
    let program =
        Program { carriers: vec!["1".into()], carrier_sets: vec![vec![], vec![0]], operations, repeat: None };
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let (yarns, sections) = (vec![KnitYarn::new(0.09)], vec![Section::Circle]);
    let knit = Knitted::new(stitches, Gauge::new(1.0, 0.75), yarns, materials(), sections, [1, 1]).unwrap();
    assert_eq!(knit.size()[0], 8);
}
