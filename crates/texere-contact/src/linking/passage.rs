//! Passages of yarns through one another, and the limits within which they are looked for.

use texere_core::YarnPlace;

/// The least change of the linking integral of two windows that counts as a passage. With twice the
/// value, `the_smallest_repeat_of_a_weave_is_compared` is red; with half, no test is.
pub const LINKING_CHANGE: f64 = 0.6;

/// Control intervals of a window, if they reach [`WINDOW_REACH`] diameters each way.
///
/// Tried on cloth with 4 control points an interlacing, and 8, 9 and 12 a loop: windows of 5 to 11
/// intervals show every passage. In shorter windows the change is too small, and windows of 13 miss
/// stitches of 9-point loops. If loops have more than 24 control points, the reach in diameters
/// decides. With half the value, `rings_that_come_apart_are_told` is red; with twice,
/// `the_smallest_repeat_of_a_weave_is_compared`.
pub(super) const WINDOW_INTERVALS: usize = 8;

/// The least reach of a window each way from its middle, in diameters: the mean diameter of both
/// yarns.
///
/// The reach counts if control points are dense. With 3 diameters, dropped stitches of a loose knit
/// change the integral by only 0.6, and with 5 diameters by 0.85, whether a loop has 12 control
/// points or 96. With half the value, and with twice, `a_dropped_stitch_is_told` is red.
pub(super) const WINDOW_REACH: f64 = 5.0;

/// The most control intervals that are tested against one interval in a cell of the search. Cloth
/// has some 20, and 300 if four control points lie on a length of one radius.
pub(super) const LINKING_BESIDE: usize = 512;

/// The most windows that one window is compared with in a cell. Cloth has a few where something has
/// passed, and 30 if the whole cloth has been turned over.
pub(super) const LINKING_COMPARED: usize = 128;

/// The most passages that are listed one by one.
pub(super) const PASSAGES_LISTED: usize = 100;

/// How the linking of yarns has changed.
#[derive(Debug, Clone, PartialEq)]
pub struct Linking {
    /// The largest change of a linking integral, without its sign. It is 0 if nothing can have
    /// passed through anything.
    pub largest: f64,
    /// Number of pairs of windows whose integral has changed by more than [`LINKING_CHANGE`]. One
    /// passage shows in several neighbouring pairs.
    pub passages: u64,
    /// The worst passages, 100 at most, worst first.
    pub worst: Vec<Passage>,
    /// Number of pairs of windows whose integral was computed.
    pub compared: u64,
    /// Number of pairs of control intervals that were left out because more than 512 intervals lay
    /// beside one interval, or more than 128 could have passed through it. It is 0 unless far too
    /// much yarn lies in one place.
    pub left_out: u64,
}

/// Two windows of yarn that have passed through one another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The windows' middles after the move, the lower yarn first. In a repeat the second place is
    /// on the copy that the first yarn meets.
    pub places: [YarnPlace; 2],
    /// Change of the windows' linking integral: near 1 or -1, depending on the directions of both
    /// yarns.
    pub change: f64,
}
