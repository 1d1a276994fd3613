//! The places of a yarn, and their tags.

use crate::Ends;

/// The number of places beyond a yarn's ends: one before it and two behind it.
pub(super) const BEYOND: [u64; 2] = [1, 2];

/// The tags of places.
pub mod tag {
    /// A control point's place. Other places lie beyond a yarn's ends.
    pub const POINT: u32 = 1;
    /// An interval begins here.
    pub const INTERVAL: u32 = 2;
    /// The first interval of an open yarn.
    pub const OPENS: u32 = 4;
    /// The last interval of an open yarn.
    pub const ENDS: u32 = 8;
    /// The place stays fixed.
    pub const PINNED: u32 = 16;
}

/// The places of a yarn, and how it goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SettlingYarn {
    /// Its first control point's place.
    pub first: u32,
    /// Its control points.
    pub points: u32,
    /// The ends: how the yarn goes on.
    pub ends: Ends,
    /// Its length, in units of [`Spans::along`](super::Spans::along).
    pub length: u32,
}

impl SettlingYarn {
    /// The number of intervals.
    #[must_use]
    pub const fn intervals(&self) -> u32 {
        self.ends.intervals(self.points as usize) as u32
    }

    /// The distance, in repeats, at which the yarn goes on. `None` if it is open.
    #[must_use]
    pub const fn shift(&self) -> Option<[i32; 2]> {
        match self.ends {
            Ends::Open => None,
            Ends::Closed => Some([0, 0]),
            Ends::Repeats(shift) => Some(shift),
        }
    }

    /// The place of interval number `interval`, counted from the first one. The number may lie
    /// before the first or after the last. `None` if the yarn has no such interval.
    #[must_use]
    pub fn interval(&self, interval: i64) -> Option<usize> {
        let count = i64::from(self.intervals());
        let own = match self.ends {
            Ends::Open => Some(interval).filter(|interval| (0..count).contains(interval)),
            Ends::Closed | Ends::Repeats(_) => Some(interval.rem_euclid(count)),
        };
        own.map(|own| self.first as usize + own as usize)
    }
}
