//! What can go wrong while yarns settle.

use texere_contact::ContactError;
use texere_core::{BackendError, CrossingsError, Origin, OutOfMemory, SettlingError};
use thiserror::Error;

use crate::FabricError;

/// Yarns that could not be settled.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FinishError {
    /// The structure's yarns can't be made, or what came of them can't be measured;
    /// [`FabricError::Cancelled`] where the progress callback asked to stop.
    #[error(transparent)]
    Fabric(#[from] FabricError),
    /// What is asked can't be settled.
    #[error(transparent)]
    Settling(#[from] SettlingError),
    /// A thread can't be settled as asked.
    #[error("{thread} can't settle")]
    Thread {
        /// The thread.
        thread: Origin,
        /// Why.
        source: SettlingError,
    },
    /// Something was asked of woven cloth that only knits have.
    #[error("woven cloth comes to rest by its crossings: {asked} is for knits")]
    Woven {
        /// `a length`, `a press` or `a course`.
        asked: &'static str,
    },
    /// Woven cloth can't be stretched so far, or draw in so far, without another length of its
    /// threads.
    #[error(
        "cloth can't be {by} times as long along its {along} while its threads keep their lengths: these are straight at {most:.4}, and jam where it draws in too far"
    )]
    Stretch {
        /// `warp` or `weft`.
        along: &'static str,
        /// What was asked.
        by: f64,
        /// Where its threads are straight.
        most: f64,
    },
    /// Crossings of woven cloth can't be settled.
    #[error(transparent)]
    Crossings(#[from] CrossingsError),
    /// The device failed, or settles nothing.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

impl From<ContactError> for FinishError {
    fn from(error: ContactError) -> Self {
        Self::Fabric(error.into())
    }
}

impl From<OutOfMemory> for FinishError {
    fn from(error: OutOfMemory) -> Self {
        Self::Fabric(error.into())
    }
}
