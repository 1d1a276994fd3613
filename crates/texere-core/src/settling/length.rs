//! The lengths of yarns: held, given or free.

/// The lengths that settling aims for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Every interval keeps its length, so that no yarn is drawn through.
    Held,
    /// Every interval gets this multiple of its length, 0.5 to 2.
    Given(f32),
    /// Yarns take the length that their course needs, spread evenly along them. While bends are
    /// soft a tension draws them in, as a share of their length per pass.
    Free {
        /// Tension, 0 for none, 0.1 at most.
        tension: f32,
    },
}

/// The least length of an interval whose length is free, as a share of its length at the start.
pub const FREE_LEAST: f32 = 0.8;
/// The largest length of an interval whose length is free, as a share of its length at the start.
pub const FREE_MOST: f32 = 1.15;

/// The share that a free interval takes on, in a pass, of the difference between its length and the
/// mean of its own and its neighbours' lengths. Without this damping, equalising together with
/// momentum diverges.
pub const FREED: f32 = 0.05;

/// The length asked of an interval after a pass with free lengths. `arcs` are the lengths of the
/// interval before it, its own and the next one's.
#[must_use]
#[inline]
pub fn freed(length: f32, start: f32, arcs: [Option<f32>; 3], tension: f32) -> f32 {
    let (sum, count) =
        arcs.into_iter().flatten().fold((0.0, 0.0), |(sum, count), arc| (sum + arc, count + 1.0));
    let next = length + FREED * (sum / count - length) - tension * length;
    next.max(FREE_LEAST * start).min(FREE_MOST * start)
}
