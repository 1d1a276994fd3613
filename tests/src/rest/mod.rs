//! Cloth before and after it settles: starts for a solver, and checks of its result.
//!
//! A [`Start`] is the control points of one repeat, as data. [`starts`] lists the starts on which
//! every solver is tested. [`check()`] measures the cloth at rest. [`linking()`] finds yarns that
//! passed through one another on the way. Both work in f64 and share no code with texere's crates.

mod cells;
mod chart;
mod check;
mod chords;
mod curve;
mod linking;
mod list;
mod segments;
mod settle;
mod span;
mod start;
mod warp;
mod weft;
mod woven;

pub use chart::{Chart, Stitch};
pub use check::{Place, Report, check};
pub use linking::{CROSSED, Linking, linking, linking_integral};
pub use list::{lace, random_misses, starts};
pub use settle::{settle_start, settling_plan, yarns};
pub use span::{Span, piece_curve, piece_points, piece_start};
pub use start::{Ends, Length, Start, StartYarn};
pub use warp::{Lapping, warp_knit};
pub use weft::{Gauge, weft_knit, weft_knit_piece};
pub use woven::{Weave, woven, woven_piece};
