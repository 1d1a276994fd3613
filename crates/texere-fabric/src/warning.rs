//! Warnings about a cloth that can be made all the same.

use std::fmt;

use texere_core::Origin;

/// Something that looks unintended. Each kind comes at most once for the ends and once for the
/// picks.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FabricWarning {
    /// Threads that lie closer to the thread before them than both are thick. Side by side they
    /// pierce one another.
    Crowded {
        /// Number of such threads.
        count: usize,
        /// The first of them.
        first: Origin,
        /// The one that lacks the largest share of its room.
        worst: Origin,
        /// Half the widths of the worst one and its neighbour together, mm.
        needed_mm: f64,
        /// The worst one's spacing, mm.
        spacing_mm: f64,
    },
    /// Threads too close to the thread before them for crossing threads to pass in between. Warp
    /// and weft pierce one another. [`Woven::relieve`](crate::Woven::relieve) can help.
    Jammed {
        /// Number of such threads.
        count: usize,
        /// The first of them.
        first: Origin,
        /// The one that lacks the largest share of its room.
        worst: Origin,
        /// The least distance to the thread before at which the worst one is clear, mm.
        needed_mm: f64,
        /// The worst one's distance to the thread before, mm.
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

/// `end 3`, or `end 3 and 41 more`.
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
