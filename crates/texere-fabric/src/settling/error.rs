//! What can go wrong while yarns settle.

use texere_core::{BackendError, CrossingsError, SettlingError};
use thiserror::Error;

use crate::FabricError;

/// Yarns that could not be settled.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FinishError {
    /// The structure's yarns can't be made, or what came of them can't be measured; [`FabricError::Cancelled`] where the
    /// progress callback asked to stop.
    #[error(transparent)]
    Fabric(#[from] FabricError),
    /// What is asked can't be settled.
    #[error(transparent)]
    Settling(#[from] SettlingError),
    /// Something was asked of woven cloth that only knits have.
    #[error("woven cloth comes to rest by its crossings: {asked} is for knits")]
    Woven {
        /// `a length`, `a press` or `a course`.
        asked: &'static str,
    },
    /// Crossings of woven cloth can't be settled.
    #[error(transparent)]
    Crossings(#[from] CrossingsError),
    /// The device failed, or settles nothing.
    #[error(transparent)]
    Backend(#[from] BackendError),
}
