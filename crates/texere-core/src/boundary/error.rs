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
        /// Its length, mm.
        length: f32,
        /// The largest accepted, mm.
        limit: f32,
    },
    /// There must be one `Ends` per yarn.
    #[error("ends of {ends} where there are {yarns}", ends = counted(*.ends, "yarn"))]
    EndsCount {
        /// Given.
        ends: usize,
        /// Needed.
        yarns: usize,
    },
    /// The layout and the ends must agree on whether a yarn is closed.
    #[error("yarn {yarn} is {}closed, unlike its ends", if *.closed { "" } else { "not " })]
    Closed {
        /// The yarn.
        yarn: usize,
        /// Whether the layout has it closed.
        closed: bool,
    },
    /// A yarn goes on along an axis that has no period.
    #[error("yarn {yarn} goes on along {axis}, where there is no repeat")]
    NoRepeat {
        /// The yarn.
        yarn: usize,
        /// `x` or `y`.
        axis: char,
    },
    /// A repeating yarn must go on by at least one repeat. A yarn that ends where it began is
    /// closed.
    #[error("yarn {yarn} goes on by no repeat")]
    NoWayOn {
        /// The yarn.
        yarn: usize,
    },
}
