//! The places of a yarn, and their tags.

use crate::Ends;

/// The number of places beyond a yarn's ends: one before it and two behind it.
pub(super) const BEYOND: [u64; 2] = [1, 2];

/// The tags of places.
pub mod tag {
    /// The place is that of a control point. Other places lie beyond a yarn's ends.
    pub const POINT: u32 = 1;
    /// An interval begins at the place.
    pub const INTERVAL: u32 = 2;
    /// The place's interval is the first of an open yarn.
    pub const OPENS: u32 = 4;
    /// The place's interval is the last of an open yarn.
    pub const ENDS: u32 = 8;
    /// The place does not move.
    pub const PINNED: u32 = 16;
}

/// The places of a yarn, and how it goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SettlingYarn {
    /// Number of the place of the yarn's first control point.
    pub first: u32,
    /// Number of the yarn's control points.
    pub points: u32,
    /// The yarn's ends, which say how it goes on.
    pub ends: Ends,
    /// The yarn's length, in units of [`Spans::along`](super::Spans::along).
    pub length: u32,
}

impl SettlingYarn {
    /// The number of the yarn's intervals.
    #[must_use]
    pub const fn intervals(&self) -> u32 {
        self.ends.intervals(self.points as usize) as u32
    }

    /// A yarn goes on at its first control point or at a copy of it. This is the number of repeats,
    /// along x and y, by which that copy is moved. It is 0 for a closed yarn, and `None` for an
    /// open one.
    #[must_use]
    pub const fn shift(&self) -> Option<[i32; 2]> {
        match self.ends {
            Ends::Open => None,
            Ends::Closed => Some([0, 0]),
            Ends::Repeats(shift) => Some(shift),
        }
    }

    /// Number of the place at which interval number `interval` begins, counted from the yarn's
    /// first interval. A closed or repeating yarn is counted on beyond its first and last interval.
    /// `None` if the yarn has no such interval.
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
