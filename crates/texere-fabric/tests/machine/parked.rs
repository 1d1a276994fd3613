//! Yarn that nothing holds is left out, such as that of a carrier that is parked beyond the cloth.
//! Carriers of a set act together.

use proptest::prelude::*;
use texere_fabric::weft::{Fault, FaultKind, Knit, Machine, Step, Stitches};

use crate::laws::programs;
use crate::program::program;

fn knit(text: &str) -> Knit {
    let lines: Vec<_> = text.lines().filter(|line| !line.is_empty()).collect();
    Machine::default().knit(&program(&lines.join("\n"))).expect("a knit")
}

/// Stitches with all sources set to 0.
fn bare(mut stitches: Stitches) -> Stitches {
    for stitch in &mut stitches.loops {
        stitch.source = 0;
    }
    for step in stitches.strands.iter_mut().flat_map(|strand| &mut strand.steps) {
        if let Step::Float { source, .. } = step {
            *source = 0;
        }
    }
    stitches
}

/// Six rows of knitting with `carriers`, to and fro over needles 1 to 4 of a bed. `right` and
/// `left` are the operations at the end of a row in that direction.
fn rows(bed: &str, carriers: &str, [right, left]: [&str; 2]) -> String {
    let row = |way: &str, needles: [u32; 4], end: &str| {
        let knits = needles.map(|needle| format!("knit {way} {bed}{needle} {carriers}\n"));
        format!("{}{end}\n", knits.concat())
    };
    let there = row("+", [1, 2, 3, 4], right);
    let back = row("-", [4, 3, 2, 1], left);
    format!("{there}{back}").repeat(3)
}

/// Lines that park a carrier begin with `~`. The cloth is that of the other lines.
#[test]
fn a_carrier_that_is_parked_beyond_the_cloth_draws_its_yarn_back() {
    let ends = |right: &'static str, left: &'static str| [right, left];
    let rib = "knit + f1 1\nknit + b2 1\nknit + f3 1\n~miss + b40 1\nknit - f3 1\nknit - b2 1\nknit - f1 1\n~miss - b-40 1\n";
    let half = "rack 0.25\nknit + f1 1\nknit + b1 1\nknit + f2 1\nknit + b2 1\n~miss + b8 1\nknit - b2 1\nknit - f2 1\nknit - b1 1\nknit - f1 1\n~miss - f-9 1";
    let stripe = |carrier: u32, right: i32, left: i32| {
        let [there, back] = [format!("~miss + f{right} {carrier}"), format!("~miss - f{left} {carrier}")];
        let all = rows("f", &carrier.to_string(), [&there, &back]);
        all.lines().take(10).fold(String::new(), |all, line| all + line + "\n")
    };
    for (name, text) in [
        ("on both sides", format!("in 1\n{}out 1", rows("f", "1", ends("~miss + f10 1", "~miss - f-5 1")))),
        ("step by step", format!("in 1\n{}", rows("f", "1", ends("~miss + f5 1\n~miss + f6 1\n~miss - f6 1\n~miss - f5 1", "")))),
        ("before it begins and after it ends", format!("in 1\n~miss - f30 1\n~miss - f9 1\n{}~miss + f30 1\nout 1", rows("f", "1", ["", ""]))),
        ("on the other bed", format!("in 1\n{}", rows("f", "1", ends("~miss + b10 1", "~miss - b-5 1")))),
        ("of the back bed", format!("in 1\n{}", rows("b", "1", ends("~miss + b10 1", "~miss - f-5 1")))),
        ("of a rib", format!("in 1\n{}", rib.repeat(3))),
        ("at half a rack", format!("in 1\n{half}\n{half}")),
        ("of two", format!("in 1 2\n{}", rows("f", "2 1", ends("~miss + f10 2 1", "~miss - f-5 2 1")))),
        ("further out than another", format!("in 1\nin 2\n{0}{1}{0}{1}", stripe(1, 8, -4), stripe(2, 20, -20))),
        ("on a tuck that falls", format!("in 1\n{}", rows("f", "1", ends("~tuck + f9 1\n~drop f9", "~tuck - f-9 1\n~tuck - b-9 1\n~drop f-9\n~drop b-9")))),
        ("in the middle of a row", "in 1\nknit + f1 1\nknit + f2 1\n~miss + f9 1\nknit + f3 1\n~miss - f-9 1\nknit + f4 1".into()),
        ("beyond a float", "in 1\nknit + f1 1\nmiss + f2 1\nmiss + f3 1\nknit + f4 1\n~miss + f7 1\nknit - f4 1\nmiss - f3 1\nmiss - f2 1\nknit - f1 1".into()),
    ] {
        let parked = knit(&text.replace('~', ""));
        let plain: String = text.lines().filter(|line| !line.starts_with('~')).map(|line| format!("{line}\n")).collect();
        let plain = knit(&plain);
        assert_eq!(bare(parked.stitches), bare(plain.stitches), "{name}");
        // Yarn that is drawn back gives neither a long float nor a catch.
        let kinds = |faults: &[Fault]| -> Vec<_> {
            let others = faults.iter().map(|fault| fault.kind.clone());
            others.filter(|kind| !matches!(kind, FaultKind::Dropped(_))).collect()
        };
        assert_eq!(kinds(&parked.faults), kinds(&plain.faults), "{name}");
    }
}

/// Carriers of a set lay their yarns side by side in one stitch. No yarn is caught behind another.
#[test]
fn carriers_of_a_set_act_at_once() {
    let tangled = |text: &str| {
        let Knit { faults, .. } = knit(text);
        let caught = faults.iter().filter_map(|fault| match &fault.kind {
            FaultKind::Tangled(other) => {
                Some((fault.source, fault.carrier.clone().unwrap_or_default(), other.clone()))
            }
            _ => None,
        });
        caught.collect::<Vec<_>>()
    };
    for text in [
        format!("in 1 2\n{}", rows("f", "1 2", ["", ""])),
        format!("in 1 2\n{}", rows("b", "2 1", ["miss + b9 2 1", "miss - b-9 2 1"])),
        format!("in 1 2 3\n{}", rows("f", "3 1 2", ["", ""])),
        format!(
            "in 1 2 3\n{}",
            rows("f", "3 1 2", ["", ""])
                .replace("knit + f2", "tuck + f2")
                .replace("knit - f3", "split - f3 b3")
        ),
        format!("in 1 2\n{}", rows("f", "1 2", ["xfer f2 b2\nrack 1\nxfer b2 f3\nrack 0", "drop f1"])),
        // The front carrier changes from row to row.
        format!("in 1 2\n{}{}", rows("f", "1 2", ["", ""]), rows("f", "2 1", ["", ""])),
    ] {
        assert_eq!(tangled(&text), [], "{text}");
    }
    // Yarn that is laid on both sides of a set catches all of its carriers, and a set catches
    // carriers that wait.
    let set = "in 1 2\nin 3\nknit + f2 1 2\nknit + f1 3\nknit + f3 3\nknit - f2 1 2";
    assert_eq!(tangled(set), [(6, "1".into(), "3".into()), (6, "2".into(), "3".into())]);
    let waits = "in 1 2\nin 3\nknit + f2 3\nknit + f1 1 2\nknit + f3 1 2\nknit - f2 3";
    assert_eq!(tangled(waits), [(6, "3".into(), "1".into())]);
}

#[test]
fn floats_between_loops_stay() {
    let places = |text: &str| -> Vec<f32> {
        let Knit { stitches, .. } = knit(text);
        stitches.strands[0].steps.iter().map(|step| stitches.visit(step).at).collect()
    };
    assert_eq!(places("in 1\nknit + f1 1\nmiss + f2 1\nmiss + f3 1\nknit + f4 1"), [1.0, 2.0, 3.0, 4.0]);
    // In the first program the carrier passes needle 3 on its way out, and makes a loop on its way
    // back. In the second it passes needle 3 on its way back, to a loop further in.
    assert_eq!(places("in 1\nknit + f1 1\nmiss + f3 1\nmiss + f9 1\nknit - f5 1"), [1.0, 3.0, 5.0]);
    assert_eq!(places("in 1\nknit + f5 1\nmiss + f9 1\nmiss - f3 1\nknit - f1 1"), [5.0, 3.0, 1.0]);
    // A loop that falls off a needle between two loops becomes a float.
    assert_eq!(places("in 1\nknit + f1 1\ntuck + f2 1\nknit + f3 1\ndrop f2"), [1.0, 2.0, 3.0]);
}

/// Carrier 1 waits between needles 4 and 5, and carrier 2 lays its yarn on both sides of it. The
/// yarn of carrier 1 then can't be drawn back.
#[test]
fn yarn_that_another_has_caught_is_held_there() {
    let text = "in 1\nin 2\nknit + f2 1\nmiss + f4 1\nknit + f1 2\nknit + f3 2\nknit + f5 2\nknit - f2 1";
    let Knit { stitches, faults, .. } = knit(text);
    let places: Vec<_> = stitches.strands[0].steps.iter().map(|step| stitches.visit(step).at).collect();
    assert_eq!(places, [2.0, 4.0, 2.0]);
    assert!(faults.iter().any(|fault| fault.kind == FaultKind::Tangled("2".into())), "{faults:?}");
}

#[test]
fn yarn_that_no_loop_holds_is_left_out_and_told() {
    let Knit { stitches, faults, .. } =
        knit("in 1\nin 2\nknit + f1 1\nmiss + f1 2\nmiss + f9 2\nknit - f1 1\nout 2");
    assert_eq!(stitches.strands.len(), 1);
    let loose: Vec<_> = faults.iter().filter(|fault| fault.kind == FaultKind::Loose).collect();
    assert_eq!(loose.len(), 1);
    assert_eq!((loose[0].source, loose[0].carrier.as_deref()), (4, Some("2")));
}

proptest! {
    /// For any paths of carriers, a yarn begins and ends in loops, and lies between them, unless
    /// another yarn catches it.
    #[test]
    fn yarns_are_taut(program in programs()) {
        let Knit { stitches, faults, .. } = Machine::default().knit(&program).expect("a knit");
        let is_caught = faults.iter().any(|fault| matches!(fault.kind, FaultKind::Tangled(_)));
        for strand in stitches.strands.iter().filter(|_| !is_caught) {
            let visits: Vec<_> = strand.steps.iter().map(|step| stitches.visit(step)).collect();
            let ends = [visits.first(), visits.last()].map(|visit| visit.is_some_and(|visit| visit.number.is_some()));
            prop_assert_eq!(ends, [true; 2]);
            for around in visits.windows(3) {
                if around[1].number.is_none() {
                    let [before, at, after] = [0, 1, 2].map(|index| around[index].at);
                    prop_assert!((at - before) * (after - at) > 0.0, "{before}, {at}, {after}");
                }
            }
        }
    }
}
