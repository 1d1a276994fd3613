//! From a knitting program to a design: what the machine makes of it, and where its operations come
//! from.

use std::mem::{Discriminant, discriminant};
use std::path::{Path, PathBuf};

use texere_core::{Material, Section, counted};
use texere_fabric::weft::{
    CarrierSet, Cells, FaultKind, Gauge, Knit as Made, KnitYarn, Knitted, Machine, Operation, Program,
    WeftError,
};
use texere_fabric::{FabricError, Structure, Thread};

use super::design::{MachineFault, Told};
use super::error::named;
use super::threads::only_used;
use super::{Design, FilePlace, ReadError};

/// How many faults of a kind are told.
const FAULTS_TOLD: usize = 3;

/// What a knit is beside its program.
#[derive(Debug)]
pub(super) struct Knit {
    pub(super) gauge: Gauge,
    /// One for each carrier.
    pub(super) yarns: Vec<KnitYarn>,
    pub(super) materials: Vec<Material>,
    pub(super) sections: Vec<Section>,
    pub(super) copies: [u32; 2],
    pub(super) cells: Cells,
    /// How many needles a yarn may float past, where the design says so.
    pub(super) float_max: Option<u32>,
}

/// What the sources of a program's operations are.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    /// Lines of a file, from 1.
    Lines { file: PathBuf },
    /// Cells of a chart, row by row from the bottom, both from 0. In an image the bottom row may be
    /// the top one.
    Cells { file: PathBuf, columns: usize, rows: usize, upside_down: bool },
}

impl Drawn {
    /// A source as a designer finds it.
    fn place(&self, source: u32) -> String {
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

/// A program and where its operations come from.
#[derive(Debug, Clone)]
pub(super) struct KnittedFrom {
    drawn: Drawn,
    program: Program,
}

impl KnittedFrom {
    /// The line of a knitout file that a source is. None of a chart, which errors name as a whole.
    pub(super) fn line(&self, source: u32) -> Option<FilePlace> {
        let Drawn::Lines { file } = &self.drawn else { return None };
        Some(FilePlace::new(file, source as usize, &self.told(source).instructions.join("; ")))
    }

    /// Where operations come from, and what they do.
    pub(super) fn told(&self, source: u32) -> Told {
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
        Told { place: self.drawn.place(source), instructions }
    }
}

impl Knit {
    /// The yarns of carriers, with the materials and sections that they have. `compression` is what
    /// is left of their diameters.
    pub(super) fn yarns_of(
        mut threads: Vec<Thread>,
        compression: f64,
        materials: &[Material],
        sections: &[Section],
    ) -> (Vec<KnitYarn>, Vec<Material>, Vec<Section>) {
        let (materials, sections) = only_used([&mut threads, &mut []], materials, sections);
        let yarn = |thread: &Thread| KnitYarn {
            radius_mm: (f64::from(thread.radius_mm) * compression) as f32,
            material: thread.material,
            section: thread.section,
            twist: thread.twist,
        };
        (threads.iter().map(yarn).collect(), materials, sections)
    }

    /// Runs the program and makes a design of what comes of it. `file` is the design's own.
    pub(super) fn design(
        self,
        file: &Path,
        name: String,
        program: Program,
        drawn: Drawn,
        mut warnings: Vec<String>,
    ) -> Result<Design, ReadError> {
        let fabric = |error| ReadError::fabric(file, error);
        let usual = Machine::default();
        let machine = Machine { float_max: self.float_max.unwrap_or(usual.float_max), ..usual };
        let refused = |error: FabricError| {
            let number = match &error {
                FabricError::Weft(error) => error.operation(),
                _ => None,
            };
            let number = number.and_then(|number| usize::try_from(number - 1).ok());
            match number.and_then(|number| program.operations.get(number)) {
                Some(operation) => {
                    ReadError::Operation { place: drawn.place(operation.source), source: error }
                }
                None => fabric(error),
            }
        };
        let knit = machine.knit(&program).map_err(refused)?;
        let (faults, more) = told(&knit, &drawn);
        warnings.extend(faults.iter().map(|fault| fault.said.clone()));
        if more > 0 {
            let more = counted(more, "more fault");
            warnings.push(format!("{}: {more} of the kinds that are told", named(file)));
        }
        let refused = |error: FabricError| match (&error, &drawn) {
            (FabricError::Weft(WeftError::KnitRuns { told: Some(told), .. }), Drawn::Lines { .. }) => {
                ReadError::Operation { place: drawn.place(*told), source: error }
            }
            _ => fabric(error),
        };
        let knitted =
            Knitted::new(knit.stitches, self.gauge, self.yarns, self.materials, self.sections, self.copies)
                .map_err(refused)?
                .with_cells(self.cells);
        let design = Design::new(name, Structure::Weft(knitted), warnings);
        Ok(design.knitted(KnittedFrom { drawn, program }, faults))
    }
}

/// The faults of a program as a designer reads them, the first few of each kind, and how many more
/// there are.
fn told(knit: &Made, drawn: &Drawn) -> (Vec<MachineFault>, u64) {
    let mut kinds: Vec<(Discriminant<FaultKind>, usize)> = Vec::new();
    let mut faults = Vec::new();
    for fault in &knit.faults {
        let kind = discriminant(&fault.kind);
        let place = kinds.iter().position(|(other, _)| *other == kind).unwrap_or(kinds.len());
        if place == kinds.len() {
            kinds.push((kind, 0));
        }
        kinds[place].1 += 1;
        if kinds[place].1 <= FAULTS_TOLD {
            let said = format!("{}: {fault}", drawn.place(fault.source));
            faults.push(MachineFault { said, is_error: fault.kind.is_error() });
        }
    }
    let more = (knit.faults.len() - faults.len()) as u64 + knit.unlisted;
    (faults, more)
}
