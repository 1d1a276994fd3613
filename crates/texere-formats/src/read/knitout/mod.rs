//! Knitout 2, the operations of a knitting machine (J. McCann, "The Knitout (.k) File Format",
//! v0.6).
//!
//! Strict about what is knitted, lenient about how a file is written. Refused, with line and
//! column: an operation that is none, a word that does not belong there, a carrier that the header
//! does not list. Warned of, each kind once: a first line without `;!knitout-2` or with a later
//! version, no list of carriers (then they are those that occur), headers and extensions that are
//! not known, stitch sizes without a length, carriage returns, text that is not UTF-8.
//!
//! With an empty carrier set `knit` is `drop`, `split` is `xfer`, and `tuck` and `miss` are
//! nothing. `pause` is nothing.

mod carriers;
mod design;
mod header;
mod line;
mod operations;
#[cfg(test)]
mod tests;
mod warnings;

use std::collections::BTreeMap;
use std::path::Path;

use texere_core::Origin;
use texere_fabric::weft::{CarrierSet, Instruction, Operation, Program};

use super::ReadError;
use super::file::{Files, bytes_of};
use super::keys::{GAUGE, Keys};
use carriers::Carriers;
pub(super) use design::design;
use header::Header;
use line::Line;
use operations::Operations;
use warnings::Warnings;

/// The largest knitout file that is read: ten million operations and more.
const FILE_LIMIT: u64 = 1 << 28;

/// The most operations of a file: so many stitches lie on some square metres of fine cloth.
const OPERATIONS_MAX: usize = 1 << 24;

/// The most carriers: machines have up to sixteen.
const CARRIERS_MAX: usize = 256;

/// The furthest needle from needle 0: machines have up to a thousand or two.
const NEEDLE_MAX: i32 = 1 << 16;

/// How long a loop is, mm, for each stitch size of a file, as [`size`] writes it.
pub(super) type LoopLengths = BTreeMap<String, f64>;

/// A stitch size, however its numbers are written: the one behind `x-stitch-number`, or both behind
/// `stitch`.
pub(super) fn size(text: &str) -> Option<String> {
    let numbers =
        text.split_whitespace().map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()));
    let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
    (1..=2).contains(&numbers.len()).then(|| size_of_numbers(&numbers))
}

fn size_of_numbers(numbers: &[f64]) -> String {
    // Minus zero is zero.
    let words: Vec<_> = numbers.iter().map(|number| (number + 0.0).to_string()).collect();
    words.join(" ")
}

/// A knitout file, read.
#[derive(Debug)]
pub(super) struct Knitout {
    pub(super) program: Program,
    /// Needles to the inch, where the header says so.
    pub(super) gauge: Option<f64>,
    /// What the header says of the yarn in each carrier of the program.
    pub(super) yarns: Vec<Option<String>>,
    pub(super) warnings: Vec<String>,
    /// Stitch sizes that have a length, and that no operation names.
    pub(super) unused_sizes: Vec<String>,
    pub(super) keys: Keys,
}

impl Knitout {
    /// Of each carrier whether an operation takes it.
    pub(super) fn used_carriers(&self) -> Vec<bool> {
        let mut used = vec![false; self.program.carriers.len()];
        // Sets are those that occur.
        for &carrier in self.program.carrier_sets.iter().flatten() {
            used[carrier as usize] = true;
        }
        used
    }
}

/// Reads the file in `path`. Sources of its operations are lines, from 1.
pub(super) fn read(path: &Path, files: &Files<'_>, lengths: &LoopLengths) -> Result<Knitout, ReadError> {
    parse(path, &bytes_of(files, path, FILE_LIMIT)?, lengths)
}

fn parse(path: &Path, bytes: &[u8], lengths: &LoopLengths) -> Result<Knitout, ReadError> {
    let mut warnings = Warnings::new(path);
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = String::from_utf8_lossy(bytes);
    if let Err(error) = std::str::from_utf8(bytes) {
        let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
        warnings.once("utf-8", line, "not UTF-8, as knitout asks for; letters that are none are left out");
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
    // It ends where operations begin; empty lines and other comments may stand in between.
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
    let (program, undeclared) = operations.finish(&mut warnings);
    if undeclared && !program.carriers.is_empty() {
        let said = "no header \";;Carriers: \", which knitout asks for; carriers are those that occur, in that order";
        warnings.once("carriers", 1, said);
    }
    let gauge = header.gauge.map(|(gauge, _)| gauge);
    let keys = keys(path, header.gauge.map(|(_, line)| line), &program);
    let yarns = header.yarns_of(&program.carriers, &mut warnings);
    Ok(Knitout { program, gauge, yarns, warnings: warnings.list(), unused_sizes, keys })
}

/// What errors of the cloth name: the gauge, where each carrier comes first, and the last loop;
/// where there is none, the first operation.
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
