//! Laws that hold for every program: no loop is lost, and none is made without an operation.

use std::collections::HashMap;

use proptest::prelude::*;
use texere_fabric::FabricError;
use texere_fabric::weft::{
    Bed, CarrierSet, Direction, Fate, FaultKind, Instruction, Knit, LoopKind, LoopRef, Machine, Needle,
    Operation, Program, Step, Stitch, Stitches, WeftError,
};

use crate::naive::{self, Id, Known};

const CARRIERS: u32 = 3;

/// Rounds that the naive machine runs of a repeat. The loops of the middle round are compared.
const ROUNDS: i32 = 24;

fn needles(range: std::ops::Range<i32>) -> impl Strategy<Value = Needle> + Clone {
    (any::<bool>(), prop::bool::weighted(0.1), range).prop_map(|(front, slider, number)| Needle {
        bed: if front { Bed::Front } else { Bed::Back },
        slider,
        number,
    })
}

fn instructions(range: std::ops::Range<i32>) -> impl Strategy<Value = Instruction> {
    let needle = needles(range.clone());
    let pair = (needle.clone(), needles(range))
        .prop_map(|(from, to)| (from, Needle { bed: from.bed.other(), ..to }));
    let direction = any::<bool>().prop_map(|right| if right { Direction::Right } else { Direction::Left });
    let racks = prop::sample::select(vec![-2.0, -0.75, 0.0, 0.25, 0.5, 1.0, 3.0]);
    prop_oneof![
        6 => (direction.clone(), needle.clone()).prop_map(|(way, needle)| Instruction::Knit(way, needle)),
        3 => (direction.clone(), needle.clone()).prop_map(|(way, needle)| Instruction::Tuck(way, needle)),
        1 => (direction.clone(), needle.clone()).prop_map(|(way, needle)| Instruction::Miss(way, needle)),
        2 => (direction, pair.clone()).prop_map(|(way, (from, to))| Instruction::Split(way, from, to)),
        3 => pair.prop_map(|(from, to)| Instruction::Transfer(from, to)),
        1 => needle.prop_map(Instruction::Drop),
        1 => racks.prop_map(Instruction::Rack),
        1 => prop::sample::select(vec![
            Instruction::In,
            Instruction::Out,
            Instruction::InHook,
            Instruction::OutHook,
            Instruction::ReleaseHook,
        ]),
    ]
}

/// The sets of carriers of all programs in this file.
fn sets() -> Vec<Vec<u32>> {
    vec![vec![], vec![0], vec![1], vec![2], vec![0, 1], vec![2, 1, 0]]
}

fn program(instructions: Vec<(Instruction, u32)>, repeat: Option<u32>) -> Program {
    let operation = |(source, (instruction, set))| {
        let bare =
            matches!(instruction, Instruction::Drop(_) | Instruction::Transfer(..) | Instruction::Rack(_));
        Operation { instruction, carriers: CarrierSet(if bare { 0 } else { set }), source }
    };
    Program {
        carriers: (0..CARRIERS).map(|carrier| carrier.to_string()).collect(),
        carrier_sets: sets(),
        operations: (0..).zip(instructions).map(operation).collect(),
        repeat,
    }
}

pub(crate) fn programs() -> impl Strategy<Value = Program> {
    let sets = sets().len() as u32;
    prop::collection::vec((instructions(-3..6), 0..sets), 0..60).prop_map(|list| program(list, None))
}

/// Programs of one repeat. Most of them knit all needles at the end, so that loops do not pile up.
fn repeats() -> impl Strategy<Value = Program> {
    (1..4_i32, 0..8_u32).prop_flat_map(|(width, knits)| {
        let sets = sets().len() as u32;
        let stays = |instruction: &Instruction| !matches!(instruction, Instruction::In | Instruction::InHook);
        let any = instructions(-width..2 * width).prop_filter("no carrier is brought in", stays);
        prop::collection::vec((any, 0..sets), 0..25).prop_map(move |mut list| {
            for needle in (0..width).flat_map(|number| [Needle::front(number), Needle::back(number)]) {
                for needle in [needle, Needle { slider: true, ..needle }] {
                    if knits > 0 {
                        list.push((Instruction::Knit(Direction::Right, needle), 1));
                    }
                }
            }
            program(list, Some(width as u32))
        })
    })
}

/// The source and the plate of each loop that a program makes.
fn made(program: &Program) -> Vec<(u32, u16)> {
    let loops = |operation: &Operation| match operation.instruction {
        Instruction::Knit(..) | Instruction::Tuck(..) | Instruction::Split(..) => {
            program.carrier_sets[operation.carriers.0 as usize].len()
        }
        _ => 0,
    };
    let of = |operation: &Operation| {
        (0..loops(operation) as u16).map(|plate| (operation.source, plate)).collect::<Vec<_>>()
    };
    program.operations.iter().flat_map(of).collect()
}

/// For each loop of the stitches, its number among all loops that the program makes. Loops that
/// nothing holds are left out of the stitches.
fn names(program: &Program, stitches: &Stitches) -> Vec<usize> {
    let made = made(program);
    let name = |stitch: &Stitch| made.iter().position(|&loops| loops == (stitch.source, stitch.plate));
    stitches.loops.iter().map(|stitch| name(stitch).expect("a loop of the program")).collect()
}

fn back(other: LoopRef, number: usize) -> LoopRef {
    LoopRef { number: number as u32, repeat: other.repeat.map(|repeats| -repeats) }
}

/// Checks the laws for all stitches. They do not hold for a repeat with needles that never knit.
fn lawful(program: &Program, stitches: &Stitches) -> Result<(), TestCaseError> {
    prop_assert!(names(program, stitches).is_sorted_by(|one, other| one < other), "loops in their order");
    let mut seen = vec![0; stitches.loops.len()];
    for strand in &stitches.strands {
        let mut last = None;
        for step in &strand.steps {
            let Step::Loop { number, direction } = *step else { continue };
            let stitch = &stitches.loops[number as usize];
            seen[number as usize] += 1;
            prop_assert!(last.is_none_or(|last| last < number), "a yarn makes its loops in order");
            last = Some(number);
            let operation = &program.operations[stitch.source as usize];
            let set = &program.carrier_sets[operation.carriers.0 as usize];
            prop_assert_eq!(set[usize::from(stitch.plate)], strand.carrier);
            let (Instruction::Knit(way, _) | Instruction::Tuck(way, _) | Instruction::Split(way, ..)) =
                operation.instruction
            else {
                return Err(TestCaseError::fail("a loop of no stitch"));
            };
            prop_assert_eq!(way, direction);
        }
    }
    prop_assert!(seen.iter().all(|times| *times == 1), "every loop belongs to one yarn");
    let height = stitches.repeat.map_or(0, |[_, height]| height as i32);
    for (number, stitch) in stitches.loops.iter().enumerate() {
        if let Fate::Held(child) = stitch.fate {
            prop_assert!(stitches.parents_of(child.number).contains(&back(child, number)));
            prop_assert_eq!(stitches.loops[child.number as usize].plate, 0);
        }
        let first = number.saturating_sub(stitch.plate.into());
        for &parent in stitches.parents_of(number as u32) {
            let below = &stitches.loops[parent.number as usize];
            if stitch.kind == LoopKind::Knit {
                prop_assert_eq!(below.fate, Fate::Held(back(parent, first)));
            }
            let course = below.course as i32 + parent.repeat[1] * height;
            prop_assert!(course < stitch.course as i32, "a loop lies above what it is drawn through");
        }
    }
    Ok(())
}

/// The number of repeats on each side of the middle one. With so many, the edges of the naive
/// machine's cloth do not reach the loops that are compared. In each round a loop travels at most
/// as far as all transfers of one direction together. An edge's effect travels inwards in all
/// rounds. A loop of the middle round travels towards the edge in half of the rounds.
fn sides(program: &Program) -> i32 {
    let travel = |way: i32| {
        let of = |operation: &Operation| match operation.instruction {
            Instruction::Transfer(from, to) | Instruction::Split(_, from, to) => {
                (way * (to.number - from.number)).max(0)
            }
            _ => 0,
        };
        program.operations.iter().map(of).sum::<i32>()
    };
    let (left, right) = (travel(-1), travel(1));
    let needles = ROUNDS * left.max(right) + ROUNDS / 2 * left.min(right);
    // The needles that a repeat names lie up to two repeats from it.
    needles / program.repeat.map_or(1, |width| width as i32) + 3
}

/// Compares stitches with the loops that the naive machine has in `round` and repeat 0.
fn compare(
    program: &Program,
    stitches: &Stitches,
    naive: &HashMap<Id, Known>,
    round: i32,
) -> Result<(), TestCaseError> {
    let names = names(program, stitches);
    // A loop that is left out of the stitches was drawn through nothing and fell, and nothing was
    // drawn through it.
    for name in (0..made(program).len()).filter(|name| names.binary_search(name).is_err()) {
        let known = &naive[&(name, 0, round)];
        prop_assert!(known.dropped && known.held.is_none() && known.parents.is_empty(), "loop {}", name);
    }
    let seen = |&(name, side, other): &Id| LoopRef {
        number: names.binary_search(&name).expect("a loop that is held") as u32,
        repeat: [side, other - round],
    };
    for (number, stitch) in stitches.loops.iter().enumerate() {
        let known = &naive[&(names[number], 0, round)];
        let parents: Vec<_> = known.parents.iter().map(seen).collect();
        prop_assert_eq!(stitches.parents_of(number as u32), parents, "loop {}", number);
        let fate = match known.held.as_ref() {
            Some(child) => Fate::Held(seen(child)),
            None if known.dropped => Fate::Dropped,
            None => Fate::OnNeedle,
        };
        prop_assert_eq!(stitch.fate, fate, "loop {}", number);
        prop_assert_eq!(f64::from(stitch.at), known.at);
        let head = (f64::from(stitch.head.at), stitch.head.bed, usize::from(stitch.head.layer));
        prop_assert_eq!(head, known.head, "loop {}", number);
        let strand = stitches.strands.iter().find(|strand| {
            strand
                .steps
                .iter()
                .any(|step| matches!(*step, Step::Loop { number: own, .. } if own as usize == number))
        });
        prop_assert_eq!(strand.map(|strand| strand.carrier), Some(known.carrier));
    }
    Ok(())
}

proptest! {
    #[test]
    fn programs_lose_no_loop(program in programs()) {
        let Knit { stitches, .. } = Machine::default().knit(&program).expect("a knit");
        lawful(&program, &stitches)?;
        compare(&program, &stitches, &naive::run(&program, 1, 0), 0)?;
    }

    #[test]
    fn repeats_lose_no_loop(program in repeats()) {
        let Knit { stitches, faults, .. } = match Machine::default().knit(&program) {
            Ok(knit) => knit,
            Err(error) => {
                prop_assert!(matches!(error, FabricError::Weft(WeftError::KnitSize { what: "loops on a needle", .. })), "{}", error);
                return Ok(());
            }
        };
        if faults.iter().any(|fault| fault.kind == FaultKind::NeverKnits) {
            prop_assert!(stitches.loops.len() <= made(&program).len());
            return Ok(());
        }
        lawful(&program, &stitches)?;
        compare(&program, &stitches, &naive::run(&program, ROUNDS, sides(&program)), ROUNDS / 2)?;
    }
}

/// The loops of this repeat go two needles to the left in each round, and all of them fall. Only at
/// the edge of the cloth does nothing clear a needle. The loop that is left there travels inwards.
#[test]
fn loops_that_travel_come_from_within_the_cloth() {
    let list = [
        Instruction::Split(Direction::Left, Needle::back(0), Needle::front(-1)),
        Instruction::Drop(Needle::back(-1)),
        Instruction::Transfer(Needle::front(0), Needle::back(-1)),
    ];
    let program = program(list.map(|instruction| (instruction, 1)).to_vec(), Some(1));
    let stitches = Machine::default().knit(&program).expect("a knit").stitches;
    compare(&program, &stitches, &naive::run(&program, ROUNDS, sides(&program)), ROUNDS / 2).expect("loops");
}
