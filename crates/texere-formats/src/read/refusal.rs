//! What comes of a design that was read, but whose cloth can't be made or can't come to rest.

use std::path::PathBuf;

use texere_fabric::FinishError;
use thiserror::Error;

use super::FilePlace;
use super::error::named;

/// A design whose cloth can't be made, or can't come to rest:
/// [`Design::refused`](super::Design::refused) says where the design asks for that.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Refusal {
    /// A key of the design file.
    #[error("{place} asks for cloth that can't be made")]
    Key {
        /// Where.
        place: FilePlace,
        /// Why.
        source: FinishError,
    },
    /// The design, where no single key says it.
    #[error("{} asks for cloth that can't be made", named(.file))]
    File {
        /// The file.
        file: PathBuf,
        /// Why.
        source: FinishError,
    },
    /// Memory, a device, a setting of the mesh, somebody who asked to stop, a call that does not
    /// fit: no fault of the design. Or the design is of no file.
    #[error(transparent)]
    Other(#[from] FinishError),
}

impl Refusal {
    /// Why, in one line, with the place that asks for it where a key does: for a cloth that is
    /// there all the same.
    #[must_use]
    pub fn why(&self) -> String {
        match self {
            Self::Key { place, source } => format!("{place}: {source}"),
            refusal => refusal.to_string(),
        }
    }
}
