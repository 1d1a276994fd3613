//! Errors of making pictures.

use texere_core::backend::SessionError;
use texere_core::{BackendError, PlanError};
use thiserror::Error;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The picture is empty, or larger than the device's textures.
    #[error("a picture of {width} × {height} pixels is not between 1 × 1 and {limit} × {limit}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The longest side that the device allows.
        limit: u32,
    },
    /// The picture fits the device's textures, but not with this supersampling.
    #[error(
        "supersampled {supersampling} times, a picture of {width} × {height} pixels is not between 1 × 1 and {limit} × {limit}; \
         {most} times is the most"
    )]
    Supersampling {
        /// Pixels of the screen for a pixel of the picture, each way.
        supersampling: u32,
        /// The most that a picture of this size may have.
        most: u32,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The longest side that the device allows.
        limit: u32,
    },
    /// A camera's parameter is out of range.
    #[error("{what} of {value} makes no view: it must be {expected}")]
    Camera {
        /// What the parameter is.
        what: &'static str,
        /// Its value.
        value: f32,
        /// The values that are allowed.
        expected: &'static str,
    },
    /// The settings can't be planned for.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The device failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// A wrong call of the session: a fault of this crate.
    #[error(transparent)]
    Session(SessionError),
}

impl From<SessionError> for RenderError {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Backend(error) => Self::Backend(error),
            SessionError::Plan(error) => Self::Plan(error),
            misuse => Self::Session(misuse),
        }
    }
}
