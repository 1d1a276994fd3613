//! Warp knits: every guide laps its own yarn round needle after needle, and all needles knit at
//! once.
//!
//! ```text
//! notation ──> Chain ──┐
//! threading, image ────┴──> Bar ──> WarpKnitted ──> Laps | Piece | Yarns
//! ```
//!
//! A [`Chain`] gives the movement of a guide bar, course by course. A [`Bar`] adds the yarn of each
//! of its guides and, for a Jacquard bar, the guides that are displaced. [`WarpKnitted`] is a cloth
//! that guide bars knit. It lists its bars from the front, gives the laps that the guides make
//! ([`WarpKnitted::laps`]), and places the yarns in space.

// Where the yarn of a lap is placed:
//
// - `laps.rs` lists which guide laps which needle at which course.
// - `loops.rs` says which loops share a needle, and in what order.
// - `path.rs` places the points: `loop_points` a loop, `between` an underlap, `inlay` an inlay.

mod bar;
mod chain;
mod check;
mod cut;
mod error;
mod knitted;
mod laps;
mod library;
mod loops;
mod notation;
mod path;
mod pieces;
mod settle;

pub use bar::{Bar, Displacements, Threading};
pub use chain::{CHAIN_COURSES, Chain, Lap, LapKind, NEEDLES_MOST, SPACE_MAX};
pub use error::WarpError;
pub use knitted::WarpKnitted;
pub use laps::PlacedLap;
pub use library::LAPPINGS;
pub use notation::ChainError;
pub use settle::RunIn;
