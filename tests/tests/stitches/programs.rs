//! Splits, plated yarns and dropped stitches, which charts lack: loops go through exactly the loops
//! that they are drawn through, and come to rest.

use texere_fabric::weft::{
    CarrierSet, Direction, FaultKind, Instruction, Machine, Needle, Operation, Program, Step, Stitches,
};

use super::{knitted, settled, topology};

/// The stitches of a repeat of four wales, from words: `k1` knits on front needle 1, `p1` on the
/// back needle, `K1` and `P1` with two yarns; `s1` splits, `m1` misses, `d1` drops, `f1` transfers
/// to the back needle, and `b1` to the front needle.
fn stitches(words: &str) -> Stitches {
    let right = Direction::Right;
    let operation = |word: &str| {
        let (code, number) = word.split_at(1);
        let number = number.parse().unwrap();
        let (front, back) = (Needle::front(number), Needle::back(number));
        let (instruction, set) = match code {
            "k" => (Instruction::Knit(right, front), 1),
            "p" => (Instruction::Knit(right, back), 1),
            "K" => (Instruction::Knit(right, front), 2),
            "P" => (Instruction::Knit(right, back), 2),
            "s" => (Instruction::Split(right, front, back), 1),
            "m" => (Instruction::Miss(right, front), 1),
            "d" => (Instruction::Drop(front), 0),
            "f" => (Instruction::Transfer(front, back), 0),
            "b" => (Instruction::Transfer(back, front), 0),
            _ => panic!("{word}"),
        };
        Operation { instruction, carriers: CarrierSet(set), source: 0 }
    };
    let program = Program {
        carriers: vec!["1".into(), "2".into()],
        carrier_sets: vec![vec![], vec![0], vec![0, 1]],
        operations: words.split_whitespace().map(operation).collect(),
        repeat: Some(4),
    };
    let knit = Machine::default().knit(&program).unwrap();
    assert!(knit.faults.iter().all(|fault| matches!(fault.kind, FaultKind::Dropped(1))), "{:?}", knit.faults);
    let mut stitches = knit.stitches;
    // Each cell has a source of its own. The check of topology finds the cell by it.
    let mut sources = 0..;
    for step in stitches.strands.iter_mut().flat_map(|strand| &mut strand.steps) {
        let own = sources.next().unwrap();
        match step {
            Step::Loop { number, .. } => stitches.loops[*number as usize].source = own,
            Step::Float { source, .. } => *source = own,
        }
    }
    stitches
}

const KNIT: &str = "k0 k1 k2 k3 ";
const PLATED: &str = "K0 K1 K2 K3 ";

/// Checks that loops go through the loops that they are drawn through, before and after settling,
/// and that they come to rest.
fn holds(name: &str, words: &str, wales: &[f64]) {
    for &wale in wales {
        let knit = knitted(stitches(words), wale, 0.75 * wale);
        let piece = knit.piece().unwrap();
        let after = settled(&piece);
        let end = &after.rest.end;
        println!(
            "{name} {wale}: clearance {:.3} to {:.3}, radius {:.3}",
            after.rest.start.clearance, end.clearance, end.radius
        );
        assert!(end.clearance >= 0.98 && end.radius >= 0.58, "{name} {wale}: {:?}", after.rest);
        assert!(after.is_linked(), "{name} {wale}: {:?}", after.linking);
        for yarns in [&piece.yarns, &after.yarns] {
            let faults = topology::faults(knit.stitches(), &piece, yarns);
            assert!(faults.is_empty(), "{name} {wale}: {faults:?}");
        }
    }
}

#[test]
fn splits_hold_the_loop_that_goes_to_the_other_bed_and_comes_back() {
    holds("split", &format!("{KNIT}k0 s1 k2 k3 b1 {KNIT}{KNIT}"), &[4.4, 6.0, 10.0]);
}

#[test]
fn plated_yarns_hold_one_another() {
    holds("plated jersey", &PLATED.repeat(4), &[4.4, 6.0, 10.0]);
    let purl = "f0 f1 f2 f3 P0 P1 P2 P3 P0 P1 P2 P3 b0 b1 b2 b3";
    holds("plated garter", &format!("{PLATED}{PLATED}{purl}"), &[4.4, 6.0, 10.0]);
    // Two yarns in each stitch of rib need more room.
    holds("plated rib", &"K0 P1 K2 P3 ".repeat(4), &[10.0]);
}

#[test]
fn dropped_stitches_are_held_by_nothing() {
    holds("dropped", &format!("{KNIT}{KNIT}d1 {KNIT}{KNIT}"), &[4.4, 6.0, 10.0]);
    holds("dropped, then missed", &format!("{KNIT}{KNIT}d1 k0 m1 k2 k3 {KNIT}{KNIT}"), &[4.4, 6.0, 10.0]);
    holds("dropped twice", &format!("{KNIT}{KNIT}d1 {KNIT}d1 {KNIT}{KNIT}"), &[4.4, 6.0, 10.0]);
}
