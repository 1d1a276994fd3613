//! What can be wrong with a boundary.

use thiserror::Error;

use crate::counted;

/// A boundary that is not one of these yarns. Yarns are counted from 0.
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
        /// The longest taken, mm.
        limit: f32,
    },
    /// Ends must be one per yarn.
    #[error("ends of {ends} where there are {yarns}", ends = counted(*.ends, "yarn"))]
    EndsCount {
        /// Given.
        ends: usize,
        /// Needed.
        yarns: usize,
    },
    /// A closed yarn must be closed here too, and no other.
    #[error("yarn {yarn} is {}closed, unlike its ends", if *.closed { "" } else { "not " })]
    Closed {
        /// The yarn.
        yarn: usize,
        /// Whether its layout says that it is closed.
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
    /// A yarn that repeats must go on by a repeat at least; one that ends where it began is closed.
    #[error("yarn {yarn} goes on by no repeat")]
    NoWayOn {
        /// The yarn.
        yarn: usize,
    },
}
