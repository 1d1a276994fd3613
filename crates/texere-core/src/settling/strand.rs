//! A yarn's places, and what is known of each.

use crate::Ends;

/// Places that stand for those beyond a yarn's ends: one before it and two behind it.
pub(super) const BEYOND: [u64; 2] = [1, 2];

/// What is known of a place beside where it is.
pub mod tag {
    /// A control point; others stand beyond a yarn's ends.
    pub const POINT: u32 = 1;
    /// An interval begins here.
    pub const INTERVAL: u32 = 2;
    /// The first interval of an open yarn.
    pub const OPENS: u32 = 4;
    /// The last interval of an open yarn.
    pub const ENDS: u32 = 8;
    /// It stays where it is.
    pub const PINNED: u32 = 16;
}

/// Where a yarn's places lie, and how it goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SettlingYarn {
    /// Its first control point's place.
    pub first: u32,
    /// Its control points.
    pub points: u32,
    /// How it goes on.
    pub ends: Ends,
    /// Its length, in units of [`Spans::along`](super::Spans::along).
    pub length: u32,
}

impl SettlingYarn {
    /// How many intervals it has.
    #[must_use]
    pub const fn intervals(&self) -> u32 {
        self.ends.intervals(self.points as usize) as u32
    }

    /// How many repeats away it goes on.
    #[must_use]
    pub const fn shift(&self) -> Option<[i32; 2]> {
        match self.ends {
            Ends::Open => None,
            Ends::Closed => Some([0, 0]),
            Ends::Repeats(shift) => Some(shift),
        }
    }

    /// The place of interval `interval`, counted from its first one, which may be before or behind
    /// it; none where it has none.
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
