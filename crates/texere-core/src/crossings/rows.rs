//! Threads as tables, and the crossings that lie on them.

use super::{CrossingThread, CrossingsError, Set};
use crate::backend::room;

/// Threads of one level are neighbours up to so many threads apart.
const BESIDE_MAX: i32 = 16;

/// How far threads go sideways: a quarter of a unit, and two fifths of the way to a neighbour.
const SIDEWAYS: [f32; 2] = [0.25, 0.4];

/// A thread, in units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// To the next thread.
    pub gap: f32,
    /// Its radius.
    pub radius: f32,
    /// Its stiffness against bending, 1 for cotton.
    pub stiffness: f32,
    /// How far it may shift.
    pub freedom: f32,
    /// How far it may go up and down.
    pub height: f32,
    /// Its level.
    pub level: i32,
    /// How many threads before it, and after it, the next one of its level lies; 0 where there is
    /// none near enough to touch it.
    pub beside: [i32; 2],
}

/// A crossing by its end and its pick, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Site {
    /// The end.
    pub end: usize,
    /// The pick.
    pub pick: usize,
}

impl Site {
    /// The number of its thread of a set.
    #[must_use]
    pub const fn thread(self, set: Set) -> usize {
        match set {
            Set::Warp => self.end,
            Set::Weft => self.pick,
        }
    }
}

/// `at` and `by` further on among `count`; back at the first after the last one where they repeat.
pub(super) fn further(at: usize, by: i32, count: usize, repeats: bool) -> Option<usize> {
    let to = at.wrapping_add_signed(by as isize);
    if to < count {
        return Some(to);
    }
    // Before the first one it has wrapped round.
    repeats.then(|| if by < 0 { to.wrapping_add(count) } else { to - count })
}

/// A set's threads in units.
pub(super) fn rows(
    threads: &[CrossingThread],
    unit: f32,
    height: f32,
    repeat: bool,
) -> Result<Vec<Row>, CrossingsError> {
    let mut rows = room("threads", threads.len())?;
    let mut before = threads.last().map_or(unit, |thread| thread.pitch) / unit;
    for (number, thread) in threads.iter().enumerate() {
        let beside = |step: i32| {
            let is_level = |steps: &i32| {
                let other = further(number, step * steps, threads.len(), repeat);
                other.is_some_and(|other| threads[other].level == thread.level)
            };
            (1..=BESIDE_MAX.min(threads.len() as i32)).find(is_level).unwrap_or(0)
        };
        let gap = thread.pitch / unit;
        let [most, share] = SIDEWAYS;
        rows.push(Row {
            gap,
            radius: 0.5 * thread.diameter / unit,
            stiffness: thread.stiffness,
            freedom: most.min(share * gap.min(before)),
            height,
            level: thread.level as i32,
            beside: [beside(-1), beside(1)],
        });
        before = gap;
    }
    Ok(rows)
}
