//! Which chords may be neighbours: those in cells side by side.

use glam::IVec3;
use texere_core::settling::SettlingPlan;

/// Chords by cells of a grid over x and y.
#[derive(Debug, Default)]
pub(crate) struct Cells {
    /// Where the grid begins, units; 0 along an axis that repeats.
    low: [i32; 2],
    /// The size of a cell, units.
    size: [i32; 2],
    count: [usize; 2],
    repeats: [bool; 2],
    /// Where each cell's chords begin, and the end of the last one's.
    starts: Vec<u32>,
    /// Chords, cell by cell, in the order of their numbers.
    chords: Vec<u32>,
}

/// No more cells than chords: a cloth may lie scattered over a large field.
const CELLS_PER_CHORD: usize = 1;

impl Cells {
    /// Sorts chords, whose middles are `middles`, into cells of at least `size` units.
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
                let period = i64::from(plan.period()[axis]);
                self.repeats[axis] = period > 0;
                let span = if period > 0 { period } else { i64::from(high[axis]) - i64::from(low[axis]) + 1 };
                let count = if period > 0 { (span / size).max(1) } else { (span + size - 1) / size };
                self.count[axis] = count as usize;
                // All cells of a repeat are alike, so that the last one is no narrower than the others.
                self.size[axis] = ((span + count - 1) / count) as i32;
                self.low[axis] = if period > 0 { 0 } else { low[axis] };
            }
            if self.count[0] * self.count[1] <= (middles.len() * CELLS_PER_CHORD).max(64) {
                break;
            }
            size *= 2;
        }
        let cells = self.count[0] * self.count[1];
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

    fn cell(&self, plan: &SettlingPlan, middle: IVec3) -> [usize; 2] {
        [0, 1].map(|axis| {
            let period = plan.period()[axis];
            let from =
                if period > 0 { middle[axis].rem_euclid(period) } else { middle[axis] - self.low[axis] };
            ((from / self.size[axis]) as usize).min(self.count[axis] - 1)
        })
    }

    fn number(&self, plan: &SettlingPlan, middle: IVec3) -> usize {
        let [x, y] = self.cell(plan, middle);
        y * self.count[0] + x
    }

    /// Writes the chords of the cells beside `middle`'s and its own, in the order of their numbers.
    pub(crate) fn beside(&self, plan: &SettlingPlan, middle: IVec3, chords: &mut Vec<u32>) {
        chords.clear();
        let [x, y] = self.cell(plan, middle);
        let around = |axis: usize, cell: usize| {
            let (count, cell) = (self.count[axis] as i64, cell as i64);
            let mut cells: Vec<usize> = (cell - 1..=cell + 1)
                .filter(|cell| self.repeats[axis] || (0..count).contains(cell))
                .map(|cell| cell.rem_euclid(count) as usize)
                .collect();
            cells.sort_unstable();
            cells.dedup();
            cells
        };
        let (columns, rows) = (around(0, x), around(1, y));
        for row in rows {
            for column in &columns {
                let cell = row * self.count[0] + column;
                let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                chords.extend_from_slice(&self.chords[range]);
            }
        }
        chords.sort_unstable();
    }
}
