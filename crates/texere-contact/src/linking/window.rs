//! Windows: the stretches of yarn whose linking is compared.

use glam::DVec3;
use texere_core::Ends;

use super::passage::{WINDOW_INTERVALS, WINDOW_REACH};
use super::strand::Strand;

/// Number of chords of a window. With twice as many chords no change of the integral differs by
/// more than 0.01, and with half as many none differs by more than 0.02.
const CHORDS: usize = 2 * WINDOW_INTERVALS;

/// The corners of a window's chords.
pub(super) type Corners = [DVec3; CHORDS + 1];

/// A stretch of yarn, in intervals from its first control point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    from: f64,
    to: f64,
}

impl Window {
    /// The window round the middle of `interval`, `most` intervals long at most. `diameter` is the
    /// mean diameter of both yarns, mm.
    pub(super) fn around(strand: &Strand<'_>, interval: usize, diameter: f64, most: f64) -> Self {
        let (start, half) = (interval as i64, WINDOW_INTERVALS as i64 / 2);
        let count = strand.points.len();
        let (first, last) = match strand.ends {
            Ends::Open => (0, count as i64 - 1),
            Ends::Closed | Ends::Repeats(_) => (i64::MIN, i64::MAX),
        };
        let (low, high) = ((start - half).max(first), (start + half + 1).min(last));
        let interval_mm = strand.way(low, high) / (high - low) as f64;
        let middle = start as f64 + 0.5;
        // If many control points lie in one place, the window still reaches no further than once
        // round the yarn.
        let reach =
            (WINDOW_INTERVALS as f64 / 2.0).max((WINDOW_REACH * diameter / interval_mm).min(count as f64));
        let whole = if strand.ends == Ends::Closed { most.min(count as f64) } else { most };
        let reach = reach.min(whole / 2.0);
        Self { from: (middle - reach).max(first as f64), to: (middle + reach).min(last as f64) }
    }

    /// The corners of the window's chords in one of the yarn's shapes.
    pub(super) fn corners(&self, strand: &Strand<'_>) -> Corners {
        let step = (self.to - self.from) / CHORDS as f64;
        std::array::from_fn(|corner| strand.at(self.from + step * corner as f64))
    }
}
