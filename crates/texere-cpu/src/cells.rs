//! Which chords may be neighbours: those in cells side by side.

use glam::IVec3;
use texere_core::BackendError;
use texere_core::settling::SettlingPlan;

/// Whether so many neighbours can be numbered.
///
/// **Errors**: [`BackendError::OutOfMemory`] with the bytes of their list where they can't.
pub(crate) const fn countable(neighbours: u64) -> Result<(), BackendError> {
    if neighbours > u32::MAX as u64 {
        return Err(BackendError::OutOfMemory { what: "neighbours of chords", bytes: 4 * neighbours });
    }
    Ok(())
}

/// Chords by cells of a grid over x and y.
#[derive(Debug, Default)]
pub(crate) struct Cells {
    /// Where the grid begins, units; 0 along an axis that repeats.
    low: [i32; 2],
    /// From there to its end, units, and how many cells that is cut into.
    span: [i64; 2],
    count: [i64; 2],
    repeats: [bool; 2],
    /// Where each cell's chords begin, and the end of the last one's.
    starts: Vec<u32>,
    /// Chords, cell by cell, in the order of their numbers.
    chords: Vec<u32>,
}

impl Cells {
    /// Sorts chords, whose middles are `middles`, into cells of at least `size` units, and no more of them than chords: a cloth may
    /// lie scattered over a large field.
    pub(crate) fn fill(&mut self, plan: &SettlingPlan, middles: &[IVec3], size: i32) {
        let mut low = [i32::MAX; 2];
        let mut high = [i32::MIN; 2];
        for middle in middles {
            for axis in 0..2 {
                (low[axis], high[axis]) = (low[axis].min(middle[axis]), high[axis].max(middle[axis]));
            }
        }
        let mut size = i64::from(size.max(1));
        loop {
            for axis in 0..2 {
                let period = plan.period()[axis];
                self.repeats[axis] = period > 0;
                self.low[axis] = if period > 0 { 0 } else { low[axis] };
                let open = i64::from(high[axis]) - i64::from(low[axis]) + 1;
                self.span[axis] = if period > 0 { i64::from(period) } else { open.max(1) };
                // So many that each has the size at least.
                self.count[axis] = (self.span[axis] / size).max(1);
            }
            if self.count[0] * self.count[1] <= (middles.len() as i64).max(64) {
                break;
            }
            size *= 2;
        }
        let cells = (self.count[0] * self.count[1]) as usize;
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        let numbers: Vec<usize> = middles.iter().map(|middle| self.number(plan, *middle)).collect();
        for &number in &numbers {
            self.starts[number + 1] += 1;
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        let mut next = self.starts.clone();
        self.chords.resize(middles.len(), 0);
        for (chord, &number) in (0..).zip(&numbers) {
            self.chords[next[number] as usize] = chord;
            next[number] += 1;
        }
    }

    fn cell(&self, plan: &SettlingPlan, middle: IVec3) -> [i64; 2] {
        [0, 1].map(|axis| {
            let period = plan.period()[axis];
            let from = if period > 0 {
                i64::from(middle[axis].rem_euclid(period))
            } else {
                i64::from(middle[axis]) - i64::from(self.low[axis])
            };
            from * self.count[axis] / self.span[axis]
        })
    }

    fn number(&self, plan: &SettlingPlan, middle: IVec3) -> usize {
        let [x, y] = self.cell(plan, middle);
        (y * self.count[0] + x) as usize
    }

    /// Writes the chords of the cells beside `middle`'s and its own, in the order of their numbers.
    pub(crate) fn beside(&self, plan: &SettlingPlan, middle: IVec3, chords: &mut Vec<u32>) {
        chords.clear();
        let [x, y] = self.cell(plan, middle);
        let around = |axis: usize, cell: i64| {
            let count = self.count[axis];
            let mut cells: Vec<i64> = (cell - 1..=cell + 1)
                .filter(|cell| self.repeats[axis] || (0..count).contains(cell))
                .map(|cell| cell.rem_euclid(count))
                .collect();
            cells.sort_unstable();
            cells.dedup();
            cells
        };
        let (columns, rows) = (around(0, x), around(1, y));
        for row in rows {
            for column in &columns {
                let cell = (row * self.count[0] + column) as usize;
                let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                chords.extend_from_slice(&self.chords[range]);
            }
        }
        chords.sort_unstable();
    }
}
