//! What the caller's callbacks answer.

use std::error::Error;
use std::fmt;

use crate::failure::Failure;

/// A callback answered other than 0, which ends the call.
#[derive(Debug)]
pub(crate) struct Answer(i32);

impl Answer {
    /// The answer of a callback: 0 says to go on.
    pub(crate) fn of(answer: i32) -> Result<(), Self> {
        if answer == 0 { Ok(()) } else { Err(Self(answer)) }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the callback answered {}", self.0)
    }
}

impl Error for Answer {}

/// Makes sure that there is a callback.
pub(crate) fn given<F>(callback: Option<F>) -> Result<F, Failure> {
    callback.ok_or_else(|| Failure::argument("callback is null"))
}
