//! What can be wrong with a knitting program, or with a knit of its stitches.

use texere_core::counted;
use thiserror::Error;

use super::program::Needle;

/// A knit that can't be taken. Carriers and operations are counted from 1. Warp knits have loops,
/// too: what is wrong with these is said here.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WeftError {
    /// A knitting program that is too large in some way.
    #[error("{count} {what} in a knitting program; {limit} are taken at most")]
    KnitSize {
        /// Of what.
        what: &'static str,
        /// How many.
        count: u64,
        /// Most taken.
        limit: u64,
        /// The operation where that is so, from 1; 0 where it is so of the whole program.
        operation: u64,
    },
    /// A knit whose yarns run on, between its loops, further than any cloth's.
    #[error(
        "yarns pass {passed} needles and courses between {loops}, or on loops that are held; {limit} are taken at most", loops = counted(*.loops, "loop"))]
    KnitRuns {
        /// Needles that yarns float past, and courses that they rise or that loops are held.
        passed: u64,
        /// Loops.
        loops: u64,
        /// Most taken for so many loops.
        limit: u64,
        /// The [source](crate::weft::Operation::source) of the operation after the longest way of a
        /// yarn between two loops; none of a warp knit.
        told: Option<u32>,
    },
    /// A needle further out than any machine's, or outside what the machine's beds are racked to.
    #[error("needle {needle}; needles {} to {limit} are taken", -i64::from(*.limit))]
    KnitNeedle {
        /// The needle.
        needle: Needle,
        /// The furthest taken.
        limit: i32,
        /// The operation, from 1.
        operation: u64,
    },
    /// An operation with carriers that the program does not have.
    #[error("carriers that the program does not have")]
    KnitCarriers {
        /// The operation, from 1.
        operation: u64,
    },
    /// Wales, courses or loops of a knit that no cloth has.
    #[error("{what} of {mm} mm, outside {low} to {high} mm")]
    Gauge {
        /// `wales`, `courses` or `loops`.
        what: &'static str,
        /// Their distance or length, mm.
        mm: f64,
        /// Least taken, mm.
        low: f64,
        /// Most taken, mm.
        high: f64,
    },
    /// A carrier of a knit that has no yarn.
    #[error("no yarn for carrier {carrier}; there are {yarns}")]
    Carrier {
        /// The carrier, from 1.
        carrier: u32,
        /// How many yarns there are.
        yarns: usize,
    },
    /// Stitches that are not those of any cloth.
    #[error("stitches that no cloth has: {what}")]
    Stitches {
        /// What is wrong.
        what: &'static str,
    },
    /// Copies of a small repeat of a knit that have to settle together, for their number has no
    /// divisor up to 16.
    #[error(
        "copies of a small repeat whose number has no divisor up to 16 settle as one, of {loops}; {limit} are taken at most: take multiples of 4", loops = counted(*.loops, "loop"))]
    Copies {
        /// Loops, or laps of all bars, of the repeats that settle together.
        loops: u64,
        /// Most taken.
        limit: u64,
    },
    /// A knit of more control points than are taken.
    #[error("a knit of {points} control points or more; {limit} are taken at most")]
    KnitPoints {
        /// Control points of all yarns, at least.
        points: u64,
        /// Most taken.
        limit: u64,
    },
    /// A knit whose repeat, which settles as one before it is copied, has more control points than
    /// are taken.
    #[error("a repeat of {points} control points or more, before it is copied; {limit} are taken at most")]
    KnitRepeat {
        /// Control points of the repeat, about; of a knit without one, those of all of it.
        points: u64,
        /// Most taken.
        limit: u64,
    },
}

impl WeftError {
    /// The operation of a knitting program that is refused, counted from 1: readers say where it
    /// stands. None of other errors.
    ///
    /// ```
    /// use texere_fabric::weft::WeftError;
    /// assert_eq!(WeftError::KnitCarriers { operation: 3 }.operation(), Some(3));
    /// assert_eq!(WeftError::Stitches { what: "no loops" }.operation(), None);
    /// ```
    #[must_use]
    pub const fn operation(&self) -> Option<u64> {
        match self {
            Self::KnitSize { operation: 0, .. } => None,
            Self::KnitSize { operation, .. }
            | Self::KnitNeedle { operation, .. }
            | Self::KnitCarriers { operation } => Some(*operation),
            _ => None,
        }
    }
}
