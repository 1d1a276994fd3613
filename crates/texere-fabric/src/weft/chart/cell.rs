//! The stitch in one wale of one course.

use crate::weft::check::MOVED_MAX;

/// The most needles by which a chart moves a loop.
pub(super) const CHART_MOVED_MAX: u32 = MOVED_MAX as u32;

/// The stitch in one cell of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// The front needle knits: `k`.
    Knit,
    /// The back needle knits: `p`. On one bed the loops are moved there first.
    Purl,
    /// Front and back needle both knit: `b`, on two beds. The beds are half a needle apart then.
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
        /// Needles to the right, negative to the left; 256 at most either way.
        by: i32,
        /// Whether it goes behind the others: the half of a cable that lies below.
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
