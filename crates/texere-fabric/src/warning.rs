//! What a designer should know about a cloth that can be built all the same.

use std::fmt;

use texere_core::Origin;

/// Something that looks unintended. There is at most one of a kind for the ends and one for the
/// picks.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FabricWarning {
    /// Threads that lie closer to the thread before them than both are thick: side by side they
    /// pierce one another.
    Crowded {
        /// How many do.
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
    /// Threads too close to the thread before them for those that cross to pass in between: warp
    /// and weft pierce one another. [`Woven::relieve`](crate::Woven::relieve) can help.
    Jammed {
        /// How many are.
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
    /// A knit that was pressed is thicker than the plates' distance.
    PressMissed {
        /// The distance that was asked for, mm.
        asked_mm: f64,
        /// How thick the cloth is, mm.
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
