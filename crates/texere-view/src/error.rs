//! Why no window can be opened.

use std::error::Error;
use std::iter::successors;

use texere::read::Refusal;
use texere::{BackendError, ReadError};
use thiserror::Error;

/// Why no window can be opened.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The design can't be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The design does not allow [`View::section`](crate::View::section). The refusal names file,
    /// line and key of the design.
    #[error(transparent)]
    Refused(Box<Refusal>),
    /// The device can't be opened, or failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// The system opens no window, or its driver can't draw into one.
    #[error("no window can be opened")]
    Window(#[source] Box<dyn Error>),
}

impl From<Refusal> for ViewError {
    fn from(error: Refusal) -> Self {
        Self::Refused(error.into())
    }
}

/// An error and its causes, in one line.
pub(crate) fn said(error: &(dyn Error + 'static)) -> String {
    let all: Vec<_> = successors(Some(error), |error: &&(dyn Error + 'static)| (*error).source())
        .map(ToString::to_string)
        .collect();
    all.join(": ")
}
