//! Warp knits: every guide lays its own yarn round one needle after another, and all of them knit
//! at once.
//!
//! ```text
//! notation ──> Chain ──┐
//! threading, image ────┴──> Bar ──> WarpKnitted ──> Laps | Piece | Yarns
//! ```
//!
//! A [`Chain`] says where the guides of a bar move, course by course. A [`Bar`] adds which of its
//! guides hold which yarn, and by how much single ones are displaced. A [`WarpKnitted`] is a cloth
//! of such bars, the front one first: which laps they make ([`WarpKnitted::laps`]), and where their
//! yarns lie.

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
pub use laps::Laid;
pub use library::LAPPINGS;
pub use notation::ChainError;
pub use settle::RunIn;
