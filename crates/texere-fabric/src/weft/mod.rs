//! Weft knits: loops of yarn that are drawn through loops of the course before.
//!
//! ```text
//! knitout ──┐
//! chart ────┴──> Program ──> Stitches ──> Knitted ──> Piece | Yarns
//! ```
//!
//! A [`Program`] is what a knitting machine is told, needle by needle. [`Stitches`] is what comes
//! of it: which loop is drawn through which, and in what order each yarn makes its loops. A knitted
//! cloth adds what yarns are like and how close they lie.

mod cells;
mod chart;
pub(crate) mod check;
mod error;
mod form;
mod gauge;
pub(crate) mod knitted;
mod layers;
mod locate;
mod machine;
mod path;
mod pen;
mod pieces;
mod program;
mod settle;
mod shape;
mod stitches;
mod tile;
mod yarn;

pub use chart::{
    Backing, Beds, CHART_CELLS_MAX, CHART_MOVED_MAX, CHART_SIDE_MAX, CHART_YARNS_MAX, Cell, Chart, ChartError,
};
pub use error::WeftError;
pub use gauge::Gauge;
pub use knitted::Knitted;
pub use machine::{FAULTS_LISTED, Fault, FaultKind, Knit, LOOPS_MAX, Machine, NEEDLE_MAX, STACK_MAX};
pub use program::{Bed, CarrierSet, Direction, Instruction, Needle, Operation, Program};
pub use stitches::{Fate, Head, LoopKind, LoopRef, Parent, Step, Stitch, Stitches, Strand, Visit};
pub use yarn::{Cells, KnitYarn};
