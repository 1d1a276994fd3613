//! Errors of weaves, of threads and of woven cloth.

use texere_core::{Origin, counted};
use thiserror::Error;

/// The names of weaves that a message lists.
const TOLD: &str = "plain (tabby), twill, satin, sateen, matt (hopsack, basket), herringbone, pointed, honeycomb (waffle), crepe, or floats such as 2/2";

/// Woven cloth that is refused. Threads are counted from 1, as weavers count them.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WovenError {
    /// No threads in one direction, or more than are allowed.
    #[error("cloth of {ends} and {picks}; each must be 1 to {limit}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Size {
        /// Ends asked for.
        ends: usize,
        /// Picks asked for.
        picks: usize,
        /// The most ends, and the most picks, allowed.
        limit: usize,
    },
    /// More crossings than a `u32` counts.
    #[error("{ends} and {picks} cross {crossings} times, more than {limit}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Crossings {
        /// Ends asked for.
        ends: usize,
        /// Picks asked for.
        picks: usize,
        /// Number of crossings: ends times picks.
        crossings: u64,
        /// The most crossings allowed.
        limit: u64,
    },
    /// The cloth would have more control points than are allowed.
    #[error("{ends} and {picks} need {points}, more than {limit}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"), points = counted(*.points, "control point"))]
    Points {
        /// Ends of the cloth.
        ends: usize,
        /// Picks of the cloth.
        picks: usize,
        /// Control points of all yarns.
        points: u64,
        /// The most control points allowed.
        limit: u64,
    },
    /// A crossing outside the cloth.
    #[error("no crossing of end {end} and pick {pick}; the cloth has {ends} and {picks}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    NoCrossing {
        /// The end, counted from 1.
        end: usize,
        /// The pick, counted from 1.
        pick: usize,
        /// Ends of the cloth.
        ends: usize,
        /// Picks of the cloth.
        picks: usize,
    },
    /// A tie-up that is too large.
    #[error("{treadles} for {ends}; their product must be {limit} at most", treadles = counted(*.treadles, "treadle"), ends = counted(*.ends, "end"))]
    TieUp {
        /// Treadles in the tie-up.
        treadles: usize,
        /// Ends of the cloth.
        ends: usize,
        /// The largest product of treadles and ends allowed.
        limit: u64,
    },
    /// A weave's notation that can't be read.
    #[error("weave \"{text}\", character {position}: expected {expected}")]
    Notation {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// A description of what may stand at that character.
        expected: &'static str,
    },
    /// A word that is the name of no weave.
    #[error(
        "weave \"{text}\", character {position}: no weave has this name{}; there are {TOLD}",
        .near.map(|near| format!(" (did you mean {near}?)")).unwrap_or_default()
    )]
    NoWeave {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// A name with nearly the same spelling, if there is one.
        near: Option<&'static str>,
    },
    /// A character in a weave's notation that looks like a hyphen but is another character.
    #[error("weave \"{text}\", character {position}: this is {sign}, not a hyphen (-)")]
    Hyphen {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// The name of the character, such as `an en dash (U+2013)`.
        sign: &'static str,
    },
    /// A character in a weave's notation that looks like a slash but is another character.
    #[error("weave \"{text}\", character {position}: this is {sign}, not a slash (/)")]
    Slash {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// The name of the character, such as `a fraction slash (U+2044)`.
        sign: &'static str,
    },
    /// A satin's move that would show a twill line or leave ends without a binding point.
    #[error(
        "weave \"{text}\", character {position}: a satin of {ends} can't have move {step}; \
         it needs one from 2 to {} that shares no factor with {}", .ends.saturating_sub(2), .ends, ends = counted(*.ends, "end"))]
    SatinMove {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// The move.
        step: i64,
        /// Ends in the repeat.
        ends: usize,
    },
    /// No regular satin has this number of ends: fewer than 5, or 6.
    #[error(
        "weave \"{text}\", character {position}: no regular satin has {ends}, for that takes 5, or 7 and more{}",
        irregular_satin(*.ends), ends = counted(*.ends, "end"))]
    NoSatin {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// Ends asked for.
        ends: usize,
    },
    /// A twill's move with which an end would never change sides.
    #[error("weave \"{text}\", character {position}: with move {step} end {end} never changes sides")]
    TwillMove {
        /// The notation, cut short if it is long.
        text: String,
        /// Number of the character, counted from 1.
        position: usize,
        /// The move.
        step: i64,
        /// The first end of the repeat that never changes sides, counted from 1.
        end: usize,
    },
    /// A repeat with more ends or picks than are allowed.
    #[error("a repeat of {ends} and {picks}; each may be {limit} at most", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Repeat {
        /// Ends in the repeat.
        ends: usize,
        /// Picks in the repeat.
        picks: usize,
        /// The most ends, and the most picks, allowed.
        limit: usize,
    },
    /// Another number of threads than the drawdown has.
    #[error("{threads} described, but the drawdown has {planned}", threads = counted(*.threads, .set))]
    ThreadCount {
        /// `end` or `pick`.
        set: &'static str,
        /// The number of threads that are given.
        threads: usize,
        /// The number of threads in the drawdown.
        planned: usize,
    },
    /// A spacing that is not a number, or outside its limits.
    #[error("spacing of {thread} is {spacing_mm} mm, outside {low} to {high} mm")]
    Spacing {
        /// The thread.
        thread: Origin,
        /// The thread's spacing, mm.
        spacing_mm: f64,
        /// The least spacing allowed, mm.
        low: f64,
        /// The largest spacing allowed, mm.
        high: f64,
    },
    /// A stiffness outside its limits, or not a number.
    #[error("{thread} has a stiffness of {stiffness}, outside {low} to {high}")]
    Stiffness {
        /// The thread.
        thread: Origin,
        /// The thread's stiffness, as a multiple of that of cotton.
        stiffness: f32,
        /// The least stiffness allowed.
        low: f32,
        /// The largest stiffness allowed.
        high: f32,
    },
    /// A firmness outside its limits, or not a number.
    #[error("{thread} has a firmness of {firmness}, outside {low} to {high}")]
    Firmness {
        /// The thread.
        thread: Origin,
        /// The firmness of the thread's section, as a multiple of that of cotton.
        firmness: f32,
        /// The least firmness allowed.
        low: f32,
        /// The largest firmness allowed.
        high: f32,
    },
    /// A least area outside \[0, 1\], or not a number.
    #[error("{thread} has a least area of {least_area} of its section, outside 0 to 1")]
    LeastArea {
        /// The thread.
        thread: Origin,
        /// The least area of the thread's section, as a share of its area.
        least_area: f32,
    },
    /// A flatness outside its limits, or not a number.
    #[error("{thread} has a flatness of {flatness}, outside {low} to {high}")]
    Flatness {
        /// The thread.
        thread: Origin,
        /// The thread's flatness: width over height.
        flatness: f32,
        /// The least flatness allowed.
        low: f32,
        /// The largest flatness allowed.
        high: f32,
    },
    /// A thread that flattening makes too thin or too wide.
    #[error("{thread} has half a {side} of {half_mm} mm once it is flattened, outside {low} to {high} mm")]
    Half {
        /// The thread.
        thread: Origin,
        /// `width` or `height`.
        side: &'static str,
        /// Half the width or half the height, mm.
        half_mm: f32,
        /// The least half width or half height allowed, mm.
        low: f32,
        /// The largest half width or half height allowed, mm.
        high: f32,
    },
    /// A material that the cloth does not have.
    #[error("material {material}, but there are {materials}, counted from 0")]
    NoMaterial {
        /// The number of the material, counted from 0.
        material: usize,
        /// The number of materials.
        materials: usize,
    },
    /// A share of the crimp outside its limits.
    #[error("the warp's share of the crimp is {share}, outside {low} to {high}")]
    Crimp {
        /// The share.
        share: f32,
        /// The least share allowed.
        low: f32,
        /// The largest share allowed.
        high: f32,
    },
    /// Yarns that don't belong to the cloth that is measured.
    #[error("yarn {yarn} is not one of the cloth's")]
    OtherCloth {
        /// The number of the first yarn that differs, counted from 0. If there are only too many or
        /// too few yarns, it is the smaller of both numbers of yarns.
        yarn: usize,
    },
    /// A cloth that is larger than coordinates can be.
    #[error("{set} lie over {extent_mm} mm, more than {limit} mm")]
    Extent {
        /// `ends` or `picks`.
        set: &'static str,
        /// Sum of the spacings of these threads, mm.
        extent_mm: f64,
        /// The largest sum allowed, mm.
        limit: f64,
    },
}

/// The part of a message that names the textbooks' irregular satin on `ends` ends. It is empty for
/// numbers of ends without such a satin.
const fn irregular_satin(ends: usize) -> &'static str {
    match ends {
        6 => "; an irregular one names the end that each pick binds: satin 6(1 3 5 2 6 4)",
        4 => "; an irregular one names the end that each pick binds: satin 4(1 2 4 3)",
        _ => "",
    }
}
