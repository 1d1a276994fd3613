//! A knitout file: its program, its gauge and its yarns.

use std::path::Path;

use texere_core::Origin;
use texere_fabric::weft::{CarrierSet, Instruction, Operation, Program};

use super::carriers::Carriers;
use super::header::{self, Header};
use super::limits::FILE_MAX;
use super::line::Line;
use super::loop_lengths::LoopLengths;
use super::operations::Operations;
use super::warnings::Warnings;
use crate::read::ReadError;
use crate::read::file::{Files, bytes_of};
use crate::read::keys::{GAUGE, Keys};
use crate::read::knitted_from::ProgramHead;

/// A knitout file, read.
#[derive(Debug)]
pub(crate) struct KnitoutFile {
    pub(crate) program: Program,
    pub(crate) head: ProgramHead,
    /// Number of needles to the inch, or none if the header does not say.
    pub(crate) gauge: Option<f64>,
    /// The text of the header about the yarn in each carrier of the program.
    pub(crate) yarns: Vec<Option<String>>,
    pub(crate) warnings: Vec<String>,
    /// Stitch sizes that have a length but occur in no operation.
    pub(crate) unused_sizes: Vec<String>,
    pub(crate) keys: Keys,
}

impl KnitoutFile {
    /// For each carrier, whether an operation names it.
    pub(crate) fn used_carriers(&self) -> Vec<bool> {
        let mut used = vec![false; self.program.carriers.len()];
        // Every set occurs in an operation.
        for &carrier in self.program.carrier_sets.iter().flatten() {
            used[carrier as usize] = true;
        }
        used
    }
}

/// Reads the file in `path`. The sources of its operations are lines, counted from 1.
pub(crate) fn read(path: &Path, files: &Files<'_>, lengths: &LoopLengths) -> Result<KnitoutFile, ReadError> {
    parse(path, &bytes_of(files, path, FILE_MAX)?, lengths)
}

pub(super) fn parse(path: &Path, bytes: &[u8], lengths: &LoopLengths) -> Result<KnitoutFile, ReadError> {
    let mut warnings = Warnings::new(path);
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = String::from_utf8_lossy(bytes);
    if let Err(error) = std::str::from_utf8(bytes) {
        let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
        warnings.once(
            "utf-8",
            line,
            "not UTF-8, as knitout asks for; bytes that make no letter are read as U+FFFD",
        );
    }
    if let Some(at) = text.find('\r') {
        let line = text[..at].bytes().filter(|&byte| byte == b'\n').count() + 1;
        warnings.once(
            "carriage return",
            line,
            "a carriage return; lines of knitout end in a line feed alone",
        );
    }

    let mut lines = (1..).zip(text.lines()).peekable();
    header::magic(&mut lines, &mut warnings);
    let mut header = Header::default();
    // The header ends where operations begin. Empty lines and comments may stand in it.
    while let Some((number, text)) = lines.next_if(|(_, text)| is_comment(text)) {
        header.read(&Line::new(path, number, text), &mut warnings)?;
    }
    let mut operations =
        Operations::new(Carriers::new(header.carriers.as_deref()), lengths, header.all_needle_racks());
    for (number, text) in lines {
        let line = Line::new(path, number, text);
        operations.read(&line, &mut warnings)?;
        if header::name(text).is_some_and(|(name, _)| header::is_known(name)) {
            let said = "a header behind the first operation, where it is a comment; it is left out";
            warnings.once("late header", number, said);
        }
    }
    let unused_sizes = operations.unused_sizes();
    let (program, sizes, undeclared) = operations.finish(&mut warnings);
    if undeclared && !program.carriers.is_empty() {
        let said = "no header \";;Carriers: \", which knitout asks for; carriers are those that occur, in that order";
        warnings.once("carriers", 1, said);
    }
    let gauge = header.gauge.map(|(gauge, _)| gauge);
    let keys = keys(path, header.gauge.map(|(_, line)| line), &program);
    let head = header.head(sizes);
    let yarns = header.yarns_of(&program.carriers, &mut warnings);
    Ok(KnitoutFile { program, head, gauge, yarns, warnings: warnings.list(), unused_sizes, keys })
}

/// The lines that errors of the cloth name: the line of the gauge, the first operation of each
/// carrier, and the operation of the last loop. If no operation makes a loop, the first operation
/// with a carrier is named instead.
fn keys(path: &Path, gauge: Option<usize>, program: &Program) -> Keys {
    let (mut carriers, mut last, mut seen) = (Vec::new(), None, vec![false; program.carriers.len()]);
    let written = |(operation, carrier): (&Operation, u32)| {
        let written = format!("{} {}", operation.instruction, program.carriers[carrier as usize]);
        (written, operation.source as usize)
    };
    for operation in &program.operations {
        let CarrierSet(set) = operation.carriers;
        let set = program.carrier_sets.get(set as usize).map_or(&[][..], Vec::as_slice);
        for &carrier in set {
            if !std::mem::replace(&mut seen[carrier as usize], true) {
                let (written, line) = written((operation, carrier));
                carriers.push((Origin::Carrier(carrier + 1), written, line));
            }
        }
        let makes_loops = matches!(
            operation.instruction,
            Instruction::Knit(..) | Instruction::Tuck(..) | Instruction::Split(..)
        );
        if let Some(&carrier) = set.first().filter(|_| makes_loops || last.is_none()) {
            last = Some((operation, carrier));
        }
    }
    let lines = gauge.map(|line| (GAUGE.to_owned(), line)).into_iter().collect();
    Keys { file: path.into(), lines, carriers, last: last.map(written), ..Keys::default() }
}

/// Whether a line has no operation.
fn is_comment(text: &str) -> bool {
    let text = text.trim_start();
    text.is_empty() || text.starts_with(';')
}
