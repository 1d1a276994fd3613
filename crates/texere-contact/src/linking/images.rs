//! The copies of intervals that a repeat makes.

use glam::{DVec3, Vec3A};
use rayon::prelude::*;

use super::shapes::Span;
use crate::ContactError;
use crate::grid::Bounds;

/// The most intervals that are compared, copies included.
const LIMIT: u64 = 1 << 29;

/// The copies of an interval's box that are searched: the copy that begins within the first repeat,
/// and earlier copies that still reach into the first repeat. If copies of two boxes meet, an equal
/// pair of copies meets in every repeat. Only one of these pairs is compared. Along each axis, that
/// copy of this pair which begins last begins within the first repeat, so both are searched.
#[derive(Debug)]
pub(super) struct Images {
    /// Lengths of the repeat along x and y, mm. A length is 0 if nothing repeats along that axis.
    repeat: [f64; 2],
    /// The most copies of one box along each axis.
    most: [u64; 2],
    points: u64,
}

/// One copy of an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct Image {
    /// Number of repeats by which the copy begins before the first repeat, along x and y.
    pub(super) back: [u64; 2],
    /// Number of whole repeats by which the copy is moved from the interval's control points, along
    /// x and y.
    pub(super) moved: [f64; 2],
}

impl Image {
    /// Number of whole repeats by which this copy is moved further than the `other`, along x and y.
    pub(super) fn from(&self, other: &Self) -> [f64; 2] {
        [0, 1].map(|axis| self.moved[axis] - other.moved[axis])
    }
}

impl Images {
    /// The copies of the boxes in `spans`. Boxes are numbered by their control points, and `points`
    /// is the number of all control points.
    ///
    /// **Errors**: [`ContactError::LinkingSize`].
    pub(super) fn new<'s, I: Iterator<Item = (usize, Bounds)>>(
        repeat: [f32; 2],
        points: u64,
        spans: &'s [Span],
        boxes: impl Fn(&'s Span) -> I + Sync,
    ) -> Result<Self, ContactError> {
        let mut images = Self { repeat: repeat.map(f64::from), most: [1; 2], points };
        let (intervals, most) = spans
            .par_iter()
            .map(|span| {
                boxes(span).fold((0_u64, [1; 2]), |(sum, most), (_, each)| {
                    let count = images.count(&each);
                    (sum.saturating_add(count[0].saturating_mul(count[1])), larger(most, count))
                })
            })
            .reduce(|| (0, [1; 2]), |a, b| (a.0.saturating_add(b.0), larger(a.1, b.1)));
        let numbers = points.saturating_mul(most[0]).saturating_mul(most[1]);
        if intervals > LIMIT || numbers > u64::from(u32::MAX) {
            return Err(ContactError::LinkingSize { intervals: intervals.max(numbers), limit: LIMIT });
        }
        images.most = most;
        Ok(images)
    }

    /// Number of repeats by which a box is moved to begin within the first repeat, along x and y.
    fn home(&self, each: &Bounds) -> [f64; 2] {
        [0, 1].map(|axis| match self.repeat[axis] {
            0.0 => 0.0,
            repeat => -(f64::from(each.low[axis]) / repeat).floor(),
        })
    }

    /// Number of copies of a box that are searched, along each axis.
    fn count(&self, each: &Bounds) -> [u64; 2] {
        let home = self.home(each);
        [0, 1].map(|axis| match self.repeat[axis] {
            0.0 => 1,
            repeat => (f64::from(each.high[axis]) / repeat + home[axis]).floor() as u64 + 1,
        })
    }

    /// The copies of interval `number` that are searched: each copy's own number and its box.
    pub(super) fn of(&self, (number, each): (usize, Bounds)) -> impl Iterator<Item = (usize, Bounds)> {
        let count = self.count(&each);
        (0..count[1]).flat_map(move |y| (0..count[0]).map(move |x| [x, y])).map(move |back| {
            let copy = number as u64 + self.points * (back[0] + self.most[0] * back[1]);
            let offset = self.offset(self.image(&each, back).moved).as_vec3a();
            (copy as usize, shifted(each, offset))
        })
    }

    /// The interval of copy `number`, and the number of repeats by which the copy begins before the
    /// first repeat.
    pub(super) fn decode(&self, number: usize) -> (usize, [u64; 2]) {
        let (point, copy) = (number as u64 % self.points, number as u64 / self.points);
        (point as usize, [copy % self.most[0], copy / self.most[0]])
    }

    /// The copy of a box's interval that begins `back` repeats before the first repeat.
    pub(super) fn image(&self, each: &Bounds, back: [u64; 2]) -> Image {
        let home = self.home(each);
        Image { back, moved: [0, 1].map(|axis| home[axis] - back[axis] as f64) }
    }

    /// The vector of `moved` repeats along x and y, mm.
    pub(super) fn offset(&self, moved: [f64; 2]) -> DVec3 {
        DVec3::new(moved[0] * self.repeat[0], moved[1] * self.repeat[1], 0.0)
    }
}

/// The box `each` moved by `offset`.
pub(super) fn shifted(each: Bounds, offset: Vec3A) -> Bounds {
    Bounds { low: each.low + offset, high: each.high + offset }
}

fn larger(one: [u64; 2], other: [u64; 2]) -> [u64; 2] {
    [one[0].max(other[0]), one[1].max(other[1])]
}
