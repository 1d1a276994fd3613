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

/// The places of a yarn, and how the yarn goes on beyond them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SettlingYarn {
    /// Number of the place of the yarn's first control point.
    pub first: u32,
    /// Number of the yarn's control points.
    pub points: u32,
    /// Whether the yarn ends, closes up or goes on in another repeat.
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

    /// The number of repeats, along x and y, from the yarn's first control point to the copy of it
    /// at which the yarn goes on after its last one. The number is 0 for a closed yarn, which goes
    /// on at the first point itself, and `None` for an open yarn.
    #[must_use]
    pub const fn shift(&self) -> Option<[i32; 2]> {
        match self.ends {
            Ends::Open => None,
            Ends::Closed => Some([0, 0]),
            Ends::Repeats(shift) => Some(shift),
        }
    }

    /// Number of the place at which interval number `interval` begins. The yarn's first interval is
    /// number 0. On a closed or repeating yarn the numbers go round: the first interval follows the
    /// last one, and the last one comes before the first. `None` if the yarn has no such interval.
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
