//! What can be wrong with a warp knit.

use texere_core::counted;
use thiserror::Error;

use super::chain::Lap;

/// A warp knit that can't be taken. Guide bars and guides are counted from 1 from the front,
/// courses from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WarpError {
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
}
