//! Errors of boundaries.

use thiserror::Error;

use crate::counted;

/// A boundary that does not fit its yarns. Yarns are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BoundaryError {
    /// A repeat that is negative, too long, or not a number.
    #[error("the repeat along {axis} is {length} mm, outside 0 to {limit} mm")]
    Repeat {
        /// `x` or `y`.
        axis: char,
        /// The repeat's length, mm.
        length: f32,
        /// The largest length that is allowed, mm.
        limit: f32,
    },
    /// The number of [`Ends`](crate::Ends) differs from the number of yarns.
    #[error("ends of {ends}, but there are {yarns}", ends = counted(*.ends, "yarn"))]
    EndsCount {
        /// Number of ends that were given.
        ends: usize,
        /// Number of yarns of the layout.
        yarns: usize,
    },
    /// A yarn is closed in the layout and not by its ends, or the other way round.
    #[error("yarn {yarn} is {}closed, unlike its ends", if *.closed { "" } else { "not " })]
    Closed {
        /// Number of the yarn.
        yarn: usize,
        /// Whether the yarn is closed in the layout.
        closed: bool,
    },
    /// A yarn goes on along an axis that has no period.
    #[error("yarn {yarn} goes on along {axis}, where there is no repeat")]
    NoRepeat {
        /// Number of the yarn.
        yarn: usize,
        /// `x` or `y`.
        axis: char,
    },
    /// A repeating yarn goes on by 0 repeats along both axes. A yarn that ends where it begins must
    /// be closed instead.
    #[error("yarn {yarn} goes on by no repeat")]
    NoWayOn {
        /// Number of the yarn.
        yarn: usize,
    },
}
