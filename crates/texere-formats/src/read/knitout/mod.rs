//! Knitout 2, the operations of a knitting machine (J. McCann, "The Knitout (.k) File Format",
//! v0.6).
//!
//! The reader is strict about what is knitted and lenient about how a file is written. It refuses,
//! with line and column, an unknown operation, a word that is wrong at its place, and a carrier
//! that the header does not list. It accepts departures from the standard whose meaning is clear,
//! and warns of each kind once. Examples are a first line that is not `;!knitout-2`, a missing list
//! of carriers (the carriers are then those that occur), unknown headers and extensions, stitch
//! sizes without a length, carriage returns, and text that is not UTF-8.
//!
//! With an empty carrier set, `knit` is `drop`, `split` is `xfer`, and `tuck` and `miss` do
//! nothing. `amiss` and `pause` do nothing.

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
pub(crate) use design::{gauge, of_carriers};
pub(crate) use header::{is_swg, kept};
#[cfg(feature = "toml")]
pub(super) use knitout_file::read;
pub(crate) use limits::{FILE_MAX, GAUGE};
#[cfg(feature = "toml")]
pub(super) use loop_lengths::{LoopLengths, size};
