//! The stitch in one wale of one course.

use crate::weft::check::MOVED_MAX;

/// The most needles by which a chart moves a loop.
pub(super) const CHART_MOVED_MAX: u32 = MOVED_MAX as u32;

/// The stitch in one cell of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// The front needle knits: `k`. On one bed, loops that hang on the back needle are first moved
    /// to the front needle.
    Knit,
    /// The back needle knits: `p`. On one bed, loops that hang on the front needle are first moved
    /// to the back needle.
    Purl,
    /// Front and back needle both knit: `b`, on two beds. The back needles then stand half a needle
    /// beside the front needles.
    Both,
    /// The needle takes the yarn and keeps its loops: `t`. On two beds it is the front needle.
    Tuck,
    /// The back needle tucks: `u`, on two beds.
    BackTuck,
    /// The yarn floats past: `m`.
    Miss,
    /// The front needle knits, and its loop then moves to another needle. `<` and `>` move it to
    /// the next needle, for lace. `RRrr` and `llLL` exchange two groups of loops, for cables.
    Moved {
        /// Number of needles by which the loop moves to the right, negative to the left. 256 is the
        /// most in either direction.
        by: i32,
        /// Whether the loop passes behind other loops that move. In a cable it then belongs to the
        /// half that lies at the back.
        behind: bool,
    },
}

/// The beds on which a chart is knitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Beds {
    /// Each wale has loops on one needle, front or back.
    #[default]
    One,
    /// Both needles of a wale may hold loops of their own.
    Two,
}
