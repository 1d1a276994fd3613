//! Weft-knitted cloth: counts, copies, sizes, cloth that does not repeat, measures and refusals.

use std::ops::ControlFlow;

use texere_contact::clearance;
use texere_core::settling::Length;
use texere_core::{ControlPoint, Ends, Material, Origin, Section, Settings, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::weft::{
    Beds, CarrierSet, Cells, Chart, Direction, Gauge, Instruction, KnitYarn, Knitted, Machine, Needle,
    Operation, Program, Stitches, WeftError,
};
use texere_fabric::{FabricError, Finish, Finished, Structure};

/// A knit with yarns of 0.2 mm and 30 tex.
fn knit(stitches: Stitches, copies: [u32; 2]) -> Result<Knitted, FabricError> {
    let material = Material { tex: Some(30.0), ..Material::default() };
    let yarns = vec![KnitYarn::new(0.1); 2];
    Knitted::new(stitches, Gauge::new(1.0, 0.75), yarns, vec![material], vec![Section::Circle], copies)
}

fn chart(text: &str) -> Stitches {
    Machine::default().knit(&Chart::parse(text, Beds::One).unwrap().program().unwrap()).unwrap().stitches
}

/// Plain jersey that one carrier knits to and fro.
fn flat(needles: i32, courses: u32) -> Stitches {
    let mut operations = Vec::new();
    let mut add = |instruction| {
        let source = operations.len() as u32 + 1;
        operations.push(Operation { instruction, carriers: CarrierSet(1), source });
    };
    add(Instruction::In);
    for course in 0..courses {
        for needle in 0..needles {
            add(if course % 2 == 0 {
                Instruction::Knit(Direction::Left, Needle::front(needles - 1 - needle))
            } else {
                Instruction::Knit(Direction::Right, Needle::front(needle))
            });
        }
    }
    add(Instruction::Out);
    let program =
        Program { carriers: vec!["1".into()], carrier_sets: vec![vec![], vec![0]], operations, repeat: None };
    Machine::default().knit(&program).unwrap().stitches
}

fn positions(yarns: &Yarns) -> Vec<[f32; 3]> {
    yarns.points().iter().map(|point| point.position().to_array()).collect()
}

/// Copies of a small repeat make the same cloth as a large repeat.
#[test]
fn repeats_are_laid_as_they_are_charted() {
    for (small, large) in [
        ("kp", "kpkpkpkp\nkpkpkpkp\nkpkpkpkp\nkpkpkpkp"),
        (">k\nkk", ">k>k>k>k\nkkkkkkkk\n>k>k>k>k\nkkkkkkkk"),
        ("kt\ntk", "ktktktkt\ntktktktk\nktktktkt\ntktktktk"),
    ] {
        let small_size = chart(small).repeat.unwrap();
        let copies = [8 / small_size[0], 4 / small_size[1]];
        let (small, large) = (knit(chart(small), copies).unwrap(), knit(chart(large), [1, 1]).unwrap());
        assert_eq!(small.size(), [8, 4]);
        // The place where a yarn is cut depends on its direction.
        let inside = |knit: Knitted| {
            let mut points = positions(&knit.yarns().unwrap());
            points.retain(|at| (-0.01..8.01).contains(&at[0]));
            points.sort_by_key(|at| at.map(|mm| (mm * 1e3 + 0.2).round() as i64));
            points
        };
        let [one, other] = [small, large].map(inside);
        assert_eq!(one.len(), other.len());
        for (one, other) in one.iter().zip(&other) {
            assert!((0..3).all(|axis| (one[axis] - other[axis]).abs() < 2e-3), "{one:?} {other:?}");
        }
    }
}

/// With [`Cells::Even`], every needle that a yarn comes to has equally many control points, for a
/// loop or for a float.
#[test]
fn even_cells_have_twelve_points_each() {
    let floats = chart("kmkk\nkkkm\nktkk\npkkk");
    for (cells, even) in [(Cells::Even, true), (Cells::Round, false)] {
        let yarns = knit(floats.clone(), [5, 2]).unwrap().with_cells(cells).yarns().unwrap();
        let counts: Vec<_> = yarns.layout().offsets().windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert_eq!(counts.len(), 8);
        assert_eq!(counts.iter().all(|count| *count == 12 * 4 * 5), even, "{counts:?}");
    }
}

/// The yarn of a cloth that does not repeat turns at its edges. The pinned points stay in place:
/// the yarn's ends, the arcs between the first loops, and the heads that are on needles at the end.
#[test]
fn a_whole_piece_settles_with_its_edges_held() {
    let knit = knit(flat(6, 6), [1, 1]).unwrap();
    assert_eq!((knit.size(), knit.size_mm()), ([6, 6], [6.0, 4.5]));
    let piece = knit.piece().unwrap();
    assert_eq!(piece.boundary.ends(), [Ends::Open]);
    assert_eq!(piece.yarns.layout().yarns()[0].origin, Origin::Carrier(1));
    // Two points at each end of the yarn, five arcs between the first loops, and six heads.
    assert_eq!(piece.pinned.len(), 4 + 5 + 6);
    let structure = Structure::Weft(knit);
    assert!(structure.knitted().is_some() && structure.woven().is_none());
    let device = ParallelBackend::open().unwrap();
    let finished = structure.settle(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(())).unwrap();
    assert!(finished.is_at_rest());
    let Finished::Knit(settled) = finished else { panic!("a knit settles by contact") };
    assert!(settled.rest.at_rest && settled.is_linked(), "{:?}", settled.rest);
    assert!(settled.clearance.min > 0.98, "{:?}", settled.clearance);
    let [before, after] = [&piece.yarns, &settled.yarns].map(positions);
    let moved = |point: usize| {
        (0..3).map(|axis| (before[point][axis] - after[point][axis]).abs()).fold(0.0, f32::max)
    };
    assert!(piece.pinned.iter().all(|point| moved(*point as usize) < 1e-4));
    assert!((0..before.len()).any(|point| moved(point) > 0.02));
    // Sources are operations. The first knit is the second operation.
    assert_eq!(piece.yarns.sources().unwrap()[0], 2);
}

/// One repeat settles. Its copies are clear, also at the cut edges, and their measures follow from
/// the loops.
#[test]
fn copies_of_a_repeat_that_settled_are_clear() {
    let gauge = Gauge { loop_length_mm: Some(3.9), ..Gauge::new(1.0, 0.75) };
    let yarns = vec![KnitYarn::new(0.1)];
    let material = Material { tex: Some(30.0), ..Material::default() };
    let knit =
        Knitted::new(chart("k"), gauge, yarns, vec![material], vec![Section::Circle], [12, 8]).unwrap();
    let device = ParallelBackend::open().unwrap();
    let settled = knit.settle(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(())).unwrap();
    assert!(settled.rest.at_rest && settled.is_linked(), "{:?}", settled.rest);
    assert!(settled.clearance.min > 0.98, "{:?}", settled.clearance);
    assert_eq!(settled.clearance, clearance(&settled.yarns, &Settings::default()).unwrap());
    assert_eq!(settled.yarns.layout().yarns().len(), 8);
    let measures = knit.measures(&settled.yarns).unwrap();
    let loops = measures.knit.unwrap();
    assert_eq!((loops.loops, loops.size), (96, [12, 8]));
    // Loops have about the length that the gauge gives.
    assert!((loops.loop_length_mm / 3.9 - 1.0).abs() < 0.05, "{loops:?}");
    assert!((loops.stitch_density - 100.0 / 0.75).abs() < 1e-9);
    assert!((loops.tightness.unwrap() - 30f64.sqrt() / (loops.loop_length_mm / 10.0)).abs() < 1e-9);
    // The weight is stitches to the cm² × loop length × tex / 100, in g/m².
    let weight = loops.stitch_density * loops.loop_length_mm * 30.0 / 100.0;
    assert!((measures.areal_weight.unwrap() / weight - 1.0).abs() < 1e-9);
    assert!(measures.crimp.is_none() && measures.cover.is_none());
    assert!((2.0..3.0).contains(&(measures.thickness_mm / 0.2)), "{measures:?}");
}

#[test]
fn a_section_can_be_changed() {
    let mut structure = Structure::Weft(knit(chart("k"), [4, 4]).unwrap());
    let before = structure.yarns().unwrap();
    structure.set_section(Section::Polygon(vec![[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8]])).unwrap();
    assert_eq!(
        structure.yarns().unwrap().layout().sections(),
        [Section::Polygon(vec![[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8]])]
    );
    assert!(structure.set_section(Section::Polygon(Vec::new())).is_err());
    assert_eq!(before.points().len(), structure.yarns().unwrap().points().len());
    assert!(before.points().iter().all(|point: &ControlPoint| (point.half_width() - 0.1).abs() < 1e-4));
}

#[test]
fn what_is_no_cloth_is_refused_by_name() {
    let refused = |change: &dyn Fn(&mut Stitches)| {
        let mut stitches = chart("kkkk\nkkkk");
        change(&mut stitches);
        knit(stitches, [2, 2]).unwrap_err().to_string()
    };
    let says = |message: String, part: &str| assert!(message.contains(part), "{message}");
    says(refused(&|stitches| stitches.loops.clear()), "none that there is");
    says(refused(&|stitches| *stitches = Stitches::default()), "no loops");
    says(refused(&|stitches| stitches.loops[1].parents.end = 99), "parents are not listed");
    says(refused(&|stitches| stitches.loops[1].at = f32::NAN), "on no needle");
    says(refused(&|stitches| stitches.parents[0].number = 8), "drawn through none");
    says(refused(&|stitches| stitches.strands[0].carrier = 2), "no yarn for carrier 3; there are 2");
    says(refused(&|stitches| stitches.strands[0].onward = Some([0, 1])), "goes on elsewhere");
    says(refused(&|stitches| stitches.repeat = Some([0, 2])), "a repeat of no size");
    says(knit(chart("k"), [1 << 31, 1]).unwrap_err().to_string(), "too many wales");
    says(knit(chart("k"), [0, 1]).unwrap_err().to_string(), "no copy");
    let much = knit(chart("k"), [1 << 20, 1 << 20]).unwrap_err();
    assert!(matches!(much, FabricError::Weft(WeftError::KnitPoints { .. })), "{much}");
    let gauge = |gauge| {
        let yarns = vec![KnitYarn::new(0.1)];
        Knitted::new(chart("k"), gauge, yarns, vec![Material::default()], vec![Section::Circle], [1, 1])
    };
    for wrong in [Gauge::new(0.0, 1.0), Gauge::new(1.0, f64::NAN), Gauge::munden(-2.0)] {
        assert!(matches!(gauge(wrong), Err(FabricError::Weft(WeftError::Gauge { .. }))), "{wrong:?}");
    }
}

/// Small programs whose cloths would take too much memory, and copies of a repeat that would have
/// to settle as one, because their number has no small divisor.
#[test]
fn small_programs_of_huge_cloths_are_refused_by_name() {
    let made = |operations: Vec<(Instruction, u32)>| {
        let operations = (1..).zip(operations).map(|(source, (instruction, set))| Operation {
            instruction,
            carriers: CarrierSet(set),
            source,
        });
        let program = Program {
            carriers: vec!["A".into(), "B".into()],
            carrier_sets: vec![vec![], vec![0], vec![1]],
            operations: operations.collect(),
            repeat: None,
        };
        knit(Machine::default().knit(&program).unwrap().stitches, [1, 1])
    };
    let right = |needle| Instruction::Knit(Direction::Right, Needle::front(needle));
    let left = |needle| Instruction::Knit(Direction::Left, Needle::front(needle));
    // Yarns that float past all needles.
    let floats = (0..400).map(|each| (if each % 2 == 0 { right(65536) } else { left(-65536) }, 1)).collect();
    // A yarn that comes back many times, thousands of courses later.
    let mut rises = vec![(right(5), 1), (left(0), 1)];
    rises.extend((0..20_000).map(|_| (right(0), 2)));
    rises.extend((0..400).flat_map(|_| [(right(0), 1), (left(5), 1)]));
    // Loops that are held for thousands of courses.
    let mut held: Vec<_> = (0..1000).map(|needle| (left(999 - needle), 1)).collect();
    held.extend((0..20_000).map(|_| (right(999), 1)));
    held.extend((0..1000).map(|needle| (left(999 - needle), 2)));
    for (what, operations) in [("floats", floats), ("rises", rises), ("held", held)] {
        assert!(matches!(made(operations), Err(FabricError::Weft(WeftError::KnitRuns { .. }))), "{what}");
    }
    assert!(matches!(knit(chart("k"), [9973, 9973]), Err(FabricError::Weft(WeftError::Copies { .. }))));
    assert!(knit(chart("k"), [10_000, 10_000]).is_ok());
}

/// Loops with lengths of their own together get the sum of these lengths, along splines of any
/// tension. A loop without a length counts with the length of the gauge. If there is none, no
/// length is asked for.
#[test]
fn loops_ask_for_their_lengths() {
    let given = |lengths: [Option<f32>; 2], gauge: Option<f64>, tension: f32| {
        let mut stitches = chart("kkkk\nkkkk\nkkkk\nkkkk");
        for (number, stitch) in stitches.loops.iter_mut().enumerate() {
            stitch.length_mm = lengths[number % 2];
        }
        let gauge = Gauge { loop_length_mm: gauge, ..Gauge::new(1.0, 0.75) };
        let (yarns, sections) = (vec![KnitYarn::new(0.1)], vec![Section::Circle]);
        let cloth =
            Knitted::new(stitches, gauge, yarns, vec![Material::default()], sections, [3, 2]).unwrap();
        let repeat = cloth.repeat().unwrap().with_tension(tension).unwrap();
        match cloth.finish_of(&repeat, &Finish::default()).length {
            Some(Length::Given(factor)) => Some(f64::from(factor) * repeat.piece.length_mm() / 16.0),
            _ => None,
        }
    };
    for (lengths, gauge, mean) in [
        ([Some(4.0), Some(5.0)], None, 4.5),
        ([Some(4.0), None], Some(5.0), 4.5),
        ([None, None], Some(4.2), 4.2),
    ] {
        for tension in [0.0, 0.6] {
            let found = given(lengths, gauge, tension).unwrap();
            assert!((found - mean).abs() < 1e-5, "{lengths:?}, {gauge:?}, {tension}: {found}");
        }
    }
    assert_eq!(given([Some(4.0), None], None, 0.0), None);
}
