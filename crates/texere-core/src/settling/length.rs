//! What settling does to the length of yarns.

/// What settling does to the length of yarns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Every interval keeps the length that it has, so that no yarn is drawn through.
    Held,
    /// Every interval is to have so many times the length that it has, 0.5 to 2.
    Given(f32),
    /// Yarns take the length that their course needs, evenly all along, and are drawn in by a
    /// tension, in shares of their length a pass, while bends are still soft.
    Free {
        /// Tension, 0 for none, 0.1 at most.
        tension: f32,
    },
}

/// Where lengths are free, an interval may become so many times as long as it was: the least.
pub const FREE_LEAST: f32 = 0.8;
/// And that is the most.
pub const FREE_MOST: f32 = 1.15;

/// The share of what it differs from the mean beside it that its length takes on in a pass.
pub const FREED: f32 = 0.05;

/// The length that an interval is to have after a pass in which lengths are free: `arcs` are those
/// of the interval before it, its own and the next one's.
#[must_use]
#[inline]
pub fn freed(length: f32, start: f32, arcs: [Option<f32>; 3], tension: f32) -> f32 {
    let (sum, count) =
        arcs.into_iter().flatten().fold((0.0, 0.0), |(sum, count), arc| (sum + arc, count + 1.0));
    let next = length + FREED * (sum / count - length) - tension * length;
    next.max(FREE_LEAST * start).min(FREE_MOST * start)
}
