//! The ends of yarns where a warp knit is cut off.

use texere_core::{Origin, Yarns};

use super::WarpKnitted;
use crate::FabricError;
use crate::weft::Cells;

/// Control points by which yarns go on below the cloth. They are the last points of the course
/// below, in its underlap, its loop or its inlay.
const BELOW: u32 = 3;

/// Control points by which yarns go on above the cloth: up to the middle of the leg of the next
/// loop, beyond the heads that hold this leg.
///
/// In 151 random Jacquard figures of two diameters the least clearance was 0.980 with 4 points,
/// where the end itself, moved by [`ASIDE`], came near a neighbour. It was 0.994 with 3, and less
/// than 0.88 with 5 or 6, which end in the head. With 4 or 5
/// `figures_are_as_clear_where_they_are_cut_off` is red.
const ABOVE: u32 = 3;

/// Distances by which the lower and the upper end of a yarn lie aside from the place where the yarn
/// goes on in the repeat. The unit is the difference between the steps from point to point before
/// and after the end.
///
/// In the repeat a further point bends the last interval of the spline. At the cut that point is
/// missing, and the spline runs too straight.
///
/// At the upper end, the spline half way along the interval is off by 1/16 of the difference, and
/// yarns of guides that share a needle come to a clearance of 0.84. When the end moves, the middle
/// of the interval moves by 7/16 of that distance, so that 1/7 brings the middle back to its place.
/// The figures of [`ABOVE`] had a least clearance of 0.994 with 1/7, and of 0.982 with 1/8. With 0
/// `figures_are_as_clear_where_they_are_cut_off` is red.
///
/// At the lower end, neighbours touch at a tenth to a fifth of the first interval. Two figures had
/// a least clearance of 0.983 and 0.980 with 0 and 0.06, and of 0.995 with 0.08 to 1/7. With 0.06
/// `figures_are_as_clear_where_they_are_cut_off` is red.
///
/// One of 670 random figures of two diameters had a clearance below 0.99: 0.966, between two upper
/// ends that were moved towards one another. `any_figure_rests` allows 0.95. With half the values,
/// `cut_edges_are_as_clear_as_the_repeat` is red; with twice, `any_figure_rests`.
const ASIDE: [f32; 2] = [0.1, 1.0 / 7.0];

impl WarpKnitted {
    /// Number of control points by which yarns go on beyond the cloth, at their beginning and at
    /// their end. With [`Cells::Even`] there are none.
    pub(super) const fn beyond(&self) -> [u32; 2] {
        match self.cells {
            Cells::Round => [BELOW, ABOVE],
            Cells::Even => [0, 0],
        }
    }

    /// Moves the ends of the cloth's yarns aside by [`ASIDE`].
    ///
    /// **Errors**: [`FabricError::Yarns`] if an end would lie too far out.
    pub(super) fn ended(&self, mut yarns: Yarns) -> Result<Yarns, FabricError> {
        if self.beyond() == [0, 0] {
            return Ok(yarns);
        }
        let last = self.lapped_size()[1] - 1;
        for yarn in 0..yarns.layout().yarns().len() {
            let origin = yarns.layout().yarns()[yarn].origin;
            let points = yarns.yarn_points(yarn).unwrap_or(&[]);
            // All rounds are alike: the lower end has a copy in the last round, and the upper end
            // has one in the first.
            let copies =
                [points.len().checked_sub((BELOW + ABOVE) as usize), Some((BELOW + ABOVE) as usize - 1)];
            // Below lies a copy of the last lap, above one of the first.
            let laps = [last, 0];
            let moves = [0, 1].map(|side| {
                let copy = copies[side].filter(|_| self.makes_a_loop(origin, laps[side]))?;
                let around = points.get(copy.checked_sub(1)?..=copy + 1)?;
                let [before, end, after] = around else { return None };
                Some(ASIDE[side] * (before.position() - 2.0 * end.position() + after.position()))
            });
            if moves == [None, None] {
                continue;
            }
            let mut points = points.to_vec();
            for (end, aside) in [0, points.len() - 1].into_iter().zip(moves) {
                let [x, y, z] = (points[end].position() - aside.unwrap_or_default()).to_array();
                (points[end].x, points[end].y, points[end].z) = (x, y, z);
            }
            yarns.set_points(yarn, &points)?;
        }
        Ok(yarns)
    }

    /// Whether the lap of a guide at a course makes a loop.
    fn makes_a_loop(&self, origin: Origin, course: u32) -> bool {
        let Origin::Guide { bar, guide } = origin else { return false };
        let bar = self.bars().get((bar as usize).wrapping_sub(1));
        bar.is_some_and(|bar| bar.lap(guide.wrapping_sub(1), course).overlap() != 0)
    }
}
