//! Errors of settling by crossings.

use crate::{OutOfMemory, counted};
use thiserror::Error;

/// A cloth whose crossings can't be settled as asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CrossingsError {
    /// The drawdown's size differs from the numbers of threads.
    #[error("a drawdown of {ups} does not fit {ends} and {picks}", ups = counted(*.ups, "crossing"), ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Drawdown {
        /// Number of crossings of the drawdown.
        ups: usize,
        /// Number of ends given.
        ends: usize,
        /// Number of picks given.
        picks: usize,
    },
    /// A set with too few threads.
    #[error("{count}, at least {least} are needed", count = counted(*.count, .what))]
    TooFew {
        /// `end` or `pick`.
        what: &'static str,
        /// Number of the set's threads.
        count: usize,
        /// The least number that is accepted.
        least: usize,
    },
    /// A count above its limit.
    #[error("{count} {what} are more than {limit}")]
    TooMany {
        /// The things that are counted.
        what: &'static str,
        /// Number of these things.
        count: u64,
        /// The largest number that is accepted.
        limit: u64,
    },
    /// A setting out of its range.
    #[error("{setting} is {value}, not between {low} and {high}")]
    Setting {
        /// The setting's name.
        setting: &'static str,
        /// The setting's value.
        value: f32,
        /// The least value that is accepted.
        low: f32,
        /// The largest value that is accepted.
        high: f32,
    },
    /// A value of a thread out of its range.
    #[error("{setting} of {} {} is {value}, not between {low} and {high}", if *.set == "warp" { "end" } else { "pick" }, .thread + 1)]
    Thread {
        /// `warp` or `weft`.
        set: &'static str,
        /// The thread's number, counted from 0.
        thread: usize,
        /// `pitch`, `diameter`, `stiffness`, `firmness`, `flatness` or `least area`.
        setting: &'static str,
        /// The value given.
        value: f32,
        /// The least value that is accepted.
        low: f32,
        /// The largest value that is accepted.
        high: f32,
    },
    /// Levels that are given for another number of crossings.
    #[error("{levels} of the {set} do not fit {crossings}", levels = counted(*.levels, "level"), crossings = counted(*.crossings, "crossing"))]
    Levels {
        /// `warp` or `weft`.
        set: &'static str,
        /// Number of levels given.
        levels: usize,
        /// Number of crossings of the cloth.
        crossings: usize,
    },
    /// A level whose number is not below the number of levels, or too many levels.
    #[error("level {number} of the {set} at end {} and pick {} is not one of {of} levels, of which there may be {most}", .end + 1, .pick + 1)]
    Level {
        /// `warp` or `weft`.
        set: &'static str,
        /// The end's number, counted from 0.
        end: usize,
        /// The pick's number, counted from 0.
        pick: usize,
        /// The level's number, counted from 0.
        number: u8,
        /// The number of levels given.
        of: u8,
        /// The most levels that a set has.
        most: u8,
    },
    /// An allocation failed.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}
