//! Jacquard charts: pictures whose colours are yarns.

use texere_core::backend::room_for;

use super::{Beds, CHART_CELLS_MAX, Cell, Chart, ChartError, Course, known, sized};

/// The back of a Jacquard picture on two beds, given by the back needles that knit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Backing {
    /// Every other needle knits, alternating from yarn to yarn and from row to row. The back shows
    /// flecks of all yarns.
    Birdseye,
    /// Each of the n yarns of a row knits on every n-th needle, and on the same needles in all rows
    /// that have the same yarns. The back is light, with upright lines.
    Ladder,
}

impl Chart {
    /// A chart of a picture. `yarn` gives the yarn at a column and a row, both counted from 0, with
    /// row 0 at the bottom.
    ///
    /// Each row of the picture becomes one course for each yarn that occurs in the row, in the
    /// order of the yarns' numbers. The front needles knit where the picture has the course's yarn.
    /// Elsewhere the yarn floats. With a backing, some back needles also knit the yarn, half a
    /// needle beside the front needles.
    ///
    /// **Errors**: [`ChartError::Size`], [`ChartError::Cells`], [`ChartError::Yarn`] and
    /// [`ChartError::OutOfMemory`].
    ///
    /// ```
    /// use texere_fabric::weft::Chart;
    /// // Two rows of two yarns and one of a single yarn.
    /// let picture = [[0, 1, 1], [1, 1, 0], [1, 1, 1]];
    /// let chart = Chart::jacquard(3, 3, None, |column, row| picture[row][column])?;
    /// assert_eq!((chart.wales(), chart.courses()), (3, 5));
    /// # Ok::<(), texere_fabric::weft::ChartError>(())
    /// ```
    pub fn jacquard(
        wales: usize,
        rows: usize,
        backing: Option<Backing>,
        yarn: impl Fn(usize, usize) -> u32,
    ) -> Result<Self, ChartError> {
        sized(wales, rows, 0)?;
        let (mut courses, mut cells) = (Vec::new(), Vec::new());
        for row in 0..rows {
            let mut yarns: Vec<u32> = (0..wales).map(|column| yarn(column, row)).collect();
            yarns.sort_unstable();
            yarns.dedup();
            yarns.last().map_or(Ok(()), |yarn| known(*yarn))?;
            let count = cells.len() + yarns.len() * wales;
            if count > CHART_CELLS_MAX {
                return Err(ChartError::Cells { cells: count, limit: CHART_CELLS_MAX });
            }
            if cells.capacity() < count {
                let more = count.max(2 * cells.len()) - cells.len();
                room_for(&mut cells, more, "cells of a chart")?;
            }
            for (place, &of) in yarns.iter().enumerate() {
                cells.extend((0..wales).map(|column| {
                    let back = match backing {
                        None => false,
                        Some(Backing::Birdseye) => (column + place + row).is_multiple_of(2),
                        Some(Backing::Ladder) => column % yarns.len() == place,
                    };
                    match (yarn(column, row) == of, back) {
                        (true, true) => Cell::Both,
                        (true, false) => Cell::Knit,
                        (false, true) => Cell::Purl,
                        (false, false) => Cell::Miss,
                    }
                }));
                courses.push(Course { yarn: of, row: row as u32 });
            }
        }
        let beds = if backing.is_some() { Beds::Two } else { Beds::One };
        Self { wales, beds, courses, cells }.checked()
    }
}
