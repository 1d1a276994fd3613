//! What may be wrong with a problem.

use crate::{OutOfMemory, counted};
use thiserror::Error;

/// A cloth whose crossings can't be settled as asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CrossingsError {
    /// A drawdown of another size than the threads'.
    #[error("a drawdown of {ups} does not fit {ends} and {picks}", ups = counted(*.ups, "crossing"), ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    Drawdown {
        /// Its crossings.
        ups: usize,
        /// Threads of the warp.
        ends: usize,
        /// Threads of the weft.
        picks: usize,
    },
    /// A set with too few threads.
    #[error("{count}, at least {least} are needed", count = counted(*.count, .what))]
    TooFew {
        /// `end` or `pick`.
        what: &'static str,
        /// How many.
        count: usize,
        /// The least that are taken.
        least: usize,
    },
    /// More than can be counted.
    #[error("{count} {what} are more than {limit}")]
    TooMany {
        /// What.
        what: &'static str,
        /// How many.
        count: u64,
        /// How many are taken at most.
        limit: u64,
    },
    /// A setting that is out of its range.
    #[error("{setting} is {value}, not between {low} and {high}")]
    Setting {
        /// Its name.
        setting: &'static str,
        /// What was given.
        value: f32,
        /// The least that is taken.
        low: f32,
        /// The most that is taken.
        high: f32,
    },
    /// A value of a thread that is out of its range.
    #[error("{setting} of {} {} is {value}, not between {low} and {high}", if *.set == "warp" { "end" } else { "pick" }, .thread + 1)]
    Thread {
        /// `warp` or `weft`.
        set: &'static str,
        /// The thread's number, from 0.
        thread: usize,
        /// `pitch`, `diameter` or `stiffness`.
        setting: &'static str,
        /// What was given.
        value: f32,
        /// The least that is taken.
        low: f32,
        /// The most that is taken.
        high: f32,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}
