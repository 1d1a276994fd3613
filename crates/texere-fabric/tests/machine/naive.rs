//! A simple machine as an oracle, with code of its own. Every needle of every repeat has its own
//! list of loops, and the loops of all rounds are kept.

use std::collections::HashMap;

use texere_fabric::weft::{Bed, Instruction, Needle, Program};

/// A loop: its number within its round, its repeat along x, and its round.
pub(crate) type Id = (usize, i32, i32);

/// What is known of a loop.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Known {
    pub(crate) carrier: u32,
    pub(crate) at: f64,
    pub(crate) parents: Vec<Id>,
    /// The loop that holds this loop at the end.
    pub(crate) held: Option<Id>,
    pub(crate) dropped: bool,
    /// Place, bed and layer of the loop's head.
    pub(crate) head: (f64, Bed, usize),
}

/// Runs `rounds` rounds of a program, with `sides` repeats on each side.
pub(crate) fn run(program: &Program, rounds: i32, sides: i32) -> HashMap<Id, Known> {
    let width = program.repeat.map_or(0, |width| width as i32);
    let mut loops: HashMap<Id, Known> = HashMap::new();
    let mut needles: HashMap<Needle, Vec<Id>> = HashMap::new();
    let mut rack: f64 = 0.0;
    for round in 0..rounds {
        let mut count = 0;
        for operation in &program.operations {
            let set = program.carrier_sets[operation.carriers.0 as usize].clone();
            if let Instruction::Rack(to) = operation.instruction {
                rack = to;
            }
            for side in -sides..=sides {
                let here = |needle: Needle| Needle { number: needle.number + side * width, ..needle };
                let place = |needle: Needle| {
                    let half = if rack.fract() == 0.0 { 0.0 } else { 0.5 };
                    let shift = if needle.bed == Bed::Back { rack.floor() + half } else { 0.0 };
                    f64::from(needle.number) + shift
                };
                let hang = |needle: Needle, layer| (place(needle), needle.bed, layer);
                let ids: Vec<Id> = (0..set.len()).map(|plate| (count + plate, side, round)).collect();
                let new = |needle: Needle, parents: &[Id]| {
                    let known = |carrier: &u32| Known {
                        carrier: *carrier,
                        at: place(needle),
                        parents: parents.to_vec(),
                        held: None,
                        dropped: false,
                        head: hang(needle, 0),
                    };
                    ids.iter().copied().zip(set.iter().map(known)).collect::<Vec<_>>()
                };
                match operation.instruction {
                    Instruction::Knit(_, needle) | Instruction::Drop(needle) => {
                        let needle = here(needle);
                        let old = needles.remove(&needle).unwrap_or_default();
                        for (layer, id) in old.iter().enumerate() {
                            let known = loops.get_mut(id).expect("a loop");
                            known.head = hang(needle, layer);
                            if let Some(&first) = ids.first() {
                                known.held = Some(first);
                            } else {
                                known.dropped = known.held.is_none();
                            }
                        }
                        if !ids.is_empty() {
                            loops.extend(new(needle, &old));
                            needles.insert(needle, ids);
                        }
                    }
                    Instruction::Tuck(_, needle) => {
                        loops.extend(new(here(needle), &[]));
                        needles.entry(here(needle)).or_default().extend(ids);
                    }
                    Instruction::Transfer(from, to) | Instruction::Split(_, from, to) if from != to => {
                        let (from, to) = (here(from), here(to));
                        let old = needles.remove(&from).unwrap_or_default();
                        if let Some(&first) = ids.first() {
                            loops.extend(new(from, &old));
                            for id in &old {
                                loops.get_mut(id).expect("a loop").held = Some(first);
                            }
                        }
                        needles.entry(to).or_default().extend(old.into_iter().rev());
                        needles.entry(from).or_default().extend(ids);
                    }
                    _ => {}
                }
            }
            count += match operation.instruction {
                Instruction::Knit(..) | Instruction::Tuck(..) | Instruction::Split(..) => set.len(),
                _ => 0,
            };
        }
    }
    for (needle, stack) in needles {
        let shift = if needle.bed == Bed::Back { rack.floor() } else { 0.0 };
        let half = if needle.bed == Bed::Back && rack.fract() != 0.0 { 0.5 } else { 0.0 };
        for (layer, id) in stack.into_iter().enumerate() {
            let known = loops.get_mut(&id).expect("a loop");
            known.head = (f64::from(needle.number) + shift + half, needle.bed, layer);
            known.held = None;
        }
    }
    loops
}
