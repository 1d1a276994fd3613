//! The lengths of yarns while they settle: held, given or free.

/// The lengths that settling aims for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Every interval keeps its length, so that no yarn slides along its own path.
    Held,
    /// Every interval gets this multiple of its length at the start, 0.5 to 2.
    Given(f32),
    /// Yarns get the length that their path needs, spread evenly along them. A tension shortens the
    /// yarns. It acts only on the way to rest, with the strength `Pass::ease`.
    Free {
        /// The share of its length by which an interval is shortened in a pass with an `ease` of 1.
        /// It is 0 for no tension, and 0.1 at most.
        tension: f32,
    },
}

/// The least length of an interval whose length is free, as a share of its length at the start.
/// With half the value, `a_whole_piece_settles_with_its_edges_held` is red; with twice,
/// `a_settled_repeat_fits_its_copies`.
pub const FREE_LEAST: f32 = 0.8;
/// The largest length of an interval whose length is free, as a share of its length at the start.
/// With half the value, `a_settled_repeat_fits_its_copies` is red; with twice, no test is.
pub const FREE_MOST: f32 = 1.15;

/// The share of a difference of lengths that a free interval makes up in a pass. The difference is
/// that between the length that the interval aims for and the mean of its own and its neighbours'
/// arc lengths. If a pass made up the whole difference, settling with momentum would diverge. With
/// half the value, and with twice, `a_settled_repeat_fits_its_copies` is red.
pub const FREED: f32 = 0.05;

/// The length that an interval aims for after a pass with free lengths. `length` is what it aimed
/// for in the pass, and `start` its length at the start. `arcs` are the arc lengths of the interval
/// before it, of the interval itself and of the one after it.
#[must_use]
#[inline]
pub fn freed(length: f32, start: f32, arcs: [Option<f32>; 3], tension: f32) -> f32 {
    let (sum, count) =
        arcs.into_iter().flatten().fold((0.0, 0.0), |(sum, count), arc| (sum + arc, count + 1.0));
    let next = length + FREED * (sum / count - length) - tension * length;
    next.max(FREE_LEAST * start).min(FREE_MOST * start)
}
