//! The operations of a knitout file.

use std::collections::BTreeSet;

use texere_core::backend::room_for;
use texere_fabric::weft::{CarrierSet, Instruction, Operation, Program};

use super::carriers::Carriers;
use super::limits::OPERATIONS_MAX;
use super::line::{Line, Words};
use super::loop_lengths::{LoopLengths, size_of_numbers};
use super::warnings::Warnings;
use crate::read::ReadError;
use crate::read::error::shown;
use crate::read::knitted_from::StitchSize;

/// The carrier set of an operation without yarns.
const NO_CARRIERS: CarrierSet = CarrierSet(0);

const OPERATION: &str = "an operation of knitout: in, inhook, releasehook, out, outhook, stitch, rack, knit, tuck, split, drop, \
                         amiss, xfer, miss, pause or x-…";

/// Operations as they are read, line by line.
#[derive(Debug)]
pub(super) struct Operations<'a> {
    carriers: Carriers<'a>,
    lengths: &'a LoopLengths,
    /// The fractions of a rack that stand for half a needle.
    all_needle_racks: &'static [f64],
    operations: Vec<Operation>,
    /// The size of each operation that sets the size of stitches.
    sizes: Vec<StitchSize>,
    /// The first stitch size without a length, with its line.
    unsized_first: Option<(String, usize)>,
    /// Whether another stitch size without a length occurs.
    unsized_others: bool,
    /// Stitch sizes that have a length and occur in an operation.
    sized: BTreeSet<String>,
}

impl<'a> Operations<'a> {
    pub(super) fn new(
        carriers: Carriers<'a>,
        lengths: &'a LoopLengths,
        all_needle_racks: &'static [f64],
    ) -> Self {
        Self {
            carriers,
            lengths,
            all_needle_racks,
            operations: Vec::new(),
            sizes: Vec::new(),
            unsized_first: None,
            unsized_others: false,
            sized: BTreeSet::new(),
        }
    }

    /// Reads a line, which may have no operation.
    pub(super) fn read(&mut self, line: &Line<'a>, warnings: &mut Warnings) -> Result<(), ReadError> {
        let mut words = line.words();
        let Some(code) = words.next() else { return Ok(()) };
        let operation = match code {
            "in" => self.yarns(line, words, Instruction::In, warnings)?,
            "inhook" => self.yarns(line, words, Instruction::InHook, warnings)?,
            "releasehook" => self.yarns(line, words, Instruction::ReleaseHook, warnings)?,
            "out" => self.yarns(line, words, Instruction::Out, warnings)?,
            "outhook" => self.yarns(line, words, Instruction::OutHook, warnings)?,
            "knit" => {
                let (direction, needle) = (words.direction()?, words.needle()?);
                match self.carriers.set(words)? {
                    Some(set) => Some((Instruction::Knit(direction, needle), set)),
                    None => Some((Instruction::Drop(needle), NO_CARRIERS)),
                }
            }
            "tuck" => {
                let (direction, needle) = (words.direction()?, words.needle()?);
                self.carriers.set(words)?.map(|set| (Instruction::Tuck(direction, needle), set))
            }
            "miss" => {
                let (direction, needle) = (words.direction()?, words.needle()?);
                self.carriers.set(words)?.map(|set| (Instruction::Miss(direction, needle), set))
            }
            "split" => {
                let (direction, from, to) = (words.direction()?, words.needle()?, words.needle()?);
                match self.carriers.set(words)? {
                    Some(set) => Some((Instruction::Split(direction, from, to), set)),
                    None => Some((Instruction::Transfer(from, to), NO_CARRIERS)),
                }
            }
            "xfer" => {
                let (from, to) = (words.needle()?, words.needle()?);
                words.end()?;
                Some((Instruction::Transfer(from, to), NO_CARRIERS))
            }
            "drop" => {
                let needle = words.needle()?;
                words.end()?;
                Some((Instruction::Drop(needle), NO_CARRIERS))
            }
            "amiss" => {
                words.needle()?;
                words.end()?;
                None
            }
            "rack" => {
                let (rack, word) = words.number("by how many needles the back bed is moved")?;
                words.end()?;
                Some((Instruction::Rack(self.rack(line, rack, word, warnings)), NO_CARRIERS))
            }
            "stitch" => {
                let expected = "how far needles are drawn back, in units of the machine";
                let size = StitchSize::Drawn([words.number(expected)?.0, words.number(expected)?.0]);
                words.end()?;
                Some(self.stitch_size(line, size)?)
            }
            "x-stitch-number" => {
                let (number, _) = words.number("a number in the machine's table of stitches")?;
                words.end()?;
                Some(self.stitch_size(line, StitchSize::Number(number))?)
            }
            "pause" => {
                words.end()?;
                None
            }
            _ if code.starts_with("x-") => {
                let said = format!("extension \"{}\" is not known; it is left out", shown(code));
                warnings.once(code, line.number, &said);
                None
            }
            _ => return Err(line.refused(code, OPERATION)),
        };
        match operation {
            Some((instruction, carriers)) => self.push(line, code, instruction, carriers),
            None => Ok(()),
        }
    }

    /// Reads the carriers of an operation that brings yarns in or out, or releases them from a
    /// hook.
    fn yarns(
        &mut self,
        line: &Line<'a>,
        mut words: Words<'a>,
        instruction: Instruction,
        warnings: &mut Warnings,
    ) -> Result<Option<(Instruction, CarrierSet)>, ReadError> {
        if words.pass_place()? {
            let said = "direction and needle before the carriers, as old files have them; they are left out";
            warnings.once("place", line.number, said);
        }
        match self.carriers.set(words)? {
            Some(set) => Ok(Some((instruction, set))),
            None => {
                let end = line.text.split(';').next().unwrap_or_default().trim_end();
                Err(line.refused(&end[end.len()..], "at least one carrier"))
            }
        }
    }

    /// The rack that `word` writes, in needles. Any fraction of a needle becomes half a needle, at
    /// which back needles lie halfway between front needles.
    fn rack(&self, line: &Line<'_>, rack: f64, word: &str, warnings: &mut Warnings) -> f64 {
        let (whole, fraction) = (rack.floor(), rack - rack.floor());
        if fraction == 0.0 {
            return rack;
        }
        if !self.all_needle_racks.contains(&fraction) {
            let usual: Vec<_> = self.all_needle_racks.iter().map(ToString::to_string).collect();
            let said = format!(
                "rack {}, where {} beyond a whole number is usual; it is taken as half a needle",
                shown(word),
                usual.join(" or ")
            );
            warnings.once("rack", line.number, &said);
        }
        whole + 0.5
    }

    /// The instruction for a stitch size. The loops after it get the length of this size, or no
    /// length of their own if the size has none.
    fn stitch_size(
        &mut self,
        line: &Line<'_>,
        size: StitchSize,
    ) -> Result<(Instruction, CarrierSet), ReadError> {
        let count = self.sizes.len();
        if count == self.sizes.capacity() {
            room_for(&mut self.sizes, count.max(16), "stitch sizes of a knitting machine")?;
        }
        self.sizes.push(size);
        let size = match size {
            StitchSize::Number(number) => size_of_numbers(&[number]),
            StitchSize::Drawn(numbers) => size_of_numbers(&numbers),
        };
        let length = self.lengths.get(&size).copied();
        match &self.unsized_first {
            _ if length.is_some() => drop(self.sized.insert(size)),
            None => self.unsized_first = Some((size, line.number)),
            Some((first, _)) => self.unsized_others |= *first != size,
        }
        Ok((Instruction::LoopLength(length), NO_CARRIERS))
    }

    /// Stitch sizes that have a length but occur in no operation.
    pub(super) fn unused_sizes(&self) -> Vec<String> {
        self.lengths.keys().filter(|size| !self.sized.contains(*size)).cloned().collect()
    }

    fn push(
        &mut self,
        line: &Line<'_>,
        code: &str,
        instruction: Instruction,
        carriers: CarrierSet,
    ) -> Result<(), ReadError> {
        let count = self.operations.len();
        if count == OPERATIONS_MAX {
            return Err(line.refused(code, format!("{OPERATIONS_MAX} operations at most")));
        }
        if count == self.operations.capacity() {
            room_for(&mut self.operations, count.max(1024), "operations of a knitting machine")?;
        }
        self.operations.push(Operation { instruction, carriers, source: line.number as u32 });
        Ok(())
    }

    /// The program, its stitch sizes, and whether the header has no list of carriers.
    pub(super) fn finish(self, warnings: &mut Warnings) -> (Program, Vec<StitchSize>, bool) {
        match self.unsized_first {
            Some((size, line)) if !self.sized.is_empty() => {
                let said = format!(
                    "stitch size {size} has no length, and others have; its loops take that of all loops"
                );
                warnings.once("stitch sizes", line, &said);
            }
            // If all loops have one size, the size makes no difference.
            Some((_, line)) if self.unsized_others => {
                let said = "stitch sizes, which the machine's own table turns into lengths; loops without a length are all alike";
                warnings.once("stitch sizes", line, said);
            }
            _ => {}
        }
        let (carriers, carrier_sets, undeclared) = self.carriers.finish();
        let program = Program { carriers, carrier_sets, operations: self.operations, repeat: None };
        (program, self.sizes, undeclared)
    }
}
