//! The program of a weft knit, kept to say where its yarn comes from.

use std::path::PathBuf;

use texere_fabric::weft::{CarrierSet, Operation, Program};

use super::FilePlace;
use super::error::named;
use super::program_place::ProgramPlace;

/// What the source of each operation of a program numbers: lines of a file, or cells of a chart.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    /// Lines of a file, counted from 1.
    Lines { file: PathBuf },
    /// Cells of a chart or an image, counted from 0, row by row from the left. The first row is the
    /// bottom row, or the top row if `upside_down`.
    Cells { file: PathBuf, columns: usize, rows: usize, upside_down: bool },
}

impl Drawn {
    /// The line or cell of a source, in a designer's words.
    pub(super) fn place(&self, source: u32) -> String {
        match self {
            Self::Lines { file } => format!("{}, line {source}", named(file)),
            Self::Cells { file, columns, rows, upside_down } => {
                let (row, column) = (source as usize / columns, source as usize % columns);
                let row = if *upside_down { row + 1 } else { rows.saturating_sub(row) };
                format!("{}, row {row} from the top, column {}", named(file), column + 1)
            }
        }
    }
}

/// A program, and the file, chart or image that its operations come from.
#[derive(Debug, Clone)]
pub(super) struct KnittedFrom {
    pub(super) drawn: Drawn,
    pub(super) program: Program,
}

impl KnittedFrom {
    /// The line of a knitout file that a source stands for. None for a chart or an image, because
    /// errors name it as a whole.
    pub(super) fn line(&self, source: u32) -> Option<FilePlace> {
        let Drawn::Lines { file } = &self.drawn else { return None };
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
