//! Pieces, loose yarns and empty needles of knits, against counts by hand and against loops that
//! are painted one by one.

use std::collections::BTreeSet;

use proptest::prelude::*;
use texere_core::{Material, Section};
use texere_fabric::warp::{Bar, Chain, LapKind, PlacedLap, Threading, WarpKnitted};
use texere_fabric::weft::{
    CarrierSet, Direction, Gauge, Instruction, KnitYarn, Knitted, Machine, Needle, Operation, Program,
};
use texere_fabric::{ClothFault, Drawdown, Pieces, Relief, Structure, Thread, Weave, Woven, WovenDesign};

fn bar(chain: &str, threading: &[bool]) -> Bar {
    let guides = threading.iter().map(|threaded| threaded.then_some(0)).collect();
    Bar { threading: Threading::of(guides), ..Bar::new(Chain::parse(chain, 1).unwrap()) }
}

fn warp(bars: Vec<Bar>, wales: u32, courses: u32, copies: [u32; 2]) -> WarpKnitted {
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let yarns = vec![KnitYarn::new(0.05)];
    WarpKnitted::new(bars, Gauge::new(1.0, 0.75), wales, courses, yarns, materials, sections, copies).unwrap()
}

const FULL: &[bool] = &[true];

fn found(bars: Vec<Bar>, wales: u32, courses: u32, copies: [u32; 2]) -> (u64, u64, Vec<u64>) {
    let pieces = warp(bars, wales, courses, copies).pieces();
    (pieces.count, pieces.loose, pieces.empty_listed)
}

#[test]
fn pillars_are_joined_by_what_crosses_them_alone() {
    let pillar = || bar("1-0/0-1//", FULL);
    assert_eq!(found(vec![pillar()], 4, 6, [1, 1]), (4, 0, vec![]));
    assert_eq!(found(vec![pillar()], 2, 2, [3, 5]), (6, 0, vec![]));
    assert_eq!(found(vec![bar("1-0/1-2//", FULL)], 4, 6, [1, 1]), (1, 0, vec![]));
    assert_eq!(found(vec![pillar(), bar("1-0/1-2//", FULL)], 4, 6, [1, 1]), (1, 0, vec![]));
    // If the inlay's bar lies behind the pillars' bar, the inlay passes behind the loops of pillars
    // and in front of the yarn between the loops, and is held. If its bar lies in front, the inlay
    // is not held.
    assert_eq!(found(vec![pillar(), bar("0-0/3-3//", FULL)], 4, 6, [1, 1]), (1, 0, vec![]));
    assert_eq!(found(vec![bar("0-0/3-3//", FULL), pillar()], 4, 6, [1, 1]), (8, 4, vec![]));
    // An inlay that stays in its space is held by underlaps that pass it, and joins no other yarns.
    assert_eq!(found(vec![bar("1-0/1-2//", FULL), bar("0-0//", FULL)], 4, 2, [1, 1]), (1, 0, vec![]));
    assert_eq!(found(vec![pillar(), bar("0-0//", FULL)], 4, 2, [1, 1]), (8, 4, vec![]));
}

#[test]
fn tricot_two_in_two_out_falls_apart_beside_empty_needles() {
    let threading = &[true, true, false, false];
    let design = || bar("1-0/1-2//", threading);
    assert_eq!(found(vec![design()], 8, 4, [1, 1]), (2, 0, vec![3, 7]));
    // Needles 1 and 5 each have loops of two guides.
    let opposite = bar("1-2/1-0//", threading);
    let (count, loose, empty) = found(vec![design(), opposite], 8, 4, [1, 1]);
    assert_eq!((count, loose, empty), (2, 0, vec![3, 7]));
}

#[test]
fn a_knit_is_told_as_woven_cloth_is() {
    let structure = Structure::Warp(warp(vec![bar("1-0/0-1//", FULL)], 4, 2, [1, 1]));
    let diagnosis = structure.diagnose(0.5, |_| std::ops::ControlFlow::Continue(())).unwrap();
    assert_eq!(diagnosis.faults.kinds().last(), Some(&ClothFault::FallsApart));
    let said = diagnosis.faults.apart.unwrap().to_string();
    assert!(
        said.contains("nothing binds all threads into one cloth: there are 4 pieces (guide bar 1, guide 1;"),
        "{said}"
    );

    // A double cloth, and a pick over which no end is lifted.
    let double = Drawdown::from_fn(8, 9, |end, pick| match (end % 2, pick % 2) {
        (_, _) if pick == 8 => false,
        (0, 0) | (1, 1) => (end / 2 + pick / 2) % 2 == 0,
        (face, _) => face == 0,
    });
    let threads = |count| vec![Thread::new(1.0, 0.1); count];
    let cloth =
        Woven::new(double.unwrap(), threads(8), threads(9), vec![Material::default()], vec![Section::Circle]);
    let structure = Structure::Woven(WovenDesign::new(cloth.unwrap(), None, Relief::Report).unwrap());
    let pieces = structure.pieces();
    assert_eq!((pieces.count, pieces.loose), (3, 1));
    assert_eq!(pieces.loose_listed, [texere_core::Origin::Pick(9)]);
    assert!(pieces.to_string().contains("from the face there are 3 layers (a loose pick, "), "{pieces}");
    assert!(!woven("2/2").pieces().falls_apart());
}

fn woven(notation: &str) -> Woven {
    let threads = vec![Thread::new(1.0, 0.1); 8];
    let drawdown = Weave::parse(notation).unwrap().drawdown(8, 8).unwrap();
    Woven::new(drawdown, threads.clone(), threads, vec![Material::default()], vec![Section::Circle]).unwrap()
}

/// The pieces of a knit of four courses, knitted to the right. `carriers` has the needles on which
/// each carrier knits.
fn knit(carriers: &[&[Needle]], repeat: Option<u32>, copies: [u32; 2]) -> Pieces {
    let mut operations = Vec::new();
    for (number, _) in carriers.iter().enumerate() {
        operations.push(Operation {
            instruction: Instruction::In,
            carriers: CarrierSet(number as u32 + 1),
            source: 0,
        });
    }
    for _ in 0..4 {
        for (number, needles) in carriers.iter().enumerate() {
            operations.extend(needles.iter().map(|needle| Operation {
                instruction: Instruction::Knit(Direction::Right, *needle),
                carriers: CarrierSet(number as u32 + 1),
                source: 0,
            }));
        }
    }
    if repeat.is_some() {
        operations.drain(..carriers.len());
    }
    let names = (1..=carriers.len()).map(|number| number.to_string()).collect();
    let sets = [vec![]].into_iter().chain((0..carriers.len() as u32).map(|own| vec![own])).collect();
    let program = Program { carriers: names, carrier_sets: sets, operations, repeat };
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let (yarns, materials) = (vec![KnitYarn::new(0.1); carriers.len()], vec![Material::default()]);
    let gauge = Gauge::new(1.0, 0.75);
    Knitted::new(stitches, gauge, yarns, materials, vec![Section::Circle], copies).unwrap().pieces()
}

#[test]
fn weft_knits_fall_into_what_no_loop_joins() {
    let [front, back] = [Needle::front, Needle::back];
    let said = |pieces: Pieces| (pieces.count, pieces.loose, pieces.empty_listed);
    // First two carriers knit side by side, with a needle between them on which neither knits. Then
    // they have one needle in common.
    assert_eq!(said(knit(&[&[front(0), front(1)], &[front(3), front(4)]], None, [1, 1])), (2, 0, vec![2]));
    assert_eq!(said(knit(&[&[front(0), front(1)], &[front(1), front(2)]], None, [1, 1])), (1, 0, vec![]));
    // Two carriers that each knit one side of a tube make two pieces. A rib by both is one cloth.
    let sides: [&[Needle]; 2] = [&[front(0), front(1)], &[back(0), back(1)]];
    assert_eq!(said(knit(&sides, None, [1, 1])), (2, 0, vec![]));
    assert_eq!(said(knit(&sides, Some(2), [3, 3])), (2, 0, vec![]));
    let both: [&[Needle]; 2] = [&[front(0), back(0)], &[front(0), back(0)]];
    assert_eq!(said(knit(&both, Some(1), [4, 4])), (1, 0, vec![]));
    // Interlock is two ribs whose yarns pass one another between the beds, and is one piece. Ribs
    // side by side are two pieces.
    let ribs: [&[Needle]; 2] = [&[front(0), back(1)], &[back(0), front(1)]];
    assert_eq!(said(knit(&ribs, Some(2), [3, 3])), (1, 0, vec![]));
    assert_eq!(said(knit(&ribs, None, [1, 1])), (1, 0, vec![]));
    let beside: [&[Needle]; 2] = [&[front(0), back(1)], &[front(2), back(3)]];
    assert_eq!(said(knit(&beside, None, [1, 1])), (2, 0, vec![]));
    // Several copies of a repeat in which every other needle knits.
    assert_eq!(said(knit(&[&[front(0), front(2)]], Some(4), [2, 2])), (1, 0, vec![1, 3, 5, 7]));
}

/// Pieces and loose yarns of a whole warp knit that goes on to both sides. Every loop is painted
/// with the colour of its yarn.
fn painted(cloth: &WarpKnitted, laid: &[PlacedLap]) -> (u64, u64) {
    let [wales, courses] = cloth.lapped_size();
    let copies = i64::from(cloth.copies()[0]) + 40;
    let mut yarns = Vec::new();
    for copy in -20..copies {
        for laps in laid.chunks(courses as usize) {
            yarns.push((copy, laps.iter().map(move |lap| lap.lap).collect::<Vec<_>>(), laps[0]));
        }
    }
    let needles = |yarn: &(i64, Vec<texere_fabric::warp::Lap>, PlacedLap), course: usize| -> Vec<i64> {
        let lap = yarn.1[course % courses as usize];
        if lap.kind() == LapKind::Inlay {
            return Vec::new();
        }
        lap.needles().map(|needle| i64::from(needle) + yarn.0 * i64::from(wales)).collect()
    };
    let mut loops: std::collections::BTreeMap<(i64, usize), Vec<usize>> = std::collections::BTreeMap::new();
    for (number, yarn) in yarns.iter().enumerate() {
        for course in 0..courses as usize {
            for needle in needles(yarn, course) {
                loops.entry((needle, course)).or_default().push(number);
            }
        }
    }
    // A yarn that crosses wales of a bar further forward lies between that bar's loops and its yarn
    // from course to course.
    let mut caught: Vec<[usize; 2]> = Vec::new();
    for (number, yarn) in yarns.iter().enumerate() {
        for course in 0..courses as usize {
            let ([one], [other]) = (&needles(yarn, course)[..], &needles(yarn, course + 1)[..]) else {
                continue;
            };
            for between in one.min(other) + 1..*one.max(other) {
                let there = loops.get(&(between, course)).into_iter().flatten();
                let before = there.filter(|before| yarns[**before].2.bar < yarn.2.bar);
                caught.extend(before.map(|before| [number, *before]));
            }
        }
    }
    let mut paint: Vec<usize> = (0..yarns.len()).collect();
    let mut held = vec![false; yarns.len()];
    loop {
        let before = paint.clone();
        for (&(needle, course), below) in &loops {
            let Some(above) = loops.get(&(needle, (course + 1) % courses as usize)) else { continue };
            let all: Vec<usize> = below.iter().chain(above).copied().collect();
            let least = all.iter().map(|yarn| paint[*yarn]).min().unwrap();
            for yarn in all {
                (paint[yarn], held[yarn]) = (least, true);
            }
        }
        for &[one, other] in &caught {
            let least = paint[one].min(paint[other]);
            for yarn in [one, other] {
                (paint[yarn], held[yarn]) = (least, true);
            }
        }
        if paint == before {
            break;
        }
    }
    let within = |yarn: &usize| (0..i64::from(cloth.copies()[0])).contains(&yarns[*yarn].0);
    let inside: Vec<usize> = (0..yarns.len()).filter(within).collect();
    let pieces: BTreeSet<usize> = inside.iter().map(|yarn| paint[*yarn]).collect();
    (pieces.len() as u64, inside.iter().filter(|yarn| !held[**yarn]).count() as u64)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn random_bars_are_as_painted(
        chains in prop::collection::vec(prop::collection::vec((0..4_i32, any::<bool>()), 1..4), 1..3),
        threadings in prop::collection::vec(prop::collection::vec(any::<bool>(), 1..4), 2),
        copies in 4..8_u32,
    ) {
        let bars: Vec<Bar> = chains.iter().zip(&threadings).map(|(chain, threading)| {
            let laps: Vec<String> = chain.iter().map(|(needle, back)| {
                let [from, to] = if *back { [needle + 1, *needle] } else { [*needle, needle + 1] };
                format!("{from}-{to}")
            }).collect();
            bar(&(laps.join("/") + "//"), threading)
        }).collect();
        prop_assume!(threadings.iter().take(bars.len()).flatten().any(|threaded| *threaded));
        let (mut wales, mut courses) = (1, 1);
        for (chain, threading) in chains.iter().zip(&threadings) {
            wales *= threading.len() as u32;
            courses *= chain.len() as u32;
        }
        let cloth = warp(bars, wales, courses, [copies, 1]);
        let pieces = cloth.pieces();
        let laid: Vec<PlacedLap> = cloth.laps().collect();
        prop_assert_eq!((pieces.count, pieces.loose), painted(&cloth, &laid));
    }
}
