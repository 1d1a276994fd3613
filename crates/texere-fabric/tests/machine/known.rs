//! Small programs whose stitches are worked out by hand.

use texere_fabric::weft::{Bed, Fate, FaultKind, Head, Knit, LoopRef, Machine, Needle, Program, Step};

use crate::program::program;

fn knit(program: &Program) -> Knit {
    Machine::default().knit(program).expect("a knit")
}

fn repeat(width: u32, text: &str) -> Knit {
    knit(&Program { repeat: Some(width), ..program(text) })
}

fn to(number: u32, repeat: [i32; 2]) -> LoopRef {
    LoopRef { number, repeat }
}

fn flat(number: u32) -> LoopRef {
    to(number, [0, 0])
}

#[test]
fn jersey_is_drawn_through_its_own_repeat_below() {
    let Knit { stitches, faults, .. } = repeat(2, "knit + f0 1\nknit + f1 1\nknit + f0 1\nknit + f1 1");
    assert_eq!(faults, []);
    assert_eq!(stitches.repeat, Some([2, 2]));
    let courses: Vec<_> = stitches.loops.iter().map(|stitch| stitch.course).collect();
    assert_eq!(courses, [0, 0, 1, 1]);
    assert_eq!(stitches.parents_of(0), [to(2, [0, -1])]);
    assert_eq!(stitches.parents_of(2), [flat(0)]);
    assert_eq!(stitches.loops[0].fate, Fate::Held(flat(2)));
    assert_eq!(stitches.loops[3].fate, Fate::Held(to(1, [0, 1])));
    assert_eq!(stitches.strands.len(), 2);
    assert!(stitches.strands.iter().all(|strand| strand.onward == Some([1, 0]) && strand.steps.len() == 2));
}

#[test]
fn a_loop_that_leaves_its_repeat_is_held_in_the_next() {
    // A decrease over the edge of the repeat: the loop of needle 1 goes to needle 0 of the next
    // repeat.
    let text = "knit + f0 1\nknit + f1 1\nxfer f1 b1\nrack 1\nxfer b1 f2\nrack 0\nknit + f0 1\nknit + f1 1";
    let Knit { stitches, faults, .. } = repeat(2, text);
    assert_eq!(faults, []);
    assert_eq!(stitches.parents_of(2), [flat(0), to(1, [-1, 0])]);
    assert_eq!(stitches.loops[1].fate, Fate::Held(to(2, [1, 0])));
    assert_eq!(stitches.loops[1].head, Head { at: 2.0, bed: Bed::Front, layer: 1, moved: 2 });
    // After the move, needle 1 is empty, and the next loop on it is a cast-on.
    assert_eq!(stitches.parents_of(3), []);
}

#[test]
fn tubes_whose_sides_grow_at_different_rates_are_as_high_as_the_faster_one() {
    let text = "knit + f0 1\nknit + b0 2\nknit + f0 1";
    let Knit { stitches, .. } = repeat(1, text);
    assert_eq!(stitches.repeat, Some([1, 2]));
    assert_eq!(stitches.parents_of(1), [to(1, [0, -1])]);
}

/// A viewer of knitout once showed the tuck of this program in front.
#[test]
fn a_tuck_lies_behind_the_loops_of_its_needle() {
    for bed in ["f", "b"] {
        let text = format!(
            "in 1\nin 2\nknit + {bed}1 1\nknit + {bed}2 1\nknit + {bed}3 1\ntuck + {bed}2 2\nknit - {bed}3 1\nknit - {bed}2 1\n\
             knit - {bed}1 1\ndrop {bed}1\ndrop {bed}2\ndrop {bed}3\nout 1\nout 2"
        );
        let Knit { stitches, faults, .. } = knit(&program(&text));
        assert!(faults.iter().all(|fault| !fault.kind.is_error()), "{faults:?}");
        assert_eq!(stitches.parents_of(5), [flat(1), flat(3)]);
        let layers = [1, 3].map(|number| stitches.loops[number].head.layer);
        assert_eq!(
            layers,
            [0, 1],
            "the knit loop, nearest to the side that loops are drawn to, then the tuck"
        );
        assert_eq!(stitches.loops[3].fate, Fate::Held(flat(5)));
        // The tuck hangs on top of a loop of course 0, and the next loop is drawn through both.
        let courses = [1, 3, 5].map(|number| stitches.loops[number].course);
        assert_eq!(courses, [0, 1, 2]);
    }
}

#[test]
fn a_carrier_follows_its_transferred_loop() {
    let text = "in 1\nknit + f1 1\nknit + f2 1\nknit + f3 1\nxfer f2 b2\nrack 1\nxfer b2 f3\nrack 0\nknit - f3 1\nknit - f2 1\n\
                knit - f1 1\nout 1";
    let Knit { stitches, .. } = knit(&program(text));
    // The yarn goes on to the next loop from where the loop was made. The loop's head hangs on
    // needle 3.
    assert_eq!(stitches.strands.len(), 1);
    let steps: Vec<_> = stitches.strands[0]
        .steps
        .iter()
        .map(|step| match *step {
            Step::Loop { number, .. } => (number, stitches.loops[number as usize].at),
            Step::Float { .. } => panic!("a float"),
        })
        .collect();
    assert_eq!(steps, [(0, 1.0), (1, 2.0), (2, 3.0), (3, 3.0), (4, 2.0), (5, 1.0)]);
    assert_eq!(stitches.loops[1].head, Head { at: 3.0, bed: Bed::Front, layer: 1, moved: 2 });
    assert_eq!(stitches.parents_of(3), [flat(2), flat(1)]);
    assert_eq!(stitches.parents_of(4), [], "its old needle is empty");
}

#[test]
fn a_transfer_turns_the_order_of_loops_over() {
    let text = "in 1\nknit + f1 1\ntuck + f1 1\ntuck + b1 1\nxfer f1 b1\nknit + b1 1\nout 1";
    let Knit { stitches, .. } = knit(&program(text));
    assert_eq!(stitches.parents_of(3), [flat(2), flat(1), flat(0)]);
}

#[test]
fn a_split_draws_a_loop_through_and_moves_the_old_ones() {
    let text = "in 1\nknit + f1 1\nsplit + f1 b1 1\nknit + b1 1\nknit - f1 1\nout 1";
    let Knit { stitches, .. } = knit(&program(text));
    assert_eq!(stitches.parents_of(1), [flat(0)]);
    assert_eq!(stitches.parents_of(2), [flat(0)]);
    assert_eq!(stitches.loops[0].fate, Fate::Held(flat(2)));
    assert_eq!(stitches.loops[0].head.bed, Bed::Back);
    // After a split, the new loop holds the old one, so that dropping the old one is no fault.
    let Knit { stitches, faults, .. } =
        knit(&program("in 1\nknit + f1 1\nsplit + f1 b1 1\ndrop b1\ndrop f1\nout 1"));
    assert_eq!(stitches.loops[0].fate, Fate::Held(flat(1)));
    assert_eq!(faults.len(), 1);
}

#[test]
fn two_carriers_make_a_loop_each() {
    let Knit { stitches, .. } = knit(&program("in 1 2\nknit + f1 2 1\nknit - f1 2 1\nout 1 2"));
    assert_eq!(stitches.loops.len(), 4);
    assert_eq!([0, 1, 2, 3].map(|number| stitches.loops[number].plate), [0, 1, 0, 1]);
    assert_eq!(stitches.parents_of(3), [flat(0), flat(1)]);
    assert_eq!(stitches.loops[1].fate, Fate::Held(flat(2)));
    assert_eq!(stitches.loops[1].head.layer, 1);
    let loops = |carrier| {
        let strand = stitches.strands.iter().find(|strand| strand.carrier == carrier).expect("a strand");
        strand
            .steps
            .iter()
            .map(|step| if let Step::Loop { number, .. } = *step { number } else { 9 })
            .collect::<Vec<_>>()
    };
    assert_eq!((loops(1), loops(0)), (vec![0, 2], vec![1, 3]));
}

#[test]
fn needles_at_half_pitch_lie_between_those_of_the_other_bed() {
    for (rack, at) in [("0.25", 3.5), ("0.5", 3.5), ("-0.75", 2.5), ("1", 4.0), ("-0.5", 2.5)] {
        let text = format!("in 1\nrack {rack}\nknit + f3 1\nknit + b3 1\nmiss + f9 1\nknit + f10 1");
        let Knit { stitches, .. } = knit(&program(&text));
        assert_eq!(stitches.loops[1].at, at, "{rack}");
        assert_eq!(stitches.loops[1].opposite, rack != "1", "{rack}");
        assert!(matches!(stitches.strands[0].steps[2], Step::Float { at: 9.0, course: 0, .. }));
    }
}

#[test]
fn a_carrier_that_comes_back_is_another_yarn() {
    let Knit { stitches, .. } =
        knit(&program("in 1\nknit + f1 1\nout 1\nin 1\nknit + f1 1\nout 1\nin 2\nout 2"));
    assert_eq!(stitches.strands.len(), 2);
}

/// Faults are found with their lines, and no other errors with them. Needles that never knit,
/// cast-ons and loose yarns have tests of their own.
#[test]
fn faults_are_named() {
    let none = "in 1\nin 2\nin 3\n";
    let cases: [(&str, u32, FaultKind); 19] = [
        ("knit + f1 4\ndrop f1", 4, FaultKind::CarrierNotIn),
        ("in 1", 4, FaultKind::CarrierIn),
        ("out 1\ninhook 1\ninhook 4\nreleasehook 1 4", 6, FaultKind::HookHolds("1".into())),
        ("out 1\ninhook 1\nouthook 2\nreleasehook 1", 6, FaultKind::HookHolds("1".into())),
        ("releasehook 1", 4, FaultKind::HookWithout),
        ("out 4", 4, FaultKind::OutWithoutIn),
        ("rack 5", 4, FaultKind::Racked { rack: 5.0, limit: 4.0 }),
        ("rack -4.25", 4, FaultKind::Racked { rack: -4.25, limit: 4.0 }),
        ("xfer f1 f2", 4, FaultKind::SameBed(Needle::front(2))),
        ("split + b1 b2 1\ndrop b1", 4, FaultKind::SameBed(Needle::back(2))),
        ("rack 1\nxfer f1 b1", 5, FaultKind::NotAligned { to: Needle::back(1), rack: 1.0 }),
        ("rack 0.5\nxfer f1 b1", 5, FaultKind::NotAligned { to: Needle::back(1), rack: 0.5 }),
        ("knit + fs1 1\ndrop fs1", 4, FaultKind::OnSlider),
        ("knit + f1 1\nknit + f1", 5, FaultKind::Dropped(1)),
        ("knit + f1 1\nknit + f2 1", 4, FaultKind::LeftOnNeedles(2)),
        ("knit + f1 1\nknit + f9 1", 5, FaultKind::LongFloat { needles: 7, limit: 6 }),
        (
            "knit + f1 1\nmiss + f9 1\nknit + f0 2\nknit + f10 2\nknit - f1 1",
            8,
            FaultKind::LongFloat { needles: 7, limit: 6 },
        ),
        (
            "tuck + f1 1\ntuck + f1 1\ntuck + f1 1\ntuck + f1 1\ntuck + f1 1",
            8,
            FaultKind::Piled { loops: 5, limit: 4 },
        ),
        ("knit + f2 1\nknit + f1 2\nknit + f3 2\nknit - f2 1", 7, FaultKind::Tangled("2".into())),
    ];
    for (text, line, kind) in cases {
        let Knit { faults, .. } = knit(&program(&(none.to_owned() + text)));
        let found = faults.iter().find(|fault| fault.kind == kind);
        assert_eq!(found.map(|fault| fault.source), Some(line), "{text}: {faults:?}");
        // No other error occurs, except with stitches on sliders.
        let others = faults.iter().filter(|fault| fault.kind != kind);
        assert!(
            others.clone().all(|fault| !fault.kind.is_error() || kind == FaultKind::OnSlider),
            "{text}: {faults:?}"
        );
    }
}

#[test]
fn needles_that_never_knit_are_faults_of_a_repeat() {
    let Knit { stitches, faults, .. } = repeat(2, "knit + f0 1\ntuck + f1 1");
    let never: Vec<_> = faults.iter().filter(|fault| fault.kind == FaultKind::NeverKnits).collect();
    assert_eq!(never.len(), 1);
    assert_eq!((never[0].needle, never[0].source), (Some(Needle::front(1)), 2));
    assert_eq!(stitches.loops[1].fate, Fate::OnNeedle);
    assert_eq!(stitches.loops[0].fate, Fate::Held(to(0, [0, 1])));
}

/// Cast-ons that may come undone are reported once, with their number. Usual cast-ons are not
/// reported.
#[test]
fn risky_cast_ons_are_told() {
    let told = |text: &str| -> Vec<(u32, FaultKind)> {
        let risky = |kind: &FaultKind| matches!(kind, FaultKind::CastOn { .. } | FaultKind::OnlyLoop { .. });
        let Knit { faults, .. } = knit(&program(text));
        faults
            .iter()
            .filter(|fault| risky(&fault.kind))
            .map(|fault| (fault.source, fault.kind.clone()))
            .collect()
    };
    let beside = |beside, others| FaultKind::CastOn { beside, others };
    let front = Needle::front;
    assert_eq!(told("in 1\ntuck + f1 1\ntuck + f2 1"), [(3, beside(front(1), 0))]);
    assert_eq!(told("in 1\nknit - f4 1\nknit - f3 1\nknit - f2 1\nknit - f1 1"), [(3, beside(front(4), 2))]);
    assert_eq!(told("in 1 2\nknit - b4 2 1\nknit - b3 2 1"), [(3, beside(Needle::back(4), 0))]);
    assert_eq!(told("in 1\ntuck + f1 1\ntuck + f3 1\nout 1"), []);
    assert_eq!(
        told("in 1\nin 2\nknit + f1 1\nout 1\nin 1\ntuck + f3 1\nout 1 2"),
        [(4, FaultKind::OnlyLoop { others: 1 })]
    );
    for usual in [
        // Every other needle on the way out, and the rest on the way back.
        "in 1\ntuck - f4 1\ntuck - f2 1\ntuck + f1 1\ntuck + f3 1\nknit - f4 1\nknit - f3 1\nknit - f2 1\nknit - f1 1",
        // Needles of both beds in turn.
        "in 1\nknit - f4 1\nknit - b3 1\nknit - f2 1\nknit - b1 1\nknit + f1 1\nknit + b2 1\nknit + f3 1\nknit + b4 1",
        "in 1\nrack 0.25\ntuck + f1 1\ntuck + b1 1\ntuck + f2 1\ntuck + b2 1",
        // One more needle at the edge.
        "in 1\ntuck + f1 1\ntuck + f3 1\ntuck - f2 1\nknit + f1 1\nknit + f2 1\nknit + f3 1\nknit + f4 1",
        // Two needles forward and one back.
        "in 1\ntuck + f1 1\ntuck - f0 1\ntuck + f3 1\ntuck - f2 1",
    ] {
        assert_eq!(told(usual), [], "{usual}");
    }
}

#[test]
fn one_is_no_plural() {
    let said = |text: &str| -> String {
        let Knit { faults, .. } = knit(&program(text));
        faults.iter().map(|fault| format!("{fault}\n")).collect()
    };
    assert!(said("in 1\nknit + f3 1").contains("at the end 1 loop hangs on needle f3\n"));
    assert!(
        said("in 1\nknit + f3 1\nknit + f5 1")
            .contains("at the end 2 loops hang on needles, the first on f3\n")
    );
    let machine = Machine { float_max: 0, ..Machine::default() };
    let Knit { faults, .. } = machine.knit(&program("in 1\nknit + f1 1\nknit + f3 1")).expect("a knit");
    let float = "carrier 1 floats past 1 needle; more than 0 are a long float";
    assert!(faults.iter().any(|fault| fault.to_string() == float), "{faults:?}");
    let pairs = |needles: u32| {
        said(&(1..=needles).fold("in 1".into(), |text: String, at| format!("{text}\nknit + f{at} 1")))
    };
    assert!(
        pairs(3).contains("; 1 more pair like that\n") && pairs(4).contains("; 2 more pairs like that\n")
    );
    assert!(!pairs(2).contains("like that"));
}
