//! Refusals of cloth that can't be made, or can't come to rest, though its design was read.

use std::path::PathBuf;

use texere_fabric::FinishError;
use thiserror::Error;

use super::FilePlace;
use super::error::named;

/// A design whose cloth can't be made, or can't come to rest:
/// [`Design::refused`](super::Design::refused) says where the design asks for it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Refusal {
    /// A key of the design file asks for the cloth.
    #[error("{place} asks for cloth that can't be made")]
    Key {
        /// The place in the file.
        place: FilePlace,
        /// The reason.
        source: FinishError,
    },
    /// The design asks for the cloth, but no single key does.
    #[error("{} asks for cloth that can't be made", named(.file))]
    File {
        /// The file.
        file: PathBuf,
        /// The reason.
        source: FinishError,
    },
    /// The fault is not the design's: too little memory, a device that failed, a setting of the
    /// mesh, a request to stop, or a call that does not fit the cloth. For a design without a file,
    /// all errors are of this kind.
    #[error(transparent)]
    Other(#[from] FinishError),
}

impl Refusal {
    /// The reason in one line, with the key that asks for the cloth, if there is one. For
    /// `Refusal::File`, the line names the file but not the reason. The line is meant for a program
    /// that shows the cloth in spite of the refusal.
    #[must_use]
    pub fn why(&self) -> String {
        match self {
            Self::Key { place, source } => format!("{place}: {source}"),
            refusal => refusal.to_string(),
        }
    }
}
