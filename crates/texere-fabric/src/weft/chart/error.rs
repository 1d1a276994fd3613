//! What can be wrong with a chart.

use texere_core::{OutOfMemory, counted};
use thiserror::Error;

/// A chart that can't be knitted. Rows and columns are counted from 1 at the top left.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ChartError {
    /// A cell outside the chart.
    #[error(
        "wale {wale}, course {course}, both counted from 0, but the chart has {wales} and {courses}", wales = counted(*.wales, "wale"), courses = counted(*.courses, "course"))]
    NoCell {
        /// The wale.
        wale: usize,
        /// The course.
        course: usize,
        /// Wales of the chart.
        wales: usize,
        /// Its courses.
        courses: usize,
    },
    /// No stitches at all, or more in a direction than are taken.
    #[error("a chart of {wales} and {rows}; each must be 1 to {limit}", wales = counted(*.wales, "wale"), rows = counted(*.rows, "row"))]
    Size {
        /// Its wales.
        wales: usize,
        /// Its rows.
        rows: usize,
        /// Most taken of either.
        limit: usize,
    },
    /// More cells of all courses than are taken.
    #[error("a chart of {cells} in all its courses, more than {limit}", cells = counted(*.cells, "cell"))]
    Cells {
        /// Wales times courses.
        cells: usize,
        /// Most taken.
        limit: usize,
    },
    /// A row that is longer or shorter than the first.
    #[error("row {row} of the chart has {wales} stitches, the first one {first}")]
    Ragged {
        /// The row.
        row: usize,
        /// Its stitches.
        wales: usize,
        /// Those of the first row.
        first: usize,
    },
    /// A symbol that stands for nothing.
    #[error("row {row}, column {column} of the chart: '{}' is no symbol; there are {known}", .symbol.escape_default())]
    Symbol {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// The symbol.
        symbol: char,
        /// Those that there are.
        known: &'static str,
    },
    /// A cable that has only one half.
    #[error(
        "row {row}, column {column} of the chart: {symbols} is half a cable; a whole one is such as RRrr or llLL"
    )]
    HalfCable {
        /// The row.
        row: usize,
        /// The column at which it begins.
        column: usize,
        /// Its symbols, cut short where there are many.
        symbols: String,
    },
    /// A stitch for other beds than the chart's.
    #[error("row {row}, column {column} of the chart: this stitch needs {needs}")]
    Beds {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// What it needs.
        needs: &'static str,
    },
    /// A loop that is moved over more needles than a chart's are.
    #[error(
        "row {row}, column {column} of the chart: this loop moves by {by}; {limit} are taken at most", by = counted(*.by, "needle"))]
    Moved {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// Needles that it moves by.
        by: u32,
        /// Most taken, either way.
        limit: u32,
    },
    /// A yarn of a number that no machine has carriers for.
    #[error("the chart's yarn {yarn}, counted from 0, is none of {limit}")]
    Yarn {
        /// The yarn.
        yarn: u32,
        /// How many yarns are taken at most.
        limit: u32,
    },
    /// A needle that gets loops and never knits them off, or a chart without any stitch that knits.
    #[error("wale {wale} of the chart: its needle gets loops but never knits")]
    NeverKnits {
        /// The wale.
        wale: usize,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

impl ChartError {
    /// The same of a chart of so many rows that are counted from the bottom.
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
