//! The rows of a plan, one for each thread, and the sites of crossings.

use super::{CrossingThread, CrossingsError, Set};
use crate::backend::room;

/// The bounds of a thread's shift sideways: a quarter of the plan's unit, and two fifths of the
/// distance to the nearer neighbour. The smaller of the two holds. Without bounds, threads pass
/// through one another. With half a unit instead of a quarter, plain weave of 10 tex with an end of
/// 60 tex keeps swinging (`neighbours_give_way_to_a_thick_end` of texere-fabric). With half the
/// values, `energy_goes_down_while_penalties_stay` is red; with twice,
/// `turns_of_uneven_picks_do_not_touch`.
const SIDEWAYS: [f32; 2] = [0.25, 0.4];

/// The ratio of width to thickness that a thread of ordinary twist tends to, if it is round when
/// nothing presses it. Of a firmer thread the ratio is nearer to 1. With half the value, and with
/// twice, `straight_threads_stretch_no_further` is red.
pub const ASPECT: f32 = 1.4;

/// The weight of the difference from the ratio that a thread tends to. 0.5, 1.5, 3 and 6 were
/// tried. The larger it is, the nearer the crimp of poplin and sheeting comes to published values.
/// With 3, denim folds (`cloths_of_the_mills_come_to_rest` of texere-fabric).
pub const SHAPE: f32 = 1.5;

/// A thread. Lengths are in the plan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The distance to the next thread.
    pub gap: f32,
    /// The thread's radius.
    pub radius: f32,
    /// The thread's stiffness against bending, as a multiple of cotton's. If the cloth has a thread
    /// stiffer than cotton, it is a share of the stiffest thread's stiffness instead.
    pub stiffness: f32,
    /// The ratio of width to thickness that the thread tends to.
    pub aspect: f32,
    /// The weight of the difference from the ratio [`aspect`](Self::aspect).
    pub shape: f32,
    /// The least area of the thread's section, as a share of its area.
    pub least_area: f32,
    /// The largest shift to either side. It is 0 for threads that are
    /// [held](super::Crossings::held).
    pub freedom: f32,
    /// The largest height of the thread above or below the middle of the cloth.
    pub height: f32,
}

/// A crossing, given by the numbers of its end and its pick, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Site {
    /// Number of the end.
    pub end: usize,
    /// Number of the pick.
    pub pick: usize,
}

impl Site {
    /// The number of the crossing's thread of a set.
    #[must_use]
    pub const fn thread(self, set: Set) -> usize {
        match set {
            Set::Warp => self.end,
            Set::Weft => self.pick,
        }
    }

    /// The crossing at which another thread of the set takes the place of this crossing's thread.
    pub(super) const fn with(self, set: Set, thread: usize) -> Self {
        match set {
            Set::Warp => Self { end: thread, ..self },
            Set::Weft => Self { pick: thread, ..self },
        }
    }
}

/// Number `at` moved on by `by` among `count` threads. If the threads repeat, the first follows the
/// last. If they do not repeat, there is none before the first or after the last.
pub(super) fn further(at: usize, by: i32, count: usize, repeats: bool) -> Option<usize> {
    let to = at.wrapping_add_signed(by as isize);
    if to < count {
        return Some(to);
    }
    // A number below 0 has wrapped round to the largest numbers.
    repeats.then(|| if by < 0 { to.wrapping_add(count) } else { to - count })
}

/// The rows of a set's threads, with lengths in units.
pub(super) fn rows(
    threads: &[CrossingThread],
    unit: f32,
    stiffest: f32,
    height: f32,
    held: bool,
) -> Result<Vec<Row>, CrossingsError> {
    let mut rows = room("threads", threads.len())?;
    let mut before = threads.last().map_or(unit, |thread| thread.pitch) / unit;
    for thread in threads {
        let gap = thread.pitch / unit;
        let [most, share] = SIDEWAYS;
        rows.push(Row {
            gap,
            radius: 0.5 * thread.diameter / unit,
            stiffness: thread.stiffness / stiffest,
            aspect: thread.flatness * (1.0 + (ASPECT - 1.0) / thread.firmness),
            shape: SHAPE * thread.firmness * thread.stiffness / stiffest,
            least_area: thread.least_area,
            freedom: if held { 0.0 } else { most.min(share * gap.min(before)) },
            height,
        });
        before = gap;
    }
    Ok(rows)
}
