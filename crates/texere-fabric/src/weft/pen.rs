//! A pen that records the control points of a yarn cell by cell.

use glam::DVec3;
use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::shape::cardinal;

/// Number of control points of a cell with [`Cells::Even`](super::Cells::Even): as many as a plain
/// loop has together with the arc before it. `even_cells_have_twelve_points_each` counts them.
const EVEN: usize = 12;

/// The control points of a yarn that has been laid.
#[derive(Debug, Default)]
pub(super) struct YarnPoints {
    pub(super) points: Vec<DVec3>,
    /// The source of each point: see [`Operation::source`](super::Operation::source).
    pub(super) sources: Vec<u32>,
    /// Indices of the points that are pinned because only the machine holds them: ends of the yarn,
    /// arcs of the first course, and heads on needles.
    pub(super) pinned: Vec<u64>,
}

/// Records the control points of one yarn.
#[derive(Debug, Default)]
pub(super) struct Pen {
    placed: YarnPoints,
    source: u32,
    /// Index of the first point of each cell.
    cells: Vec<usize>,
    /// Index of the point after the last cell, if points come after that cell.
    tail: Option<usize>,
}

impl Pen {
    /// Reserves memory for `points` more points.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn room(&mut self, points: usize) -> Result<(), OutOfMemory> {
        room_for(&mut self.placed.points, points, "points of a yarn")?;
        room_for(&mut self.placed.sources, points, "sources of a yarn's points")
    }

    /// Begins a cell whose points have this source.
    pub(super) fn cell(&mut self, source: u32) {
        self.source = source;
        self.cells.push(self.placed.points.len());
    }

    /// Ends the last cell.
    pub(super) fn tail(&mut self) {
        self.tail = Some(self.placed.points.len());
    }

    /// Sets the source of the points that follow.
    pub(super) fn source(&mut self, source: u32) {
        self.source = source;
    }

    pub(super) fn point(&mut self, point: DVec3) {
        self.placed.points.push(point);
        self.placed.sources.push(self.source);
    }

    /// Pins the point that was recorded last.
    pub(super) fn pin(&mut self) {
        self.placed.pinned.push(self.placed.points.len() as u64 - 1);
    }

    /// The points as they were recorded.
    pub(super) fn into_points(self) -> YarnPoints {
        self.placed
    }

    /// Equally many points for each cell, on the curve through the recorded points. `onward` is the
    /// vector from this round of the yarn to the next one, mm. Points before the first cell and
    /// after the last one stay unchanged.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn even(self, onward: Option<DVec3>) -> Result<YarnPoints, OutOfMemory> {
        let YarnPoints { points, sources, pinned } = &self.placed;
        let count = points.len() as isize;
        let at = |number: isize| match onward {
            Some(shift) => {
                points[number.rem_euclid(count) as usize] + shift * number.div_euclid(count) as f64
            }
            None => points[number.clamp(0, count - 1) as usize],
        };
        let end = self.tail.unwrap_or(points.len());
        let mut even = YarnPoints::default();
        let total = self.cells.len() * EVEN + points.len();
        room_for(&mut even.points, total, "points of a yarn")?;
        room_for(&mut even.sources, total, "sources of a yarn's points")?;
        let keep = |range: std::ops::Range<usize>, even: &mut YarnPoints| {
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
            // The new point that lies nearest to a pinned point is pinned instead.
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
