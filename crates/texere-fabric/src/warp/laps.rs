//! The laps of a cloth: which guide laps which needle at which course.

use super::chain::is_open;
use super::{Bar, Lap, LapKind};

/// A lap in its place in the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PlacedLap {
    /// The guide bar, counted from 0 at the front.
    pub bar: u32,
    /// The guide within its bar, counted from 0.
    pub guide: u32,
    /// The course, counted from 0.
    pub course: u32,
    /// The yarn: an index into the cloth's yarns.
    pub yarn: u32,
    /// The lap, in spaces of the cloth. Space 0 lies before needle 0. Guides near an edge may lap
    /// beyond it.
    pub lap: Lap,
    /// The underlap after the lap: the number of needles behind which the guide passes on the way
    /// to its next lap, positive towards higher numbers.
    pub underlap: i32,
}

impl PlacedLap {
    /// The kind of the lap.
    #[must_use]
    pub const fn kind(&self) -> LapKind {
        self.lap.kind()
    }

    /// Whether the lap is open: see [`Chain::is_open`](super::Chain::is_open).
    #[must_use]
    pub const fn is_open(&self) -> bool {
        is_open(self.lap, self.underlap)
    }
}

/// The laps of `wales` guides of each bar, at `courses` courses.
pub(super) fn laps(bars: &[Bar], wales: u32, courses: u32) -> impl Iterator<Item = PlacedLap> + '_ {
    (0..).zip(bars).flat_map(move |(number, bar)| {
        (0..wales).filter_map(move |guide| Some((guide, bar.threading.yarn(guide)?))).flat_map(
            move |(guide, yarn)| {
                (0..courses).map(move |course| {
                    let lap = bar.lap(guide, course);
                    let next = bar.lap(guide, (course + 1) % courses);
                    PlacedLap { bar: number, guide, course, yarn, lap, underlap: next.from - lap.to }
                })
            },
        )
    })
}
