//! A grid of cells that chords are sorted into. A chord is a straight piece of a control interval.
//! Only chords in the same cell or in cells beside one another may be neighbours. Cells are beside
//! one another if they share an edge or a corner.

use std::ops::Range;

use glam::IVec3;
use texere_core::settling::SettlingPlan;

/// For each chord, the place at which its interval begins.
pub(crate) fn owners(plan: &SettlingPlan) -> Vec<u32> {
    let mut owners = vec![0; plan.counts().chords as usize];
    for (place, bounds) in (0..).zip(plan.chords().windows(2)) {
        owners[bounds[0] as usize..bounds[1] as usize].fill(place);
    }
    owners
}

/// The extent of some chords: what a grid of cells is made from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extent {
    /// The least coordinates of the chords' middles, in units of the plan's scale.
    pub(crate) low: IVec3,
    /// The greatest coordinates of the chords' middles, in units of the plan's scale.
    pub(crate) high: IVec3,
    /// The longest chord, mm.
    pub(crate) longest: f32,
}

impl Extent {
    /// The extent of no chords.
    pub(crate) const NOTHING: Self = Self { low: IVec3::MAX, high: IVec3::MIN, longest: 0.0 };

    /// The extent of this extent's chords and one more.
    pub(crate) fn with(self, middle: IVec3, length: f32) -> Self {
        self.and(Self { low: middle, high: middle, longest: length })
    }

    /// The extent of the chords of both extents.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            longest: self.longest.max(other.longest),
        }
    }
}

/// Cells over x and y, numbered row by row. They are so large that a chord's neighbours lie in its
/// own cell or in one beside it.
#[derive(Debug)]
pub(crate) struct Grid {
    /// The x and y at which the grid begins, in units of the plan's scale; 0 along an axis that
    /// repeats.
    low: [f64; 2],
    /// One over the grid's width and height in units of the plan's scale.
    inverse: [f64; 2],
    /// The number of columns, and the number of rows.
    count: [u32; 2],
    repeats: [bool; 2],
}

impl Grid {
    /// A grid whose cells are as large as `growth` requires, or larger. The grid has no more cells
    /// than there are chords, but up to 64 cells if there are fewer than 64 chords. The limit
    /// matters for yarns that lie scattered over a large field.
    pub(crate) fn new(plan: &SettlingPlan, growth: f32, extent: &Extent) -> Self {
        let most = (plan.counts().chords as i64).max(64);
        let mut size =
            i64::from((plan.cell(growth, extent.longest) / plan.scale().unit()).ceil() as i32).max(1);
        let repeats = plan.period().map(|period| period > 0);
        let spans = [0, 1].map(|axis| {
            let open = i64::from(extent.high[axis]) - i64::from(extent.low[axis]) + 1;
            if repeats[axis] { i64::from(plan.period()[axis]) } else { open.max(1) }
        });
        // The greatest numbers of columns and rows that leave each at least `size` units wide.
        let mut count = spans.map(|span| (span / size).max(1));
        while count[0] * count[1] > most {
            size *= 2;
            count = spans.map(|span| (span / size).max(1));
        }
        Self {
            low: [0, 1].map(|axis| if repeats[axis] { 0.0 } else { f64::from(extent.low[axis]) }),
            inverse: spans.map(|span| 1.0 / span as f64),
            count: count.map(|count| count as u32),
            repeats,
        }
    }

    /// The number of cells.
    pub(crate) const fn cells(&self) -> usize {
        self.count[0] as usize * self.count[1] as usize
    }

    /// The cell of a chord whose middle is `middle`.
    #[inline]
    pub(crate) fn cell(&self, middle: IVec3) -> u32 {
        let mut cell = [0; 2];
        for axis in 0..2 {
            let share = (f64::from(middle[axis]) - self.low[axis]) * self.inverse[axis];
            let share = if self.repeats[axis] { share - share.floor() } else { share };
            cell[axis] = ((share * f64::from(self.count[axis])) as u32).min(self.count[axis] - 1);
        }
        cell[1] * self.count[0] + cell[0]
    }

    /// The cell `cell` and the cells beside it, each of them once, as ranges of their numbers. Some
    /// ranges may be empty.
    #[inline]
    pub(crate) fn beside(&self, cell: u32) -> [Range<u32>; 6] {
        let [width, height] = self.count;
        let [columns, rows] =
            [around(cell % width, width, self.repeats[0]), around(cell / width, height, self.repeats[1])];
        let mut all = [const { 0..0 }; 6];
        for (row, all) in rows.into_iter().flatten().zip(all.chunks_exact_mut(2)) {
            for (to, columns) in all.iter_mut().zip(&columns) {
                *to = row * width + columns.start..row * width + columns.end;
            }
        }
        all
    }
}

/// Column (or row) number `own` of `count`, and the columns (or rows) beside it.
#[inline]
fn around(own: u32, count: u32, repeats: bool) -> [Range<u32>; 2] {
    let here = own.saturating_sub(1)..(own + 2).min(count);
    if !repeats || here.len() == 3 {
        [here, 0..0]
    } else if count <= 3 {
        [0..count, 0..0]
    } else if own == 0 {
        [here, count - 1..count]
    } else {
        [here, 0..1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_beside_one_are_named_once() {
        for (count, repeats) in (1..7).flat_map(|count| [(count, false), (count, true)]) {
            for own in 0..count {
                let mut found: Vec<u32> = around(own, count, repeats).into_iter().flatten().collect();
                found.sort_unstable();
                let beside = |other: &u32| {
                    let far = other.abs_diff(own);
                    far <= 1 || (repeats && far == count - 1)
                };
                let expected: Vec<u32> = (0..count).filter(beside).collect();
                assert_eq!(found, expected, "{own} of {count}, repeats: {repeats}");
            }
        }
    }
}
