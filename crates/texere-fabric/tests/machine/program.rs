//! Programs written in the words of knitout, for tests. The text is not checked.

use texere_fabric::weft::{Bed, CarrierSet, Direction, Instruction, Needle, Operation, Program};

/// A program of carriers `1` to `4`. Its sources are the numbers of lines, counted from 1.
pub(crate) fn program(text: &str) -> Program {
    let mut program = Program {
        carriers: (1..5).map(|name| name.to_string()).collect(),
        carrier_sets: vec![Vec::new()],
        ..Program::default()
    };
    for (line, text) in (1..).zip(text.trim().lines()) {
        let words: Vec<_> = text.split_whitespace().collect();
        let direction = if words.get(1) == Some(&"-") { Direction::Left } else { Direction::Right };
        let (instruction, from) = match words[0] {
            "in" => (Instruction::In, 1),
            "inhook" => (Instruction::InHook, 1),
            "releasehook" => (Instruction::ReleaseHook, 1),
            "out" => (Instruction::Out, 1),
            "outhook" => (Instruction::OutHook, 1),
            "knit" => (Instruction::Knit(direction, needle(words[2])), 3),
            "tuck" => (Instruction::Tuck(direction, needle(words[2])), 3),
            "miss" => (Instruction::Miss(direction, needle(words[2])), 3),
            "split" => (Instruction::Split(direction, needle(words[2]), needle(words[3])), 4),
            "drop" => (Instruction::Drop(needle(words[1])), 2),
            "xfer" => (Instruction::Transfer(needle(words[1]), needle(words[2])), 3),
            "rack" => (Instruction::Rack(words[1].parse().expect("a rack")), 2),
            word => panic!("{word}"),
        };
        let set: Vec<u32> =
            words[from..].iter().map(|name| name.parse::<u32>().expect("a carrier") - 1).collect();
        let number = program.carrier_sets.iter().position(|other| *other == set).unwrap_or_else(|| {
            program.carrier_sets.push(set);
            program.carrier_sets.len() - 1
        });
        program.operations.push(Operation { instruction, carriers: CarrierSet(number as u32), source: line });
    }
    program
}

fn needle(text: &str) -> Needle {
    let bed = if text.starts_with('f') { Bed::Front } else { Bed::Back };
    let slider = text[1..].starts_with('s');
    Needle { bed, slider, number: text[1 + usize::from(slider)..].parse().expect("a needle") }
}
