//! Errors of warp knits.

use texere_core::counted;
use thiserror::Error;

use super::chain::Lap;

/// A warp knit that is refused. Guide bars are counted from 1 at the front, guides and courses from
/// 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WarpError {
    /// Too many laps before the cloth is copied.
    #[error("wales, courses and guide bars make {laps}; {limit} are taken at most", laps = counted(*.laps, "lap"))]
    Laps {
        /// Wales times courses times bars.
        laps: u64,
        /// Most taken.
        limit: u64,
    },
    /// No guide bars, or too many.
    #[error("{bars}; a warp knit has 1 to {limit}", bars = counted(*.bars, "guide bar"))]
    Bars {
        /// How many.
        bars: usize,
        /// Most taken.
        limit: usize,
    },
    /// A guide whose yarn does not exist.
    #[error("a guide of guide bar {bar} holds yarn {yarn}, but there are {yarns}")]
    GuideYarn {
        /// The bar, from 1.
        bar: usize,
        /// The yarn, from 1.
        yarn: u64,
        /// How many there are.
        yarns: usize,
    },
    /// A bar with too large an offset.
    #[error("guide bar {bar} is offset by {offset}, beyond \u{b1}{limit}", offset = counted(*.offset, "needle"))]
    BarOffset {
        /// The bar, from 1.
        bar: usize,
        /// Its offset, needles.
        offset: i32,
        /// Most taken, either way.
        limit: i32,
    },
    /// A run-in outside what is taken.
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
    /// A Jacquard whose colours have another number of courses than the chain of its bar.
    #[error("the Jacquard's colours have {courses}, but the chain of guide bar {bar} has {chain}", courses = counted(*.courses, "course"))]
    JacquardCourses {
        /// The bar, from 1.
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
        /// The bar, from 1.
        bar: usize,
        /// The course of its chain, from 1.
        course: usize,
        /// The lap, displaced.
        lap: Lap,
        /// Most needles taken.
        limit: i32,
    },
    /// Wales or courses that are no multiple of those after which the bars begin again.
    #[error("{size}, but bars begin again after {multiple}: take a multiple of that", size = counted(*.size, .what))]
    WarpRepeat {
        /// `wale` or `course`.
        what: &'static str,
        /// How many.
        size: u32,
        /// What it must be a multiple of.
        multiple: u64,
    },
    /// Bars whose guides make no loops.
    #[error("no guide makes a loop")]
    NoLoops,
}
