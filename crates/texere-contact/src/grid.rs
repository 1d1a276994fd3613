//! A uniform grid over the boxes of all intervals.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use glam::{UVec3, Vec3A};
use rayon::prelude::*;
use texere_core::OutOfMemory;
use texere_core::backend::room;

use crate::ContactError;
use crate::watch::Watch;

/// The most cells that an interval may lie in on average. If intervals lie in more, the cells are
/// made larger. With half the value, and with twice, no test is red.
pub(crate) const ENTRIES: u64 = 6;

/// A cell's side over the mean of the boxes' longest sides. Most boxes then lie in one or two
/// cells, and few boxes of a cell are far from one another. With half the value,
/// `a_crowd_is_nearer_somewhere_than_its_fill_says` is red; with twice, no test is.
const CELL: f64 = 1.75;

/// If there are no more cells than this along an axis, one cell replaces them. With half the value,
/// `a_crowd_is_nearer_somewhere_than_its_fill_says` is red; with twice, no test is.
const LAYERS: f32 = 4.0;

/// A box with sides along the axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) low: Vec3A,
    pub(crate) high: Vec3A,
}

impl Bounds {
    pub(crate) const NOTHING: Self = Self { low: Vec3A::INFINITY, high: Vec3A::NEG_INFINITY };

    pub(crate) fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        (self.low.cmple(other.high) & other.low.cmple(self.high)).all()
    }
}

/// For each cell, the boxes that reach into the cell.
#[derive(Debug)]
pub(crate) struct Grid {
    low: Vec3A,
    /// Cells per millimetre along each axis.
    scale: Vec3A,
    cells: UVec3,
    /// The end of each cell's entries. They start where the entries of the cell before end.
    ends: Vec<AtomicU32>,
    entries: Vec<AtomicU32>,
}

impl Grid {
    /// Sorts numbered boxes into cells. `boxes(task)` gives the boxes of one of `tasks`.
    ///
    /// **Errors**: [`ContactError::OutOfMemory`], and [`ContactError::Cancelled`] if the caller of
    /// `watch` asks to stop.
    pub(crate) fn new<I: Iterator<Item = (usize, Bounds)>>(
        tasks: usize,
        watch: &Watch<'_>,
        boxes: impl Fn(usize) -> I + Sync,
    ) -> Result<Self, ContactError> {
        let (whole, sides, count) = (0..tasks)
            .into_par_iter()
            .map(|task| -> Result<_, ContactError> {
                watch.advance(0)?;
                Ok(boxes(task).fold((Bounds::NOTHING, 0.0, 0u64), |(whole, sides, count), (_, each)| {
                    let side = f64::from((each.high - each.low).max_element());
                    (whole.joined(each), sides + side, count + 1)
                }))
            })
            .try_reduce(|| (Bounds::NOTHING, 0.0, 0), |a, b| Ok((a.0.joined(b.0), a.1 + b.1, a.2 + b.2)))?;
        // Cells are made larger as long as there are more than two for each box, or as a few large
        // boxes lie in too many of them.
        let mut cell = (CELL * sides / count.max(1) as f64) as f32;
        loop {
            let size = whole.high - whole.low;
            let wanted = (size / cell).floor() + 1.0;
            // A fabric is thin: a few layers of cells would separate yarns that lie on top of one
            // another.
            let wanted = Vec3A::select(wanted.cmple(Vec3A::splat(LAYERS)), Vec3A::ONE, wanted);
            let total = wanted.as_dvec3().element_product();
            if total.is_finite() && total <= 2.0 * count as f64 + 1.0 {
                let scale = wanted / size.max(Vec3A::splat(f32::MIN_POSITIVE));
                let mut grid = Self {
                    low: whole.low,
                    scale,
                    cells: wanted.as_uvec3(),
                    ends: Vec::new(),
                    entries: Vec::new(),
                };
                grid.ends = zeroed("a grid's cells", total as u64)?;
                let most = if total <= 1.0 { u64::MAX } else { ENTRIES * count };
                let entries = grid.count(tasks, watch, &boxes, most)?;
                if entries <= most {
                    grid.entries = zeroed("a grid's entries", entries)?;
                    grid.fill(tasks, watch, &boxes)?;
                    return Ok(grid);
                }
            }
            cell *= 1.5;
        }
    }

    /// Counts the boxes that reach into each cell, and returns the sum of all counts. Counting
    /// stops above `most`, because a few boxes that reach into every cell would take hours.
    fn count<I: Iterator<Item = (usize, Bounds)>>(
        &self,
        tasks: usize,
        watch: &Watch<'_>,
        boxes: impl Fn(usize) -> I + Sync,
        most: u64,
    ) -> Result<u64, ContactError> {
        let reached = AtomicU64::new(0);
        (0..tasks).into_par_iter().try_for_each(|task| {
            watch.advance(0)?;
            for (_, each) in boxes(task) {
                let cells = (self.cell(each.high) - self.cell(each.low) + 1).as_u64vec3().element_product();
                if reached.fetch_add(cells, Ordering::Relaxed) > most.saturating_sub(cells) {
                    break;
                }
                self.each_cell(&each, |cell| {
                    self.ends[cell].fetch_add(1, Ordering::Relaxed);
                });
            }
            Ok::<(), ContactError>(())
        })?;
        Ok(reached.into_inner())
    }

    /// Turns the counts into places of entries, and writes the boxes' numbers to these places.
    fn fill<I: Iterator<Item = (usize, Bounds)>>(
        &mut self,
        tasks: usize,
        watch: &Watch<'_>,
        boxes: impl Fn(usize) -> I + Sync,
    ) -> Result<(), ContactError> {
        let mut start = 0;
        for end in &mut self.ends {
            let count = *end.get_mut();
            *end.get_mut() = start;
            start += count;
        }
        // Each entry that is written moves its cell's start on by one. After all entries, the
        // starts have become the ends.
        let grid = &*self;
        (0..tasks).into_par_iter().try_for_each(|task| {
            watch.advance(0)?;
            for (number, each) in boxes(task) {
                grid.each_cell(&each, |cell| {
                    let place = grid.ends[cell].fetch_add(1, Ordering::Relaxed);
                    grid.entries[place as usize].store(number as u32, Ordering::Relaxed);
                });
            }
            Ok(())
        })
    }

    /// The cell that `corner` lies in. Rounding keeps the order of corners.
    pub(crate) fn cell(&self, corner: Vec3A) -> UVec3 {
        ((corner - self.low) * self.scale).as_uvec3().min(self.cells - 1)
    }

    /// The number of `cell`.
    pub(crate) fn number(&self, cell: UVec3) -> usize {
        (cell.z as usize * self.cells.y as usize + cell.y as usize) * self.cells.x as usize + cell.x as usize
    }

    fn each_cell(&self, bounds: &Bounds, mut visit: impl FnMut(usize)) {
        let (from, to) = (self.cell(bounds.low), self.cell(bounds.high));
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                for x in from.x..=to.x {
                    visit(self.number(UVec3::new(x, y, z)));
                }
            }
        }
    }

    /// Number of cells.
    pub(crate) const fn len(&self) -> usize {
        self.ends.len()
    }

    fn places(&self, cell: usize) -> Range<usize> {
        let end = |cell: usize| self.ends[cell].load(Ordering::Relaxed) as usize;
        if cell == 0 { 0..end(cell) } else { end(cell - 1)..end(cell) }
    }

    /// Number of boxes that reach into `cell`.
    pub(crate) fn count_in(&self, cell: usize) -> usize {
        self.places(cell).len()
    }

    /// The numbers of the boxes that reach into `cell`, in no particular order.
    pub(crate) fn entries(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        self.entries[self.places(cell)].iter().map(|entry| entry.load(Ordering::Relaxed) as usize)
    }
}

/// `count` zeros.
fn zeroed(what: &'static str, count: u64) -> Result<Vec<AtomicU32>, OutOfMemory> {
    let mut zeros = room(what, count as usize)?;
    zeros.extend((0..count).map(|_| AtomicU32::new(0)));
    Ok(zeros)
}
