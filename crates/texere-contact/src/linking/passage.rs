//! What is reported of yarns that have passed through one another, and within which limits they are
//! looked for.

use texere_core::YarnPlace;

/// A change of the linking integral of two windows above which one yarn has passed through the
/// other.
pub const LINKING_CHANGE: f64 = 0.6;

/// Control intervals of a window, unless it needs more to reach [`WINDOW_REACH`] diameters each
/// way.
///
/// What was tried: of cloth with 4 control points an interlacing, and 8, 9 and 12 a loop, windows
/// of 5 to 11 see every passage; shorter ones see too little of it, and those of 13 miss stitches
/// of 9-point loops. Where loops have more than 24 control points it is the reach in diameters that
/// counts.
pub(super) const WINDOW_INTERVALS: usize = 8;

/// How far a window reaches each way from its middle at least, in diameters: the mean of those of
/// both yarns.
///
/// It counts where control points are dense. With 3 diameters dropped stitches of a loose knit
/// change the integral by 0.6 alone, with 5 by 0.85, whether a loop has 12 control points or 96.
pub(super) const WINDOW_REACH: f64 = 5.0;

/// The most control intervals beside one that are looked at in a cell of the search. Of cloth that
/// is some 20, and 300 where a radius has four control points.
pub(super) const LINKING_BESIDE: usize = 512;

/// The most windows that one is compared with in a cell. Of cloth that is a few where something has
/// passed, and 30 where the whole cloth has been turned over.
pub(super) const LINKING_COMPARED: usize = 128;

/// The most passages that are listed one by one.
pub(super) const PASSAGES_LISTED: usize = 100;

/// What has become of the way in which yarns are linked.
#[derive(Debug, Clone, PartialEq)]
pub struct Linking {
    /// The largest change of all that were worked out, without its sign; 0 where nothing can have
    /// passed through anything.
    pub largest: f64,
    /// Pairs of windows whose integral has changed by more than [`LINKING_CHANGE`]. One passage
    /// shows in several pairs beside one another.
    pub passages: u64,
    /// The worst of these, 100 at most, worst first.
    pub worst: Vec<Passage>,
    /// Pairs of windows whose integral was worked out.
    pub compared: u64,
    /// Pairs of control intervals that were left out: more than 512 lay beside one, or more than
    /// 128 could have passed through it. 0 but for yarns of which far too much lies in one place.
    pub left_out: u64,
}

/// Two windows of yarn that have passed through one another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The windows' middles, the lower yarn first, as they lie after. In a repeat the second is
    /// that of the copy which the first yarn meets.
    pub places: [YarnPlace; 2],
    /// By how much their linking integral has grown: near 1 or -1, depending on which way either
    /// runs.
    pub change: f64,
}
