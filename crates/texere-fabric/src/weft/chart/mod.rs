//! Charts: the stitch in each wale of each course, as knitters draw it.

mod cell;
mod error;
mod jacquard;
mod program;
mod symbols;
#[cfg(test)]
mod tests;

use cell::CHART_MOVED_MAX;
pub use cell::{Beds, Cell};
pub use error::ChartError;
pub use jacquard::Backing;

use texere_core::backend::{filled, room_for};

use super::machine::CARRIERS_MAX;

/// The most wales, and the most rows, of a chart.
const CHART_SIDE_MAX: usize = 1 << 16;

/// The most cells in all courses of a chart. The number of loops is known only when the chart has
/// been knitted. Knitting takes up to 160 bytes for each cell before a repeat of more than a
/// million loops is refused.
const CHART_CELLS_MAX: usize = 1 << 22;

/// The most yarns of a chart. Each has a carrier of its own.
const CHART_YARNS_MAX: u32 = CARRIERS_MAX as u32 - 1;

/// One course: a pass of one yarn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Course {
    yarn: u32,
    /// The row of the drawing that the course comes from, counted from 0 at the bottom.
    row: u32,
}

/// A chart: one repeat of stitches, seen from the face of the cloth. Each course is of one yarn.
///
/// ```
/// use texere_fabric::weft::{Beds, Chart};
/// // Rows from the top down, as a knitter writes them: purl one row, knit the next.
/// let garter = Chart::parse("pp\nkk", Beds::One)?;
/// assert_eq!((garter.wales(), garter.courses()), (2, 2));
/// let program = garter.program()?;
/// assert_eq!(program.repeat, Some(2));
/// # Ok::<(), texere_fabric::weft::ChartError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    wales: usize,
    beds: Beds,
    courses: Vec<Course>,
    /// The cells of all courses from the first course on, each course from left to right.
    cells: Vec<Cell>,
}

impl Chart {
    /// A chart of `cells`, given course by course from the first one, each from left to right. All
    /// courses are of yarn 0.
    ///
    /// **Errors**: [`ChartError::Size`], [`ChartError::Cells`] and [`ChartError::Ragged`] for the
    /// number of cells, [`ChartError::Beds`] and [`ChartError::Moved`] for a stitch that these beds
    /// can't make, [`ChartError::NeverKnits`], [`ChartError::NothingKnits`], and
    /// [`ChartError::OutOfMemory`].
    pub fn new(wales: usize, beds: Beds, cells: Vec<Cell>) -> Result<Self, ChartError> {
        let rows = cells.len().checked_div(wales).unwrap_or(0);
        sized(wales, rows, cells.len())?;
        if rows * wales != cells.len() {
            return Err(ChartError::Ragged {
                row: rows + 1,
                wales: cells.len() - rows * wales,
                first: wales,
            });
        }
        let courses = (0..rows as u32).map(|row| Course { yarn: 0, row }).collect();
        Self { wales, beds, courses, cells }.checked()
    }

    /// Reads a chart from symbols. Each line is a row, and the last course is on top. Spaces and
    /// empty lines have no meaning.
    ///
    /// | symbol | stitch |
    /// |---|---|
    /// | `k` | knit: the front needle |
    /// | `p` | purl: the back needle |
    /// | `t` | tuck; with two beds on the front needle |
    /// | `u` | with two beds: tuck on the back needle |
    /// | `m` | miss: the yarn floats past |
    /// | `b` | with two beds: both needles knit, half a needle apart |
    /// | `<`, `>` | knit, and the loop goes to the next needle: left with `<`, right with `>` |
    /// | `RRrr` | a cable: the loops under capitals cross to the right, in front of the others |
    /// | `llLL` | the loops under capitals cross to the left, in front |
    ///
    /// **Errors**: [`ChartError::Symbol`] and [`ChartError::HalfCable`] with the row, counted from
    /// the top, and the column, [`ChartError::Ragged`] with the row, and the errors of
    /// [`Chart::new`].
    pub fn parse(text: &str, beds: Beds) -> Result<Self, ChartError> {
        let rows = Self::letters(text)?;
        let wales = rows.first().map_or(0, Vec::len);
        Self::from_symbols(wales, rows.len(), beds, |column, row| rows[row][column])
    }

    /// The letters of a chart's text, row by row from the top. All rows have the same number of
    /// letters. Spaces and empty lines have no meaning.
    ///
    /// **Errors**: [`ChartError::Ragged`] with the row, counted from 1 at the top.
    ///
    /// ```
    /// use texere_fabric::weft::Chart;
    /// assert_eq!(Chart::letters("r w\n\nww")?, [['r', 'w'], ['w', 'w']]);
    /// # Ok::<(), texere_fabric::weft::ChartError>(())
    /// ```
    pub fn letters(text: &str) -> Result<Vec<Vec<char>>, ChartError> {
        let rows: Vec<Vec<char>> = text
            .lines()
            .map(|line| line.chars().filter(|letter| !letter.is_whitespace()).collect())
            .filter(|row: &Vec<char>| !row.is_empty())
            .collect();
        let first = rows.first().map_or(0, Vec::len);
        match (1..).zip(&rows).find(|(_, row)| row.len() != first) {
            Some((row, other)) => Err(ChartError::Ragged { row, wales: other.len(), first }),
            None => Ok(rows),
        }
    }

    /// A chart from the symbol at each column and row. Both are counted from 0, and rows from the
    /// top. The symbols are those of [`Chart::parse`].
    ///
    /// **Errors**: [`ChartError::Symbol`] and [`ChartError::HalfCable`] with the row and the
    /// column, here both counted from 1, and rows from the top. Also the errors of [`Chart::new`].
    pub fn from_symbols(
        wales: usize,
        rows: usize,
        beds: Beds,
        symbol: impl Fn(usize, usize) -> char,
    ) -> Result<Self, ChartError> {
        sized(wales, rows, wales.saturating_mul(rows))?;
        let mut cells = Vec::new();
        room_for(&mut cells, wales * rows, "cells of a chart")?;
        for row in (0..rows).rev() {
            symbols::read(wales, row, &symbol, &mut cells)?;
        }
        Self::new(wales, beds, cells)
    }

    /// Gives `yarns` to the courses, in turn from the first course on. If the number of courses is
    /// not a multiple of the number of yarns, the chart is repeated upwards until it is. An empty
    /// list changes nothing.
    ///
    /// **Errors**: [`ChartError::Cells`] and [`ChartError::Size`] if the repeated chart is too
    /// large, [`ChartError::Yarn`] for a yarn beyond 65534, and [`ChartError::OutOfMemory`].
    ///
    /// ```
    /// use texere_fabric::weft::{Beds, Chart};
    /// let striped = Chart::parse("k", Beds::One)?.with_yarns(&[0, 0, 1])?;
    /// assert_eq!(striped.courses(), 3);
    /// # Ok::<(), texere_fabric::weft::ChartError>(())
    /// ```
    pub fn with_yarns(mut self, yarns: &[u32]) -> Result<Self, ChartError> {
        let own = self.courses();
        if yarns.is_empty() {
            return Ok(self);
        }
        yarns.iter().try_for_each(|yarn| known(*yarn))?;
        let repeats = yarns.len() / greatest_common_divisor(own, yarns.len());
        let courses = own.saturating_mul(repeats);
        sized(self.wales, courses, courses.saturating_mul(self.wales))?;
        room_for(&mut self.cells, (courses - own) * self.wales, "cells of a chart")?;
        for course in own..courses {
            self.courses.push(self.courses[course - own]);
            let start = (course - own) * self.wales;
            self.cells.extend_from_within(start..start + self.wales);
        }
        for (course, &yarn) in self.courses.iter_mut().zip(yarns.iter().cycle()) {
            course.yarn = yarn;
        }
        Ok(self)
    }

    /// Wales of the repeat.
    #[must_use]
    pub const fn wales(&self) -> usize {
        self.wales
    }

    /// Courses of the repeat.
    #[must_use]
    pub fn courses(&self) -> usize {
        self.courses.len()
    }

    /// The beds on which the chart is knitted.
    #[must_use]
    pub const fn beds(&self) -> Beds {
        self.beds
    }

    /// The yarn of each course, by its number.
    pub fn yarns(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        self.courses.iter().map(|course| course.yarn)
    }

    /// Number of rows of the drawing. A Jacquard has a course for each yarn of a row. If
    /// `Chart::with_yarns` has repeated a chart upwards, each row occurs more than once. It still
    /// counts as one row.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.courses.last().map_or(0, |course| course.row as usize + 1)
    }

    /// The row of the drawing that a course comes from, counted from 0 at the bottom.
    ///
    /// **Panics** for a course past the last one.
    #[must_use]
    pub fn row(&self, course: usize) -> usize {
        self.courses[course].row as usize
    }

    /// The cells of a course, from left to right. Courses are counted from 0 at the bottom.
    ///
    /// **Panics** for a course past the last one.
    #[must_use]
    pub fn course(&self, course: usize) -> &[Cell] {
        &self.cells[course * self.wales..][..self.wales]
    }

    /// The symbols of a course as [`Chart::parse`] reads them. None if a loop moves in a way that
    /// no symbol stands for.
    ///
    /// **Panics** for a course past the last one.
    ///
    /// ```
    /// use texere_fabric::weft::{Beds, Chart};
    /// let chart = Chart::parse("k p >RR rl Lt\nkkk kk kkkk", Beds::One)?;
    /// assert_eq!(chart.symbols(1).as_deref(), Some("kp>RRrlLt"));
    /// # Ok::<(), texere_fabric::weft::ChartError>(())
    /// ```
    #[must_use]
    pub fn symbols(&self, course: usize) -> Option<String> {
        symbols::written(self.course(course))
    }

    /// Puts another stitch into a cell. Wales are counted from 0 at the left, courses from 0 at the
    /// bottom.
    ///
    /// ```
    /// use texere_fabric::weft::{Beds, Cell, Chart};
    /// let mut chart = Chart::parse("kk\nkk", Beds::One)?;
    /// chart.set(1, 0, Cell::Tuck)?;
    /// assert_eq!(chart, Chart::parse("kk\nkt", Beds::One)?);
    /// // A needle that never knits would pile up loops.
    /// assert!(chart.set(1, 1, Cell::Tuck).is_err());
    /// # Ok::<(), texere_fabric::weft::ChartError>(())
    /// ```
    ///
    /// **Errors**: [`ChartError::NoCell`] for a cell outside the chart, and the errors of
    /// [`Chart::new`]. After an error the chart is unchanged.
    pub fn set(&mut self, wale: usize, course: usize, cell: Cell) -> Result<(), ChartError> {
        let (wales, courses) = (self.wales, self.courses());
        if wale >= wales || course >= courses {
            return Err(ChartError::NoCell { wale, course, wales, courses });
        }
        let mut changed = self.clone();
        changed.cells[course * wales + wale] = cell;
        *self = changed.checked()?;
        Ok(())
    }

    /// The chart, if its beds can make all its stitches, every needle that gets loops also knits,
    /// and at least one needle knits.
    fn checked(self) -> Result<Self, ChartError> {
        let on_two = self.beds == Beds::Two;
        let rows = self.rows();
        // For the front and the back needle of each wale: whether tucks or moved loops come to the
        // needle, and whether it knits. On one bed the first entry counts for the whole wale.
        let mut gets = filled("wales of a chart", self.wales, [false; 2])?;
        let mut knits = filled("wales of a chart", self.wales, [false; 2])?;
        for (number, &cell) in self.cells.iter().enumerate() {
            let (course, wale) = (number / self.wales, number % self.wales);
            let place = || (rows - self.courses[course].row as usize, wale + 1);
            match cell {
                Cell::Knit => knits[wale][0] = true,
                Cell::Purl => knits[wale][usize::from(on_two)] = true,
                Cell::Tuck => gets[wale][0] = true,
                Cell::Miss => {}
                Cell::Both | Cell::BackTuck if !on_two => {
                    let (row, column) = place();
                    return Err(ChartError::Beds { row, column, needs: "two beds" });
                }
                Cell::Moved { .. } if on_two => {
                    let (row, column) = place();
                    return Err(ChartError::Beds { row, column, needs: "one bed" });
                }
                Cell::Both => knits[wale] = [true; 2],
                Cell::BackTuck => gets[wale][1] = true,
                Cell::Moved { by, .. } if by.unsigned_abs() > CHART_MOVED_MAX => {
                    let ((row, column), by) = (place(), by.unsigned_abs());
                    return Err(ChartError::Moved { row, column, by, limit: CHART_MOVED_MAX });
                }
                Cell::Moved { by, .. } => {
                    knits[wale][0] = true;
                    let target = (wale as i64 + i64::from(by)).rem_euclid(self.wales as i64) as usize;
                    gets[target][0] = true;
                }
            }
        }
        for (wale, (gets, knits)) in gets.iter().zip(&knits).enumerate() {
            if gets.iter().zip(knits).any(|(gets, knits)| *gets && !knits) {
                return Err(ChartError::NeverKnits { wale: wale + 1 });
            }
        }
        if !knits.iter().flatten().any(|knits| *knits) {
            return Err(ChartError::NothingKnits);
        }
        Ok(self)
    }
}

fn sized(wales: usize, rows: usize, cells: usize) -> Result<(), ChartError> {
    let limit = CHART_SIDE_MAX;
    if !(1..=limit).contains(&wales) || !(1..=limit).contains(&rows) {
        return Err(ChartError::Size { wales, rows, limit });
    }
    if cells > CHART_CELLS_MAX {
        return Err(ChartError::Cells { cells, limit: CHART_CELLS_MAX });
    }
    Ok(())
}

fn known(yarn: u32) -> Result<(), ChartError> {
    let limit = CHART_YARNS_MAX;
    if yarn < limit { Ok(()) } else { Err(ChartError::Yarn { yarn, limit }) }
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    let (mut divisor, mut rest) = (a, b);
    while rest != 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    divisor
}
