//! Makes a design from a knitting program. The machine knits the program, and the program's faults
//! are listed.

use std::mem::{Discriminant, discriminant};
use std::path::Path;

use texere_core::{Material, Section, counted};
use texere_fabric::weft::{
    Cells, FaultKind, Gauge, Knit as Made, KnitYarn, Knitted, Machine, Program, WeftError,
};
use texere_fabric::{FabricError, Structure, Thread};

use super::error::named;
use super::knitted_from::{Drawn, KnittedFrom};
use super::machine_fault::MachineFault;
use super::threads::only_used;
use super::{Design, ReadError};

/// The most faults of each kind that are listed.
const FAULTS_LISTED: usize = 3;

/// A weft knit, apart from its program.
#[derive(Debug)]
pub(super) struct Knit {
    pub(super) gauge: Gauge,
    /// The yarn of each carrier.
    pub(super) yarns: Vec<KnitYarn>,
    pub(super) materials: Vec<Material>,
    pub(super) sections: Vec<Section>,
    pub(super) copies: [u32; 2],
    pub(super) cells: Cells,
    /// The most needles that a yarn may float past without a warning, or none if the design does
    /// not say.
    pub(super) float_max: Option<u32>,
}

impl Knit {
    /// The yarns of carriers, with their materials and sections. `compression` is the share of its
    /// diameter that a yarn keeps.
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

    /// Knits the program on a machine, and makes a design of the stitches. `file` is the path of
    /// the design.
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
        let (faults, more) = listed(&knit, &drawn);
        warnings.extend(faults.iter().map(|fault| fault.message.clone()));
        if more > 0 {
            let more = counted(more, "more fault");
            warnings.push(format!("{}: {more} of these kinds", named(file)));
        }
        let refused = |error: FabricError| match (&error, &drawn) {
            (FabricError::Weft(WeftError::KnitRuns { operation: Some(source), .. }), Drawn::Lines { .. }) => {
                ReadError::Operation { place: drawn.place(*source), source: error }
            }
            _ => fabric(error),
        };
        let knitted =
            Knitted::new(knit.stitches, self.gauge, self.yarns, self.materials, self.sections, self.copies)
                .map_err(refused)?
                .with_cells(self.cells);
        let design = Design::new(name, Structure::Weft(knitted), warnings);
        Ok(design.knitted(KnittedFrom { drawn, program, float_max: self.float_max }, faults))
    }
}

/// The first [`FAULTS_LISTED`] faults of each kind as a designer reads them, and the number of
/// faults that are left out.
fn listed(knit: &Made, drawn: &Drawn) -> (Vec<MachineFault>, u64) {
    let mut kinds: Vec<(Discriminant<FaultKind>, usize)> = Vec::new();
    let mut faults = Vec::new();
    for fault in &knit.faults {
        let kind = discriminant(&fault.kind);
        let place = kinds.iter().position(|(other, _)| *other == kind).unwrap_or(kinds.len());
        if place == kinds.len() {
            kinds.push((kind, 0));
        }
        kinds[place].1 += 1;
        if kinds[place].1 <= FAULTS_LISTED {
            let message = format!("{}: {fault}", drawn.place(fault.source));
            faults.push(MachineFault { message, is_error: fault.kind.is_error() });
        }
    }
    let more = (knit.faults.len() - faults.len()) as u64 + knit.unlisted;
    (faults, more)
}
