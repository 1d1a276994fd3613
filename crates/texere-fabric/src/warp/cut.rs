//! The ends of yarns where a warp knit is cut off.

use texere_core::{Origin, Yarns};

use super::WarpKnitted;
use crate::FabricError;
use crate::weft::Cells;

/// Control points by which yarns go on below the cloth, down into the last loop of the course
/// below.
const BELOW: u32 = 3;

/// Control points by which yarns go on above the cloth: up the leg of the next loop, beyond the
/// heads that hold this leg.
const ABOVE: u32 = 4;

/// Distance by which the upper end of a yarn lies aside from the place where its leg goes on in the
/// repeat. The unit is the difference between the last two steps from point to point.
///
/// In the repeat a further point bends the last interval of the spline. At the cut that point is
/// missing, and the spline runs too straight. Half way along the interval the spline is off by 1/16
/// of the difference, and yarns of guides that share a needle come to a clearance of 0.94. When the
/// end moves, the middle of the interval moves by 7/16 of that distance, so that 1/7 brings the
/// middle back to its place.
///
/// In 200 Jacquard figures the least clearance was 0.986 with 1/7, 0.984 with 0.13, and 0.978 with
/// 0.117, which corrects the interval at two thirds. With 0 or 0.117
/// `figures_are_as_clear_where_they_are_cut_off` is red.
const ASIDE: f32 = 1.0 / 7.0;

impl WarpKnitted {
    /// Number of control points by which yarns go on beyond the cloth, at their beginning and at
    /// their end. With [`Cells::Even`] there are none.
    pub(super) const fn beyond(&self) -> [u32; 2] {
        match self.cells {
            Cells::Round => [BELOW, ABOVE],
            Cells::Even => [0, 0],
        }
    }

    /// Moves the upper ends of the cloth's yarns aside by [`ASIDE`].
    ///
    /// **Errors**: [`FabricError::Yarns`] if an end would lie too far out.
    pub(super) fn ended(&self, mut yarns: Yarns) -> Result<Yarns, FabricError> {
        if self.beyond() == [0, 0] {
            return Ok(yarns);
        }
        for yarn in 0..yarns.layout().yarns().len() {
            let points = yarns.yarn_points(yarn).unwrap_or(&[]);
            // All rounds are alike: the leg above goes on as the first leg of the cloth does.
            let leg =
                points.get(BELOW as usize..).and_then(|own| own.get(ABOVE as usize - 2..=ABOVE as usize));
            let Some([middle, upper, head]) =
                leg.filter(|_| self.begins_with_loop(yarns.layout().yarns()[yarn].origin))
            else {
                continue;
            };
            let turn = head.position() - 2.0 * upper.position() + middle.position();
            let mut points = points.to_vec();
            if let Some(end) = points.last_mut() {
                let [x, y, z] = (end.position() - ASIDE * turn).to_array();
                (end.x, end.y, end.z) = (x, y, z);
            }
            yarns.set_points(yarn, &points)?;
        }
        Ok(yarns)
    }

    /// Whether the first lap of a guide makes a loop. The lap that follows above the cloth is a
    /// copy of it.
    fn begins_with_loop(&self, origin: Origin) -> bool {
        let Origin::Guide { bar, guide } = origin else { return false };
        let bar = self.bars().get((bar as usize).wrapping_sub(1));
        bar.is_some_and(|bar| bar.lap(guide.wrapping_sub(1), 0).overlap() != 0)
    }
}
