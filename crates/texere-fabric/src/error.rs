//! What can go wrong between a design and its yarns.

use texere_contact::ContactError;
use texere_core::{BoundaryError, Origin, OutOfMemory, SectionError, YarnError, counted};
use thiserror::Error;

use crate::warp::Lap;
use crate::weft::Needle;
use crate::woven::{TOLD, irregular_satin};

/// A structure that can't be taken. Threads are counted from 1, as weavers do.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FabricError {
    /// No threads at all in one direction, or more than are taken.
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
    /// A knitting program that is too large in some way.
    #[error("{count} {what} in a knitting program; {limit} are taken at most")]
    KnitSize {
        /// Of what.
        what: &'static str,
        /// How many.
        count: u64,
        /// Most taken.
        limit: u64,
        /// The operation where that is so, from 1; 0 where it is so of the whole program.
        operation: u64,
    },
    /// A knit whose yarns run on, between its loops, further than any cloth's.
    #[error(
        "yarns pass {passed} needles and courses between {loops}, or on loops that are held; {limit} are taken at most", loops = counted(*.loops, "loop"))]
    KnitRuns {
        /// Needles that yarns float past, and courses that they rise or that loops are held.
        passed: u64,
        /// Loops.
        loops: u64,
        /// Most taken for so many loops.
        limit: u64,
        /// The [source](crate::weft::Operation::source) of the operation after the longest way of a yarn between two loops; none of a warp knit.
        told: Option<u32>,
    },
    /// A needle further out than any machine's, or outside what the machine's beds are racked to.
    #[error("needle {needle}; needles {} to {limit} are taken", -i64::from(*.limit))]
    KnitNeedle {
        /// The needle.
        needle: Needle,
        /// The furthest taken.
        limit: i32,
        /// The operation, from 1.
        operation: u64,
    },
    /// An operation with carriers that the program does not have.
    #[error("carriers that the program does not have")]
    KnitCarriers {
        /// The operation, from 1.
        operation: u64,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
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
        /// Which character, from 1.
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
        /// Which character, from 1.
        position: usize,
        /// A name that is spelt nearly so.
        near: Option<&'static str>,
    },
    /// A sign in a weave's notation that looks like a hyphen and is none.
    #[error("weave \"{text}\", character {position}: this is {sign}, not a hyphen (-)")]
    Hyphen {
        /// The text, cut short where it is long.
        text: String,
        /// Which character, from 1.
        position: usize,
        /// What it is: `an en dash (U+2013)`.
        sign: &'static str,
    },
    /// A sign in a weave's notation that looks like a slash and is none.
    #[error("weave \"{text}\", character {position}: this is {sign}, not a slash (/)")]
    Slash {
        /// The text, cut short where it is long.
        text: String,
        /// Which character, from 1.
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
        /// Which character, from 1.
        position: usize,
        /// The move.
        step: i64,
        /// Ends in the repeat.
        ends: usize,
    },
    /// There is no regular satin on so many ends: none on fewer than 5, and none on 6.
    #[error(
        "weave \"{text}\", character {position}: no regular satin has {ends}, for that takes 5, or 7 and more{}",
        irregular_satin(*.ends), ends = counted(*.ends, "end"))]
    NoSatin {
        /// The text, cut short where it is long.
        text: String,
        /// Which character, from 1.
        position: usize,
        /// Ends asked for.
        ends: usize,
    },
    /// A twill's move with which an end would never change sides.
    #[error("weave \"{text}\", character {position}: with move {step} end {end} never changes sides")]
    TwillMove {
        /// The text, cut short where it is long.
        text: String,
        /// Which character, from 1.
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
    /// As many threads must be described as the drawdown has.
    #[error("{threads} described, but the drawdown has {planned}", threads = counted(*.threads, .set))]
    ThreadCount {
        /// `end` or `pick`.
        set: &'static str,
        /// Described.
        threads: usize,
        /// In the drawdown.
        planned: usize,
    },
    /// A spacing that is not a number, not positive, or no cloth's.
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
    /// A radius that is not a number, not positive, or no yarn's.
    #[error("radius of {thread} is {radius_mm} mm, outside {low} to {high} mm")]
    Radius {
        /// The thread.
        thread: Origin,
        /// Its radius, mm.
        radius_mm: f32,
        /// Thinnest taken, mm.
        low: f32,
        /// Thickest taken, mm.
        high: f32,
    },
    /// A stiffness outside its limits, or not a number.
    #[error("{thread} has a stiffness of {stiffness}, outside {low} to {high}")]
    Stiffness {
        /// Which end or pick.
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
        /// Which thread.
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
        /// Which thread.
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
    /// A twist that is not finite or too steep.
    #[error("twist of {thread} is {twist} rad/mm, beyond ±{limit}")]
    Twist {
        /// The thread.
        thread: Origin,
        /// Its twist, rad/mm.
        twist: f32,
        /// The steepest taken, rad/mm.
        limit: f32,
    },
    /// A thread refers to a material that is missing.
    #[error("{thread} is of material {material}, but there are {materials}")]
    UnknownMaterial {
        /// The thread.
        thread: Origin,
        /// Its material, from 0.
        material: u32,
        /// How many there are.
        materials: usize,
    },
    /// A material that there is not.
    #[error("material {material}, but there are {materials}, counted from 0")]
    NoMaterial {
        /// The material.
        material: usize,
        /// How many there are.
        materials: usize,
    },
    /// A thread refers to a section that is missing.
    #[error("{thread} has section {section}, but there are {sections}")]
    UnknownSection {
        /// The thread.
        thread: Origin,
        /// Its section, from 0.
        section: u32,
        /// How many there are.
        sections: usize,
    },
    /// A section whose numbers are not sound.
    #[error("section {section} is not sound")]
    Section {
        /// Which one, from 0.
        section: usize,
        /// Why.
        source: SectionError,
    },
    /// A share of the crimp that neither set can have.
    #[error("the warp's share of the crimp is {share}, outside {low} to {high}")]
    Crimp {
        /// The share.
        share: f32,
        /// Least taken.
        low: f32,
        /// Most taken.
        high: f32,
    },
    /// What was made of the structure could not be measured.
    #[error(transparent)]
    Contact(ContactError),
    /// A boundary that is not that of the yarns.
    #[error("the boundary is not that of the yarns")]
    Boundary(#[from] BoundaryError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// Yarns that are not those that a repeat is laid with.
    #[error("yarns of {points}; the repeat's have {planned}", points = counted(*.points, "control point"))]
    OtherYarns {
        /// Control points of the yarns.
        points: u64,
        /// Control points of the repeat's.
        planned: u64,
    },
    /// Yarns that are not those of the cloth that is measured.
    #[error("yarn {yarn} is not one of the cloth's")]
    OtherCloth {
        /// The first yarn that differs, from 0; the number of the cloth's where there are more or fewer.
        yarn: usize,
    },
    /// A cloth further across than coordinates reach.
    #[error("{set} lie over {extent_mm} mm, more than {limit} mm")]
    Extent {
        /// `ends` or `picks`.
        set: &'static str,
        /// Sum of their spacings, mm.
        extent_mm: f64,
        /// Most taken, mm.
        limit: f64,
    },
    /// Wales, courses or loops of a knit that no cloth has.
    #[error("{what} of {mm} mm, outside {low} to {high} mm")]
    Gauge {
        /// `wales`, `courses` or `loops`.
        what: &'static str,
        /// Their distance or length, mm.
        mm: f64,
        /// Least taken, mm.
        low: f64,
        /// Most taken, mm.
        high: f64,
    },
    /// A carrier of a knit that has no yarn.
    #[error("no yarn for carrier {carrier}; there are {yarns}")]
    Carrier {
        /// The carrier, from 1.
        carrier: u32,
        /// How many yarns there are.
        yarns: usize,
    },
    /// Stitches that are not those of any cloth.
    #[error("stitches that no cloth has: {what}")]
    Stitches {
        /// What is wrong.
        what: &'static str,
    },
    /// Copies of a small repeat of a knit that have to settle together, for their number has no divisor up to 16.
    #[error(
        "copies of a small repeat whose number has no divisor up to 16 settle as one, of {loops}; {limit} are taken at most: take multiples of 4", loops = counted(*.loops, "loop"))]
    Copies {
        /// Loops, or laps of all bars, of the repeats that settle together.
        loops: u64,
        /// Most taken.
        limit: u64,
    },
    /// A knit of more control points than are taken.
    #[error("a knit of {points} control points or more; {limit} are taken at most")]
    KnitPoints {
        /// Control points of all yarns, at least.
        points: u64,
        /// Most taken.
        limit: u64,
    },
    /// A knit whose repeat, which settles as one before it is copied, has more control points than are taken.
    #[error("a repeat of {points} control points or more, before it is copied; {limit} are taken at most")]
    KnitRepeat {
        /// Control points of the repeat, about; of a knit without one, those of all of it.
        points: u64,
        /// Most taken.
        limit: u64,
    },
    /// A warp knit of more laps, before it is copied, than are taken.
    #[error("wales, courses and guide bars make {laps}; {limit} are taken at most", laps = counted(*.laps, "lap"))]
    Laps {
        /// Wales times courses times bars.
        laps: u64,
        /// Most taken.
        limit: u64,
    },
    /// Guide bars of a warp knit: none, or more than are taken.
    #[error("{bars}; a warp knit has 1 to {limit}", bars = counted(*.bars, "guide bar"))]
    Bars {
        /// How many.
        bars: usize,
        /// Most taken.
        limit: usize,
    },
    /// A guide that holds a yarn which there is not.
    #[error("a guide of guide bar {bar} holds yarn {yarn}, but there are {yarns}")]
    GuideYarn {
        /// The bar, from 1.
        bar: usize,
        /// The yarn, from 1.
        yarn: u64,
        /// How many there are.
        yarns: usize,
    },
    /// A bar that stands further from the others than any does.
    #[error("guide bar {bar} is offset by {offset}, beyond \u{b1}{limit}", offset = counted(*.offset, "needle"))]
    BarOffset {
        /// The bar, from 1.
        bar: usize,
        /// Its offset, needles.
        offset: i32,
        /// Most taken, either way.
        limit: i32,
    },
    /// A run-in that no bar has.
    #[error("guide bar {bar} has a run-in of {mm} mm, outside {low} to {high} mm a rack of 480 courses")]
    RunIn {
        /// The bar, from 1.
        bar: usize,
        /// Its run-in, mm.
        mm: f64,
        /// Least taken, mm.
        low: f64,
        /// Most taken, mm.
        high: f64,
    },
    /// A Jacquard whose colours are not for as many courses as its bar's chain has.
    #[error("the Jacquard's colours have {courses}, but the chain of guide bar {bar} has {chain}", courses = counted(*.courses, "course"))]
    JacquardCourses {
        /// The bar, from 1.
        bar: usize,
        /// Courses of each colour.
        courses: usize,
        /// Courses of the chain.
        chain: usize,
    },
    /// A colour of a Jacquard that makes a lap go round more needles than any does.
    #[error(
        "a colour of guide bar {bar}'s Jacquard makes its lap {lap} at course {course}: {} needles; a lap goes round {limit} at most",
        .lap.overlap().unsigned_abs()
    )]
    JacquardLap {
        /// The bar, from 1.
        bar: usize,
        /// The course of its chain, from 1.
        course: usize,
        /// The lap, displaced.
        lap: Lap,
        /// Most needles taken.
        limit: i32,
    },
    /// Wales or courses of a warp knit that its bars don't repeat in.
    #[error("{size}, but bars begin again after {multiple}: take a multiple of that", size = counted(*.size, .what))]
    WarpRepeat {
        /// `wale` or `course`.
        what: &'static str,
        /// How many.
        size: u32,
        /// What it must be a multiple of.
        multiple: u64,
    },
    /// Bars whose guides make no loop.
    #[error("no guide makes a loop")]
    NoLoops,
    /// The yarns can't be taken.
    #[error("the cloth's yarns are not sound")]
    Yarns(#[from] YarnError),
}

impl FabricError {
    /// The operation of a knitting program that is refused, counted from 1: readers say where it stands. None of other errors.
    ///
    /// ```
    /// use texere_fabric::FabricError;
    /// assert_eq!(FabricError::KnitCarriers { operation: 3 }.operation(), Some(3));
    /// assert_eq!(FabricError::Cancelled.operation(), None);
    /// ```
    #[must_use]
    pub const fn operation(&self) -> Option<u64> {
        match self {
            Self::KnitSize { operation: 0, .. } => None,
            Self::KnitSize { operation, .. }
            | Self::KnitNeedle { operation, .. }
            | Self::KnitCarriers { operation } => Some(*operation),
            _ => None,
        }
    }
}

impl From<ContactError> for FabricError {
    /// Short memory and a request to stop keep their names, whatever met them.
    fn from(error: ContactError) -> Self {
        match error {
            ContactError::OutOfMemory(error) => Self::OutOfMemory(error),
            ContactError::Cancelled => Self::Cancelled,
            error => Self::Contact(error),
        }
    }
}
