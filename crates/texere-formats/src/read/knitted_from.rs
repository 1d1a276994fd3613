//! The program of a weft knit. It is kept to say which line or cell a piece of yarn comes from, and
//! to write the design again.

use std::path::PathBuf;

use texere_fabric::weft::{Backing, CarrierSet, Chart, Operation, Program};

use super::FilePlace;
use super::error::named;
use super::program_place::ProgramPlace;

/// What the number in [`Operation::source`] stands for: a line of a file, or a cell of a chart.
#[derive(Debug, Clone)]
pub(crate) enum Drawn {
    /// Lines of a file, counted from 1.
    Lines { file: PathBuf, head: ProgramHead },
    /// Cells of a chart or an image, counted from 0, row by row from the left. The first row is the
    /// bottom row, or the top row if `upside_down`.
    Cells { file: PathBuf, chart: Chart, legend: Legend, upside_down: bool },
}

/// What a knitout file says of its machine. It makes no difference to the cloth, but a machine
/// needs it.
#[derive(Debug, Clone, Default)]
pub(crate) struct ProgramHead {
    /// The machine that the file is for.
    pub(crate) machine: Option<String>,
    /// The place of the knit on the bed.
    pub(crate) position: Option<String>,
    /// The stitch size of each [`Instruction::LoopLength`](texere_fabric::weft::Instruction), in
    /// the order of the operations.
    pub(crate) sizes: Vec<StitchSize>,
}

/// A stitch size in a machine's own units.
#[derive(Debug, Clone, Copy)]
pub(crate) enum StitchSize {
    /// The number behind `x-stitch-number`.
    Number(f64),
    /// Both numbers behind `stitch`.
    Drawn([f64; 2]),
}

/// What the cells of a drawing stand for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Legend {
    /// Stitches.
    Stitches,
    /// Yarns: the drawing is the face of a Jacquard.
    Yarns(Option<Backing>),
}

impl Drawn {
    /// The line or cell of a source, in a designer's words.
    pub(super) fn place(&self, source: u32) -> String {
        match self {
            Self::Lines { file, .. } => format!("{}, line {source}", named(file)),
            Self::Cells { file, chart, upside_down, .. } => {
                let (row, column) = (source as usize / chart.wales(), source as usize % chart.wales());
                let row = if *upside_down { row + 1 } else { chart.rows().saturating_sub(row) };
                format!("{}, row {row} from the top, column {}", named(file), column + 1)
            }
        }
    }
}

/// A program, and the file, chart or image that its operations come from.
#[derive(Debug, Clone)]
pub(crate) struct KnittedFrom {
    pub(crate) drawn: Drawn,
    pub(crate) program: Program,
    /// The most needles that a yarn may float past without a warning, or none if the design does
    /// not say.
    pub(crate) float_max: Option<u32>,
}

impl KnittedFrom {
    /// The line of a knitout file that a source stands for. None for a chart or an image, because
    /// errors name it as a whole.
    pub(super) fn line(&self, source: u32) -> Option<FilePlace> {
        let Drawn::Lines { file, .. } = &self.drawn else { return None };
        Some(FilePlace::new(file, source as usize, &self.program_place(source).instructions.join("; ")))
    }

    /// The place that a source stands for, and the instructions of its operations.
    pub(super) fn program_place(&self, source: u32) -> ProgramPlace {
        let carriers = |CarrierSet(set): CarrierSet| {
            let set = self.program.carrier_sets.get(set as usize).into_iter().flatten();
            set.filter_map(|&carrier| self.program.carriers.get(carrier as usize))
        };
        let written = |operation: &Operation| {
            let carriers = carriers(operation.carriers).map(|name| format!(" {name}"));
            format!("{}{}", operation.instruction, carriers.collect::<String>())
        };
        let mut instructions: Vec<String> = Vec::new();
        for operation in self.program.operations.iter().filter(|operation| operation.source == source) {
            let written = written(operation);
            if !instructions.contains(&written) {
                instructions.push(written);
            }
        }
        ProgramPlace { place: self.drawn.place(source), instructions }
    }
}
