//! A uniform grid over the boxes of all intervals.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::{DVec3, UVec3};
use rayon::prelude::*;

use crate::FabricError;

/// The most cells that an interval lies in on average, before larger cells are taken.
const ENTRIES: u64 = 6;

/// Cells along an axis that are not worth having: one takes their place.
const LAYERS: f64 = 4.0;

/// A box with sides along the axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Bounds {
    const NOTHING: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The box round `points`, `margin` wider on each side.
    pub(super) fn around(points: &[DVec3], margin: f64) -> Self {
        let low = points.iter().fold(DVec3::INFINITY, |low, point| low.min(*point));
        let high = points.iter().fold(DVec3::NEG_INFINITY, |high, point| high.max(*point));
        Self { low: low - margin, high: high + margin }
    }

    fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Which boxes reach into which cell.
#[derive(Debug)]
pub(super) struct Grid {
    low: DVec3,
    cell: DVec3,
    cells: UVec3,
    /// Where each cell's entries end; they start where those of the cell before end.
    ends: Vec<AtomicU32>,
    entries: Vec<AtomicU32>,
}

impl Grid {
    /// Sorts the boxes `bounds(number)` of `numbers` into cells.
    ///
    /// **Errors**: [`FabricError::OutOfMemory`].
    pub(super) fn new(
        numbers: usize,
        bounds: impl Fn(usize) -> Option<Bounds> + Sync,
    ) -> Result<Self, FabricError> {
        let (whole, sides, count) = (0..numbers)
            .into_par_iter()
            .filter_map(&bounds)
            .map(|each| (each, (each.high - each.low).max_element(), 1u64))
            .reduce(|| (Bounds::NOTHING, 0.0, 0), |a, b| (a.0.joined(b.0), a.1 + b.1, a.2 + b.2));
        // As large as a box is on average; larger where some boxes are so much larger that they lie in too many.
        let mut cell = sides / count.max(1) as f64;
        loop {
            let low = whole.low;
            let wanted = ((whole.high - whole.low) / cell).floor() + 1.0;
            // A fabric is thin: a few layers of cells would part what lies on top of one another.
            let wanted = DVec3::select(wanted.cmple(DVec3::splat(LAYERS)), DVec3::ONE, wanted);
            let total = wanted.element_product();
            if total.is_finite() && total <= 2.0 * count as f64 + 1.0 {
                let size = ((whole.high - low) / wanted).max(DVec3::splat(f64::MIN_POSITIVE));
                let mut grid =
                    Self { low, cell: size, cells: wanted.as_uvec3(), ends: Vec::new(), entries: Vec::new() };
                let reached = |each: Bounds| {
                    let [from, to] = grid.range(&each);
                    (to - from + 1).as_u64vec3().element_product()
                };
                let entries: u64 = (0..numbers).into_par_iter().filter_map(&bounds).map(reached).sum();
                if entries <= ENTRIES * count.max(1) || total <= 1.0 {
                    grid.fill(numbers, entries, bounds)?;
                    return Ok(grid);
                }
            }
            cell *= 1.5;
        }
    }

    fn fill(
        &mut self,
        numbers: usize,
        entries: u64,
        bounds: impl Fn(usize) -> Option<Bounds> + Sync,
    ) -> Result<(), FabricError> {
        let cells = self.cells.as_u64vec3().element_product();
        self.ends = zeroed("a grid's cells", cells)?;
        self.entries = zeroed("a grid's entries", entries)?;
        let grid = &*self;
        (0..numbers).into_par_iter().filter_map(&bounds).for_each(|each| {
            grid.each_cell(&each, |cell| {
                grid.ends[cell].fetch_add(1, Ordering::Relaxed);
            });
        });
        let mut start = 0;
        for end in &mut self.ends {
            let count = *end.get_mut();
            *end.get_mut() = start;
            start += count;
        }
        // What were the cells' starts become their ends as each entry takes its place.
        let grid = &*self;
        (0..numbers).into_par_iter().for_each(|number| {
            if let Some(each) = bounds(number) {
                grid.each_cell(&each, |cell| {
                    let place = grid.ends[cell].fetch_add(1, Ordering::Relaxed);
                    grid.entries[place as usize].store(number as u32, Ordering::Relaxed);
                });
            }
        });
        Ok(())
    }

    /// The first and the last cell that `bounds` reaches into.
    fn range(&self, bounds: &Bounds) -> [UVec3; 2] {
        [bounds.low, bounds.high].map(|corner| {
            let cell = ((corner - self.low) / self.cell).floor().max(DVec3::ZERO);
            cell.as_uvec3().min(self.cells - 1)
        })
    }

    fn number(&self, cell: UVec3) -> usize {
        (cell.z as usize * self.cells.y as usize + cell.y as usize) * self.cells.x as usize + cell.x as usize
    }

    fn each_cell(&self, bounds: &Bounds, mut visit: impl FnMut(usize)) {
        let [from, to] = self.range(bounds);
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                for x in from.x..=to.x {
                    visit(self.number(UVec3::new(x, y, z)));
                }
            }
        }
    }

    /// How many cells there are.
    pub(super) const fn len(&self) -> usize {
        self.ends.len()
    }

    /// The numbers of the boxes that reach into `cell`, in no particular order.
    pub(super) fn entries(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        let end = |cell: usize| self.ends[cell].load(Ordering::Relaxed) as usize;
        let start = if cell == 0 { 0 } else { end(cell - 1) };
        self.entries[start..end(cell)].iter().map(|entry| entry.load(Ordering::Relaxed) as usize)
    }

    /// Whether `cell` is the one that counts for two boxes that may meet in several: where what they share begins.
    pub(super) fn counts(&self, cell: usize, one: &Bounds, other: &Bounds) -> bool {
        let low = one.low.max(other.low);
        self.number(self.range(&Bounds { low, high: low })[0]) == cell
    }
}

/// `count` zeros.
fn zeroed(what: &'static str, count: u64) -> Result<Vec<AtomicU32>, FabricError> {
    let mut zeros = Vec::new();
    zeros
        .try_reserve_exact(count as usize)
        .map_err(|_| FabricError::OutOfMemory { what, bytes: count * 4 })?;
    zeros.extend((0..count).map(|_| AtomicU32::new(0)));
    Ok(zeros)
}
