//! Weft knits: each loop of yarn is drawn through loops of an earlier course.
//!
//! ```text
//! knitout ──┐
//! chart ────┴──> Program ──> Stitches ──> Knitted ──> Piece | Yarns
//! ```
//!
//! A [`Program`] lists the operations of a knitting machine, needle by needle. A [`Machine`] runs
//! the program and gives [`Stitches`]: which loop is drawn through which, and in what order each
//! yarn makes its loops. [`Knitted`] adds the distances between loops and the properties of the
//! yarns, and places the yarns in space.

// Where the yarn of a loop is placed:
//
// - `shape.rs` has the plain loop: a table of its feet, legs and head.
// - `form.rs` bends that table into any other loop: purl, tuck, held, moved, dropped.
// - `path.rs` follows a yarn from loop to loop, and places the arcs and turns between loops.
// - `pen.rs` takes the points of each cell; with even cells it lays new ones along their curve.
// - `cells.rs` lists the needles that a yarn comes to.
// - `layers.rs` says which loops and yarns lie over one another at a needle.

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

pub use chart::{Backing, Beds, Cell, Chart, ChartError};
pub use error::WeftError;
pub use gauge::Gauge;
pub use knitted::Knitted;
pub use machine::{Fault, FaultKind, Knit, Machine, NEEDLE_MAX, STACK_MAX};
pub use program::{Bed, CarrierSet, Direction, Instruction, Needle, Operation, Program};
pub use stitches::{Fate, Head, LoopKind, LoopRef, Parent, Step, Stitch, Stitches, Strand, Visit};
pub use yarn::{Cells, KnitYarn};
