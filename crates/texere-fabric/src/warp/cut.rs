//! How yarns end where a warp knit is cut off.

use texere_core::{Origin, Yarns};

use super::WarpKnitted;
use crate::FabricError;
use crate::weft::Cells;

/// How many control points yarns go on below: down into the last loop there.
const BELOW: u32 = 3;

/// How many they go on above: up the leg of the next loop, until beyond the heads that hold it.
const ABOVE: u32 = 4;

/// How far such a leg ends aside from where it goes on in the repeat, in differences between the
/// step to that point and the step after it.
///
/// A spline lacks the point that bends its last interval in the repeat, and runs too straight
/// there: half way on it is off by 1/16 of that difference, and yarns of guides that share a needle
/// come to 0.94 of touching. An end aside by 1/7 of it takes that place back, since the spline has
/// 7/16 of what its end is moved by. Over 200 figures the least clearance was 0.986 then, 0.984
/// with 0.13 and 0.978 with 0.117, which takes back the place two thirds on. With 0 or 0.117
/// `figures_are_as_clear_where_they_are_cut_off` is red.
const ASIDE: f32 = 1.0 / 7.0;

impl WarpKnitted {
    /// How many control points yarns go on beyond the cloth at their beginning and at their end,
    /// where that does not spoil their count.
    pub(super) const fn beyond(&self) -> [u32; 2] {
        match self.cells {
            Cells::Round => [BELOW, ABOVE],
            Cells::Even => [0, 0],
        }
    }

    /// Yarns of the cloth, laid so far, as they end above.
    ///
    /// **Errors**: [`FabricError::Yarns`] where an end would lie too far out.
    pub(super) fn ended(&self, mut yarns: Yarns) -> Result<Yarns, FabricError> {
        if self.beyond() == [0, 0] {
            return Ok(yarns);
        }
        for yarn in 0..yarns.layout().yarns().len() {
            let points = yarns.yarn_points(yarn).unwrap_or(&[]);
            // All rounds are alike: a leg goes on as the cloth's first one does.
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

    /// Whether the first lap of a guide makes a loop, which is the next one above the cloth, too.
    fn begins_with_loop(&self, origin: Origin) -> bool {
        let Origin::Guide { bar, guide } = origin else { return false };
        let bar = self.bars().get((bar as usize).wrapping_sub(1));
        bar.is_some_and(|bar| bar.lap(guide.wrapping_sub(1), 0).overlap() != 0)
    }
}
