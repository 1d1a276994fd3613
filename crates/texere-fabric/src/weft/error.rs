//! Errors of knitting programs and of knits.

use texere_core::counted;
use thiserror::Error;

use super::program::Needle;

/// A knitting program or a knit that is refused. Carriers and operations are counted from 1. Warp
/// knits have loops, too, and give some of these errors.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WeftError {
    /// A knitting program with too many of something.
    #[error("{count} {what} in a knitting program; {limit} are taken at most")]
    KnitSize {
        /// What there are too many of.
        what: &'static str,
        /// The number of these things, up to the first operation beyond the limit.
        count: u64,
        /// The most that is allowed.
        limit: u64,
        /// The operation that goes beyond the limit, counted from 1. It is 0 if the whole program
        /// does.
        operation: u64,
    },
    /// A knit whose yarns run too far between its loops.
    #[error(
        "yarns pass {passed} needles and courses between {loops}, or on loops that are held; {limit} are taken at most", loops = counted(*.loops, "loop"))]
    KnitRuns {
        /// In a weft knit, the needles and courses from each stitch or float of a yarn to its next
        /// one, plus twice the courses from each loop to the loop that is drawn through it. In a
        /// warp knit, the needles that underlaps pass.
        passed: u64,
        /// Number of loops. In a warp knit, laps that only inlay yarn count, too.
        loops: u64,
        /// The most that is allowed for this number of loops.
        limit: u64,
        /// The [source](crate::weft::Operation::source) of the operation at which the longest way
        /// of a yarn between two loops ends; none for a warp knit.
        operation: Option<u32>,
    },
    /// A needle whose number is outside the allowed range.
    #[error("needle {needle}; needles {} to {limit} are taken", -i64::from(*.limit))]
    KnitNeedle {
        /// The needle.
        needle: Needle,
        /// The highest number of a needle that is allowed.
        limit: i32,
        /// The operation, counted from 1.
        operation: u64,
    },
    /// An operation with carriers that the program does not have.
    #[error("carriers that the program does not have")]
    KnitCarriers {
        /// The operation, counted from 1.
        operation: u64,
    },
    /// Distances of wales or courses, or a length of loops, that no cloth has.
    #[error("{what} of {mm} mm, outside {low} to {high} mm")]
    Gauge {
        /// `wales`, `courses` or `loops`.
        what: &'static str,
        /// Their distance or length, mm.
        mm: f64,
        /// The least distance or length allowed, mm.
        low: f64,
        /// The largest distance or length allowed, mm.
        high: f64,
    },
    /// A knit uses a carrier that has no yarn.
    #[error("no yarn for carrier {carrier}; there are {yarns}")]
    Carrier {
        /// The carrier, counted from 1.
        carrier: u32,
        /// The number of yarns.
        yarns: usize,
    },
    /// Stitches that can't be a cloth.
    #[error("stitches that no cloth has: {what}")]
    Stitches {
        /// What is wrong.
        what: &'static str,
    },
    /// Too many loops in copies of a repeat that settle together. Along each axis, the smallest
    /// number of copies settles together that divides the number of all copies and has at least 4
    /// wales or courses. If no number up to 16 is such a number, all copies settle together.
    #[error(
        "copies of a small repeat whose number has no suitable divisor up to 16 settle as one, of {loops}; {limit} are taken at most: take multiples of 4", loops = counted(*.loops, "loop"))]
    Copies {
        /// Loops, or laps of all bars, of the repeats that settle together.
        loops: u64,
        /// The most loops or laps allowed.
        limit: u64,
    },
    /// A knit with too many control points.
    #[error("a knit of {points} control points or more; {limit} are taken at most")]
    KnitPoints {
        /// About how many control points all yarns have.
        points: u64,
        /// The most control points allowed.
        limit: u64,
    },
    /// A knit whose repeat has too many control points. A repeat settles as one before it is
    /// copied.
    #[error("a repeat of {points} control points or more, before it is copied; {limit} are taken at most")]
    KnitRepeat {
        /// About how many control points the repeat has. A knit that does not repeat counts as a
        /// whole. In a warp knit, counting ends at the first lap beyond the limit.
        points: u64,
        /// The most control points allowed.
        limit: u64,
    },
}

impl WeftError {
    /// The number of the refused operation, counted from 1. A reader of a file finds the line with
    /// this number. None for errors without such a number. `WeftError::KnitRuns` gives none here,
    /// because it has the operation's source instead.
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
