//! What can be wrong with a weave, its threads or its cloth.

use texere_core::{Origin, counted};
use thiserror::Error;

/// Names of weaves that a message suggests.
const TOLD: &str = "plain (tabby), twill, satin, sateen, matt (hopsack, basket), herringbone, pointed, honeycomb (waffle), crepe, or floats such as 2/2";

/// Woven cloth that is refused. Threads are counted from 1, as weavers count them.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WovenError {
    /// No threads in one direction, or more than are taken.
    #[error("cloth of {ends} and {picks}; each must be 1 to {limit}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Size {
        /// Ends asked for.
        ends: usize,
        /// Picks asked for.
        picks: usize,
        /// Most taken of either.
        limit: usize,
    },
    /// More crossings than a `u32` counts.
    #[error("{ends} and {picks} cross {crossings} times, more than {limit}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Crossings {
        /// Ends asked for.
        ends: usize,
        /// Picks asked for.
        picks: usize,
        /// Their product.
        crossings: u64,
        /// Most taken.
        limit: u64,
    },
    /// The cloth would have more control points than are taken.
    #[error("{ends} and {picks} need {points}, more than {limit}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"), points = counted(*.points, "control point"))]
    Points {
        /// Ends of the cloth.
        ends: usize,
        /// Picks of the cloth.
        picks: usize,
        /// Control points of all yarns.
        points: u64,
        /// Most taken.
        limit: u64,
    },
    /// A crossing outside the cloth.
    #[error("no crossing of end {end} and pick {pick}; the cloth has {ends} and {picks}", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    NoCrossing {
        /// The end, from 1.
        end: usize,
        /// The pick, from 1.
        pick: usize,
        /// Ends of the cloth.
        ends: usize,
        /// Picks of the cloth.
        picks: usize,
    },
    /// A tie-up too large to be worked out.
    #[error("{treadles} for {ends}; their product must be {limit} at most", treadles = counted(*.treadles, "treadle"), ends = counted(*.ends, "end"))]
    TieUp {
        /// Treadles in the tie-up.
        treadles: usize,
        /// Ends of the cloth.
        ends: usize,
        /// Most taken of their product.
        limit: u64,
    },
    /// A weave's notation that can't be read.
    #[error("weave \"{text}\", character {position}: expected {expected}")]
    Notation {
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
        position: usize,
        /// What should have stood there.
        expected: &'static str,
    },
    /// A word that is the name of no weave.
    #[error(
        "weave \"{text}\", character {position}: no weave has this name{}; there are {TOLD}",
        .near.map(|near| format!(" (did you mean {near}?)")).unwrap_or_default()
    )]
    NoWeave {
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
        position: usize,
        /// A name that is spelt nearly so.
        near: Option<&'static str>,
    },
    /// A sign in a weave's notation that looks like a hyphen and is none.
    #[error("weave \"{text}\", character {position}: this is {sign}, not a hyphen (-)")]
    Hyphen {
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
        position: usize,
        /// What it is: `an en dash (U+2013)`.
        sign: &'static str,
    },
    /// A sign in a weave's notation that looks like a slash and is none.
    #[error("weave \"{text}\", character {position}: this is {sign}, not a slash (/)")]
    Slash {
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
        position: usize,
        /// What it is: `a fraction slash (U+2044)`.
        sign: &'static str,
    },
    /// A satin's move that would show a twill line or leave ends without a binding point.
    #[error(
        "weave \"{text}\", character {position}: a satin of {ends} can't have move {step}; \
         it needs one from 2 to {} that shares no factor with {}", .ends.saturating_sub(2), .ends, ends = counted(*.ends, "end"))]
    SatinMove {
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
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
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
        position: usize,
        /// Ends asked for.
        ends: usize,
    },
    /// A twill's move with which an end would never change sides.
    #[error("weave \"{text}\", character {position}: with move {step} end {end} never changes sides")]
    TwillMove {
        /// The text, cut short where it is long.
        text: String,
        /// Number of the character, from 1.
        position: usize,
        /// The move.
        step: i64,
        /// The first such end of the repeat, from 1.
        end: usize,
    },
    /// A repeat larger than is taken.
    #[error("a repeat of {ends} and {picks}; each may be {limit} at most", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Repeat {
        /// Ends in the repeat.
        ends: usize,
        /// Picks in the repeat.
        picks: usize,
        /// Most taken of either.
        limit: usize,
    },
    /// Another number of threads than the drawdown has.
    #[error("{threads} described, but the drawdown has {planned}", threads = counted(*.threads, .set))]
    ThreadCount {
        /// `end` or `pick`.
        set: &'static str,
        /// Described.
        threads: usize,
        /// In the drawdown.
        planned: usize,
    },
    /// A spacing that is not a number, or outside its limits.
    #[error("spacing of {thread} is {spacing_mm} mm, outside {low} to {high} mm")]
    Spacing {
        /// The thread.
        thread: Origin,
        /// Its spacing, mm.
        spacing_mm: f64,
        /// Least taken, mm.
        low: f64,
        /// Most taken, mm.
        high: f64,
    },
    /// A stiffness outside its limits, or not a number.
    #[error("{thread} has a stiffness of {stiffness}, outside {low} to {high}")]
    Stiffness {
        /// The thread.
        thread: Origin,
        /// Its stiffness, in that of cotton.
        stiffness: f32,
        /// The least.
        low: f32,
        /// The most.
        high: f32,
    },
    /// A flatness outside its limits, or not a number.
    #[error("{thread} has a flatness of {flatness}, outside {low} to {high}")]
    Flatness {
        /// The thread.
        thread: Origin,
        /// Its flatness: width over height.
        flatness: f32,
        /// Least taken.
        low: f32,
        /// Most taken.
        high: f32,
    },
    /// A thread that flattening makes too thin or too wide.
    #[error("{thread} has half a {side} of {half_mm} mm once it is flattened, outside {low} to {high} mm")]
    Half {
        /// The thread.
        thread: Origin,
        /// `width` or `height`.
        side: &'static str,
        /// Half of it, mm.
        half_mm: f32,
        /// Least taken, mm.
        low: f32,
        /// Most taken, mm.
        high: f32,
    },
    /// A material that does not exist.
    #[error("material {material}, but there are {materials}, counted from 0")]
    NoMaterial {
        /// The material.
        material: usize,
        /// How many there are.
        materials: usize,
    },
    /// A share of the crimp outside its limits.
    #[error("the warp's share of the crimp is {share}, outside {low} to {high}")]
    Crimp {
        /// The share.
        share: f32,
        /// Least taken.
        low: f32,
        /// Most taken.
        high: f32,
    },
    /// Yarns that don't belong to the cloth that is measured.
    #[error("yarn {yarn} is not one of the cloth's")]
    OtherCloth {
        /// The first yarn that differs, from 0. Where there are too many or too few it is the
        /// number of yarns of the cloth.
        yarn: usize,
    },
    /// A cloth larger than coordinates reach.
    #[error("{set} lie over {extent_mm} mm, more than {limit} mm")]
    Extent {
        /// `ends` or `picks`.
        set: &'static str,
        /// Sum of their spacings, mm.
        extent_mm: f64,
        /// Most taken, mm.
        limit: f64,
    },
}

/// Textbooks' irregular satin on a number of ends that no regular one has.
const fn irregular_satin(ends: usize) -> &'static str {
    match ends {
        6 => "; an irregular one names the end that each pick binds: satin 6(1 3 5 2 6 4)",
        4 => "; an irregular one names the end that each pick binds: satin 4(1 2 4 3)",
        _ => "",
    }
}
