//! Warnings about a cloth that can be made, but looks unintended.

use std::fmt;

use texere_core::Origin;

/// Something in a cloth that looks unintended. Each kind of warning about threads is given at most
/// once for the ends and once for the picks.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FabricWarning {
    /// Threads whose distance to the thread before them is less than half the sum of both widths.
    /// The two threads pierce one another side by side.
    Crowded {
        /// Number of threads that lack room.
        count: usize,
        /// The first thread that lacks room.
        first: Origin,
        /// The worst thread: the one that lacks the largest share of its room.
        worst: Origin,
        /// Half the sum of the widths of the worst thread and of the thread before it, mm.
        needed_mm: f64,
        /// The worst thread's distance to the thread before it, mm.
        spacing_mm: f64,
    },
    /// Threads that lie so close to the thread before them that crossing threads can't pass between
    /// the two. Warp and weft pierce one another. [`Woven::relieve`](crate::Woven::relieve) can
    /// help.
    Jammed {
        /// Number of threads that lack room.
        count: usize,
        /// The first thread that lacks room.
        first: Origin,
        /// The worst thread: the one that lacks the largest share of its room.
        worst: Origin,
        /// The least distance from the worst thread to the thread before it at which crossing
        /// threads pass, mm.
        needed_mm: f64,
        /// The worst thread's distance to the thread before it, mm.
        pitch_mm: f64,
    },
    /// A pressed knit that is thicker than the distance of the plates.
    PressMissed {
        /// The distance that was asked for, mm.
        asked_mm: f64,
        /// The cloth's thickness, mm.
        reached_mm: f64,
    },
}

/// The first of `count` threads, and the number of the others: `end 3`, or `end 3 and 41 more`.
fn and_more(first: Origin, count: usize) -> String {
    if count > 1 { format!("{first} and {} more", count - 1) } else { first.to_string() }
}

impl fmt::Display for FabricWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Crowded { count, first, worst, needed_mm, spacing_mm } => write!(
                f,
                "threads pierce their neighbours: {}; worst is {worst}, which needs {needed_mm:.4} mm and has \
                 {spacing_mm:.4} mm",
                and_more(*first, *count)
            ),
            Self::Jammed { count, first, worst, needed_mm, pitch_mm } => write!(
                f,
                "threads that cross pierce one another: {}; worst is {worst}, which needs a pitch of {needed_mm:.4} mm \
                 and has {pitch_mm:.4} mm",
                and_more(*first, *count)
            ),
            Self::PressMissed { asked_mm, reached_mm } => write!(
                f,
                "the press of {asked_mm:.3} mm is not reached: the cloth is {reached_mm:.3} mm thick at rest"
            ),
        }
    }
}
