//! Refusals that name what is too large, and large programs that take time in proportion to their
//! length.

use texere_fabric::FabricError;
use texere_fabric::weft::{
    CarrierSet, Direction, Instruction, LoopKind, Machine, NEEDLE_MAX, Needle, Operation, Program, STACK_MAX,
    WeftError,
};

fn program(instructions: impl Iterator<Item = Instruction>) -> Program {
    let operation = |instruction| Operation { instruction, carriers: CarrierSet(1), source: 0 };
    Program {
        carriers: vec!["1".into()],
        carrier_sets: vec![vec![], vec![0]],
        operations: instructions.map(operation).collect(),
        repeat: None,
    }
}

fn refused(program: &Program) -> FabricError {
    Machine::default().knit(program).expect_err("a refusal")
}

#[test]
fn what_is_too_large_is_refused() {
    let knit = |number| Instruction::Knit(Direction::Right, Needle::front(number));
    for number in [NEEDLE_MAX + 1, -NEEDLE_MAX - 1, i32::MAX, i32::MIN] {
        let needle = Needle::front(number);
        let error = FabricError::Weft(WeftError::KnitNeedle { needle, limit: NEEDLE_MAX, operation: 2 });
        assert_eq!(refused(&program([knit(0), knit(number)].into_iter())), error);
    }
    assert!(Machine::default().knit(&program([knit(NEEDLE_MAX), knit(-NEEDLE_MAX)].into_iter())).is_ok());

    let tuck = Instruction::Tuck(Direction::Right, Needle::back(3));
    let error = refused(&program(std::iter::repeat_n(tuck, STACK_MAX + 1)));
    assert!(
        matches!(
            error,
            FabricError::Weft(WeftError::KnitSize { what: "loops on a needle", operation: 257, .. })
        ),
        "{error}"
    );

    for (width, taken) in [(0, false), (1, true), (NEEDLE_MAX as u32, true), (u32::MAX, false)] {
        let one = Program { repeat: Some(width), ..program([knit(0)].into_iter()) };
        assert_eq!(Machine::default().knit(&one).is_ok(), taken, "{width}");
    }
}

#[test]
fn carriers_that_there_are_not_are_refused() {
    let mut one = program([Instruction::In].into_iter());
    one.operations[0].carriers = CarrierSet(2);
    assert_eq!(refused(&one), FabricError::Weft(WeftError::KnitCarriers { operation: 1 }));
    one.carrier_sets.push(vec![0, 7]);
    assert_eq!(refused(&one), FabricError::Weft(WeftError::KnitCarriers { operation: 1 }));
    assert!(Machine::default().knit(&Program::default()).is_ok());
}

#[test]
fn racks_that_are_no_numbers_are_faults_and_move_nothing() {
    for rack in [f64::NAN, f64::INFINITY, -1e300] {
        let knit = Instruction::Knit(Direction::Right, Needle::back(3));
        let all = [Instruction::In, Instruction::Rack(rack), knit].into_iter();
        let knit = Machine::default().knit(&program(all)).expect("a knit");
        assert!(knit.faults[0].kind.is_error());
        assert_eq!(knit.stitches.loops[0].at, 3.0);
    }
}

/// Programs of 300,000 to three million operations. If one operation took time that grows with the
/// program, this test would not end.
#[test]
fn large_programs_are_run_in_time_that_grows_with_them() {
    const COUNT: i32 = 3_000_000;
    let right = Direction::Right;
    let knit = |place: i32| Instruction::Knit(right, Needle::front(place % 1000));
    let all = Machine::default().knit(&program((0..COUNT).map(knit))).expect("a knit").stitches;
    assert_eq!(all.loops.len(), COUNT as usize);
    assert_eq!(all.loops.last().map(|stitch| stitch.course), Some(2999));

    // A full needle whose loops are moved to and fro.
    let tucks = (0..STACK_MAX as i32).map(|_| Instruction::Tuck(right, Needle::front(0)));
    let moves = (0..COUNT / 10).flat_map(|_| {
        let (front, back) = (Needle::front(0), Needle::back(0));
        [Instruction::Transfer(front, back), Instruction::Transfer(back, front)]
    });
    assert!(Machine::default().knit(&program(tucks.chain(moves))).is_ok());

    // A hook that takes 60,000 carriers at once, then one of them many times, and releases that one
    // many times.
    let hooks = (0..COUNT / 10).map(|_| Instruction::InHook);
    let mut hooks = program(hooks.chain((0..COUNT / 10).map(|_| Instruction::ReleaseHook)));
    let names = 0..60_000;
    hooks.carriers = names.clone().map(|name| name.to_string()).collect();
    hooks.carrier_sets.push(names.collect());
    for operation in &mut hooks.operations[..2] {
        operation.carriers = CarrierSet(2);
    }
    assert!(Machine::default().knit(&hooks).is_ok());

    // Passes of one stitch each, in a repeat.
    let narrow = Program { repeat: Some(1), ..program((0..COUNT / 10).map(|_| knit(0))) };
    let all = Machine::default().knit(&narrow).expect("a knit").stitches;
    assert_eq!(all.repeat, Some([1, COUNT as u32 / 10]));
    assert!(all.loops.iter().all(|stitch| stitch.kind == LoopKind::Knit));
    assert_eq!(all.strands.len(), all.loops.len(), "each goes on into the repeat beside");
}
