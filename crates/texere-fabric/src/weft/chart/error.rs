//! Errors of charts.

use texere_core::{OutOfMemory, counted};
use thiserror::Error;

/// A chart that is refused. Rows, columns and wales are counted from 1 at the top left, unless a
/// field says otherwise.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ChartError {
    /// A cell outside the chart.
    #[error(
        "wale {wale}, course {course}, both counted from 0, but the chart has {wales} and {courses}", wales = counted(*.wales, "wale"), courses = counted(*.courses, "course"))]
    NoCell {
        /// The wale, counted from 0.
        wale: usize,
        /// The course, counted from 0.
        course: usize,
        /// Wales of the chart.
        wales: usize,
        /// Courses of the chart.
        courses: usize,
    },
    /// A chart without stitches, or with too many wales or rows.
    #[error("a chart of {wales} and {rows}; each must be 1 to {limit}", wales = counted(*.wales, "wale"), rows = counted(*.rows, "row"))]
    Size {
        /// Wales of the chart.
        wales: usize,
        /// Rows of the chart.
        rows: usize,
        /// The most wales, and the most rows, allowed.
        limit: usize,
    },
    /// Too many cells in all courses.
    #[error("a chart of {cells} in all its courses, more than {limit}", cells = counted(*.cells, "cell"))]
    Cells {
        /// Wales times courses.
        cells: usize,
        /// The most cells allowed.
        limit: usize,
    },
    /// A row that is longer or shorter than the first. [`Chart::new`](crate::weft::Chart::new)
    /// finds this only in the last course, whose row it counts from the bottom.
    #[error("row {row} of the chart has {wales} stitches, the first one {first}")]
    Ragged {
        /// The row.
        row: usize,
        /// Stitches of the row.
        wales: usize,
        /// Stitches of the first row.
        first: usize,
    },
    /// An unknown symbol.
    #[error("row {row}, column {column} of the chart: '{}' is no symbol; there are {known}", .symbol.escape_default())]
    Symbol {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// The symbol.
        symbol: char,
        /// The known symbols.
        known: &'static str,
    },
    /// A cable with only one half.
    #[error(
        "row {row}, column {column} of the chart: {symbols} is half a cable; a whole one is such as RRrr or llLL"
    )]
    HalfCable {
        /// The row.
        row: usize,
        /// The column at which it begins.
        column: usize,
        /// The symbols of the half, cut short if there are many.
        symbols: String,
    },
    /// A stitch that the chart's beds can't make.
    #[error("row {row}, column {column} of the chart: this stitch needs {needs}")]
    Beds {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// The beds that the stitch needs.
        needs: &'static str,
    },
    /// A loop that is moved over too many needles.
    #[error(
        "row {row}, column {column} of the chart: this loop moves by {by}; {limit} are taken at most", by = counted(*.by, "needle"))]
    Moved {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// The number of needles by which the loop moves.
        by: u32,
        /// The most needles allowed in either direction.
        limit: u32,
    },
    /// A yarn whose number is too large, because the machine has fewer carriers.
    #[error("the chart's yarn {yarn}, counted from 0, is none of {limit}")]
    Yarn {
        /// The yarn, counted from 0.
        yarn: u32,
        /// The most yarns allowed.
        limit: u32,
    },
    /// A needle that gets loops and never knits them off.
    #[error("wale {wale} of the chart: its needle gets loops but never knits")]
    NeverKnits {
        /// The wale.
        wale: usize,
    },
    /// A chart without a stitch that makes a loop and knits off another.
    #[error("no stitch of the chart knits: misses and tucks alone make no cloth")]
    NothingKnits,
    /// The system refused memory.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

impl ChartError {
    /// The error with its row counted from the bottom of a chart with `rows` rows.
    #[must_use]
    pub fn from_below(mut self, rows: usize) -> Self {
        if let Self::Ragged { row, .. }
        | Self::Symbol { row, .. }
        | Self::HalfCable { row, .. }
        | Self::Moved { row, .. }
        | Self::Beds { row, .. } = &mut self
        {
            *row = (rows + 1).saturating_sub(*row);
        }
        self
    }
}
