//! Control points as they are written down, cell by cell.

use glam::DVec3;
use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::shape::cardinal;

/// Control points of a cell where all have as many: those of a plain loop and the arc before it.
const EVEN: usize = 12;

/// The control points of a yarn.
#[derive(Debug, Default)]
pub(super) struct Laid {
    pub(super) points: Vec<DVec3>,
    /// What each comes from: see [`Operation::source`](super::Operation::source).
    pub(super) sources: Vec<u32>,
    /// Those that nothing but the machine holds: ends of the yarn, feet of the first course, and
    /// heads on needles.
    pub(super) pinned: Vec<u64>,
}

/// Writes control points down.
#[derive(Debug, Default)]
pub(super) struct Pen {
    laid: Laid,
    source: u32,
    /// Where each cell begins.
    cells: Vec<usize>,
    /// Where the last one ends, if something comes after it.
    tail: Option<usize>,
}

impl Pen {
    /// Makes room for so many points more.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn room(&mut self, points: usize) -> Result<(), OutOfMemory> {
        room_for(&mut self.laid.points, points, "points of a yarn")?;
        room_for(&mut self.laid.sources, points, "sources of a yarn's points")
    }

    /// A cell begins.
    pub(super) fn cell(&mut self, source: u32) {
        self.source = source;
        self.cells.push(self.laid.points.len());
    }

    /// The last cell has ended.
    pub(super) fn tail(&mut self) {
        self.tail = Some(self.laid.points.len());
    }

    /// What comes next comes from there.
    pub(super) fn source(&mut self, source: u32) {
        self.source = source;
    }

    pub(super) fn point(&mut self, point: DVec3) {
        self.laid.points.push(point);
        self.laid.sources.push(self.source);
    }

    /// Pins the last point.
    pub(super) fn pin(&mut self) {
        self.laid.pinned.push(self.laid.points.len() as u64 - 1);
    }

    /// The points as they were written.
    pub(super) fn laid(self) -> Laid {
        self.laid
    }

    /// As many points in each cell, along the curve through those that were written. `onward` is
    /// how far the yarn's next round lies from this one. What comes before the first cell and after
    /// the last stays as it is.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn even(self, onward: Option<DVec3>) -> Result<Laid, OutOfMemory> {
        let Laid { points, sources, pinned } = &self.laid;
        let count = points.len() as isize;
        let at = |number: isize| match onward {
            Some(shift) => {
                points[number.rem_euclid(count) as usize] + shift * number.div_euclid(count) as f64
            }
            None => points[number.clamp(0, count - 1) as usize],
        };
        let end = self.tail.unwrap_or(points.len());
        let mut even = Laid::default();
        let total = self.cells.len() * EVEN + points.len();
        room_for(&mut even.points, total, "points of a yarn")?;
        room_for(&mut even.sources, total, "sources of a yarn's points")?;
        let keep = |range: std::ops::Range<usize>, even: &mut Laid| {
            for number in range {
                if pinned.binary_search(&(number as u64)).is_ok() {
                    even.pinned.push(even.points.len() as u64);
                }
                even.points.push(points[number]);
                even.sources.push(sources[number]);
            }
        };
        keep(0..self.cells.first().copied().unwrap_or(end), &mut even);
        for (index, &first) in self.cells.iter().enumerate() {
            let last = self.cells.get(index + 1).copied().unwrap_or(end);
            if last - first == EVEN {
                keep(first..last, &mut even);
                continue;
            }
            for step in 0..EVEN {
                let along = (last - first) as f64 * step as f64 / EVEN as f64;
                let number = first as isize + along as isize;
                let four = [-1, 0, 1, 2].map(|beside| at(number + beside));
                even.points.push(cardinal(four, along.fract()));
                even.sources.push(sources[first]);
            }
            // Of pinned points the nearest to where they were.
            let pins = pinned.iter().filter(|pin| (first as u64..last as u64).contains(pin));
            for pin in pins {
                let along = (pin - first as u64) as f64 / (last - first) as f64;
                let step = ((along * EVEN as f64).round() as usize).min(EVEN - 1);
                even.pinned.push((even.points.len() - EVEN + step) as u64);
            }
        }
        keep(end..points.len(), &mut even);
        Ok(even)
    }
}
