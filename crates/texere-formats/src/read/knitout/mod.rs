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
mod knitout_file;
mod limits;
mod line;
mod loop_lengths;
mod operations;
#[cfg(test)]
mod tests;
mod warnings;

pub(super) use design::design;
pub(super) use knitout_file::read;
pub(super) use loop_lengths::{LoopLengths, size};
