//! Return values of the caller's callbacks.

use std::error::Error;
use std::fmt;

/// The error that a callback returned a number other than 0, which ends the call.
#[derive(Debug)]
pub(crate) struct Answer(i32);

impl Answer {
    /// Fails unless the callback returned 0, which means to go on.
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
