//! The search for intervals that are near one another and may have passed, and the comparison of
//! their linking before and after.

use std::ops::Range;

use glam::DVec3;
use texere_core::YarnPlace;
use texere_core::backend::room_for;

use super::chords::integral;
use super::found::Found;
use super::images::Images;
use super::part::Part;
use super::passage::{LINKING_BESIDE, LINKING_COMPARED, Passage};
use super::shapes::{Shape, Shapes};
use super::strand::Strand;
use super::window::Window;
use crate::ContactError;
use crate::grid::Grid;
use crate::watch::Watch;

/// Number of units of progress of one search.
pub(super) const SEARCH: u64 = 1 << 32;

/// Number of intervals between two reports of progress.
const REPORT_EVERY: u64 = 256;

/// The least number of intervals between two intervals of one yarn that are compared. Windows of
/// nearer intervals would be too short to show a passage. With twice the value,
/// `the_same_is_found_whatever_the_threads` is red; with half, no test is.
const NEIGHBOURS: f64 = 6.0;

/// The yarns in both shapes, with the cells of their intervals in one of the shapes.
pub(super) struct Search<'a> {
    shapes: &'a Shapes<'a>,
    images: &'a Images,
    grid: &'a Grid,
    shape: Shape,
    /// Number of units of progress for an interval in a cell.
    units: u64,
}

impl<'a> Search<'a> {
    pub(super) fn new(shapes: &'a Shapes<'a>, images: &'a Images, grid: &'a Grid, shape: Shape) -> Self {
        let entries: u64 = (0..grid.len()).map(|cell| grid.count_in(cell) as u64).sum();
        Self { shapes, images, grid, shape, units: SEARCH / entries.max(1) }
    }

    /// All passages of intervals that meet in `cells`.
    ///
    /// **Errors**: [`ContactError::OutOfMemory`], and [`ContactError::Cancelled`] if the caller of
    /// `watch` asks to stop.
    pub(super) fn cells(&self, cells: Range<usize>, watch: &Watch<'_>) -> Result<Found, ContactError> {
        let mut found = Found::default();
        let (mut numbers, mut parts) = (Vec::new(), Vec::new());
        let mut unreported = 0;
        for cell in cells {
            self.read(cell, &mut numbers, &mut parts)?;
            for (place, one) in parts.iter().enumerate() {
                let edge = one.bounds[self.shape as usize].high.x;
                let after = &parts[place + 1..];
                let beside = after.partition_point(|other| other.bounds[self.shape as usize].low.x <= edge);
                found.left_out += beside.saturating_sub(LINKING_BESIDE) as u64;
                let may_have_passed =
                    |other: &&Part| self.counts(one, other, cell) && one.may_have_passed(other);
                let mut passed = after[..beside.min(LINKING_BESIDE)].iter().filter(may_have_passed);
                for other in passed.by_ref().take(LINKING_COMPARED) {
                    self.compare(one, other, &mut found);
                }
                found.left_out += passed.count() as u64;
                unreported += 1;
                if unreported >= REPORT_EVERY {
                    watch.advance(self.units * std::mem::take(&mut unreported))?;
                }
            }
        }
        watch.advance(self.units * unreported)?;
        Ok(found)
    }

    /// Reads the intervals of a cell into `parts`, from left to right.
    fn read(&self, cell: usize, numbers: &mut Vec<usize>, parts: &mut Vec<Part>) -> Result<(), ContactError> {
        numbers.clear();
        room_for(numbers, self.grid.count_in(cell), "a cell's intervals")?;
        numbers.extend(self.grid.entries(cell));
        numbers.sort_unstable();
        parts.clear();
        room_for(parts, numbers.len(), "a cell's intervals")?;
        for &number in &*numbers {
            let copy = self.images.decode(number);
            parts.push(Part::new(self.shapes, copy, self.images, (self.grid, self.shape)));
        }
        let low = |part: &Part| part.bounds[self.shape as usize].low.x;
        parts.sort_by(|one, other| low(one).total_cmp(&low(other)));
        Ok(())
    }

    /// Whether two intervals of a cell are near one another and are to be compared in this cell.
    /// Two copies may meet in several cells, and be near both before and after. Each pair is
    /// compared once.
    fn counts(&self, one: &Part, other: &Part, cell: usize) -> bool {
        let meet = |shape: Shape| one.bounds[shape as usize].meets(&other.bounds[shape as usize]);
        let begins_here = (0..2).all(|axis| one.image.back[axis] == 0 || other.image.back[axis] == 0)
            && self.grid.number(one.cell.max(other.cell)) == cell;
        meet(self.shape)
            && begins_here
            && (self.shape == Shape::Before
                || ((one.motion.is_far() || other.motion.is_far()) && !meet(Shape::Before)))
            && self.gap(one, other) >= NEIGHBOURS
    }

    /// Number of intervals from one to the other along one yarn, infinite for two yarns.
    fn gap(&self, one: &Part, other: &Part) -> f64 {
        if one.yarn != other.yarn {
            return f64::INFINITY;
        }
        let [strand, _] = self.shapes.strands(one.yarn);
        strand.gap(one.interval, other.interval, other.image.from(&one.image)).unwrap_or(f64::INFINITY)
    }

    /// Compares the linking of the windows round two intervals before and after.
    fn compare(&self, one: &Part, other: &Part, found: &mut Found) {
        let in_order = (one.yarn, one.interval) <= (other.yarn, other.interval);
        let pair = if in_order { [one, other] } else { [other, one] };
        let strands = pair.map(|part| self.shapes.strands(part.yarn));
        let diameter = [0, 1].map(|side| f64::from(strands[side][0].half(pair[side].interval))).iter().sum();
        let most = self.gap(one, other) - 1.0;
        let windows =
            [0, 1].map(|side| Window::around(&strands[side][0], pair[side].interval, diameter, most));
        // The second window is moved to the copy that is near the first.
        let offset = self.images.offset(pair[1].image.from(&pair[0].image));
        let [before, after] = [0, 1].map(|shape| {
            let [one, other] = [0, 1].map(|side| windows[side].corners(&strands[side][shape]));
            integral(&one, &other.map(|corner| corner + offset))
        });
        found.add(after - before, || Passage {
            places: [self.place(pair[0], &strands[0], DVec3::ZERO), self.place(pair[1], &strands[1], offset)],
            change: after - before,
        });
    }

    /// The middle of an interval after the move, with `offset` added.
    fn place(&self, part: &Part, [_, after]: &[Strand<'_>; 2], offset: DVec3) -> YarnPlace {
        let (yarn, interval) = (part.yarn, part.interval);
        let position = (after.at(interval as f64 + 0.5) + offset).to_array();
        YarnPlace { yarn, interval, t: 0.5, position, source: self.shapes.source(yarn, interval) }
    }
}
