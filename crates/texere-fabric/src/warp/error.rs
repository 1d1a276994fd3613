//! Errors of warp knits.

use texere_core::counted;
use thiserror::Error;

use super::chain::Lap;

/// A warp knit that is refused. Guide bars are counted from 1 at the front. Guides and courses are
/// counted from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WarpError {
    /// Too many laps before the cloth is copied.
    #[error("wales, courses and guide bars make {laps}; {limit} are taken at most", laps = counted(*.laps, "lap"))]
    Laps {
        /// Wales times courses times bars.
        laps: u64,
        /// The most laps allowed.
        limit: u64,
    },
    /// No guide bars, or too many.
    #[error("{bars}; a warp knit has 1 to {limit}", bars = counted(*.bars, "guide bar"))]
    Bars {
        /// The number of guide bars.
        bars: usize,
        /// The most guide bars allowed.
        limit: usize,
    },
    /// A guide whose yarn does not exist.
    #[error("a guide of guide bar {bar} holds yarn {yarn}, but there are {yarns}")]
    GuideYarn {
        /// The bar, counted from 1 at the front.
        bar: usize,
        /// The yarn, counted from 1.
        yarn: u64,
        /// The number of yarns.
        yarns: usize,
    },
    /// A bar with too large an offset.
    #[error("guide bar {bar} is offset by {offset}, beyond \u{b1}{limit}", offset = counted(*.offset, "needle"))]
    BarOffset {
        /// The bar, counted from 1 at the front.
        bar: usize,
        /// Its offset, needles.
        offset: i32,
        /// The largest offset allowed in either direction.
        limit: i32,
    },
    /// A run-in outside the allowed range.
    #[error(
        "guide bar {bar} has a run-in of {mm} mm a rack (480 courses); it must be from {low} to {high} mm"
    )]
    RunIn {
        /// The bar, counted from 1 at the front.
        bar: usize,
        /// Its run-in, mm a rack.
        mm: f64,
        /// The smallest run-in allowed, mm a rack.
        low: f64,
        /// The largest run-in allowed, mm a rack.
        high: f64,
    },
    /// A Jacquard whose colours have another number of courses than the chain of its bar.
    #[error("the Jacquard's colours have {courses}, but the chain of guide bar {bar} has {chain}", courses = counted(*.courses, "course"))]
    JacquardCourses {
        /// The bar, counted from 1 at the front.
        bar: usize,
        /// Courses of each colour.
        courses: usize,
        /// Courses of the chain.
        chain: usize,
    },
    /// A colour of a Jacquard that makes a lap go round too many needles.
    #[error(
        "a colour of guide bar {bar}'s Jacquard makes its lap {lap} at course {course}: {} needles; a lap goes round {limit} at most",
        .lap.overlap().unsigned_abs()
    )]
    JacquardLap {
        /// The bar, counted from 1 at the front.
        bar: usize,
        /// The course of the bar's chain, counted from 1.
        course: usize,
        /// The lap after the Jacquard has displaced it.
        lap: Lap,
        /// The most needles that a lap may go round.
        limit: i32,
    },
    /// A number of wales or courses that is not a multiple of the bars' repeat.
    #[error("{size}, but the pattern of the guide bars repeats every {multiple}: give a multiple of {multiple}", size = counted(*.size, .what))]
    WarpRepeat {
        /// `wale` or `course`.
        what: &'static str,
        /// The number of wales or courses.
        size: u32,
        /// The bars' repeat, in wales or in courses.
        multiple: u64,
    },
    /// Bars whose guides make no loops.
    #[error("no guide makes a loop")]
    NoLoops,
}
