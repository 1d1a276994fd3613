//! Errors of making pictures.

use texere_core::backend::SessionError;
use texere_core::{BackendError, PlanError};
use thiserror::Error;

/// The reason why a picture can't be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The picture is empty, or larger than the device's textures.
    #[error("a picture of {width} × {height} pixels is not between 1 × 1 and {limit} × {limit}")]
    Size {
        /// The picture's width, pixels.
        width: u32,
        /// The picture's height, pixels.
        height: u32,
        /// The longest side that the device allows.
        limit: u32,
    },
    /// The picture fits the device's textures, but its supersampled screen does not, or the
    /// supersampling is 0.
    #[error(
        "supersampled {supersampling} times, a picture of {width} × {height} pixels is not between 1 × 1 and {limit} × {limit}; \
         {most} times is the most"
    )]
    Supersampling {
        /// The pixels of the screen for each pixel of the picture, each way.
        supersampling: u32,
        /// The largest supersampling that a picture of this size may have.
        most: u32,
        /// The picture's width, pixels.
        width: u32,
        /// The picture's height, pixels.
        height: u32,
        /// The longest side that the device allows.
        limit: u32,
    },
    /// A camera's parameter is out of range.
    #[error("{what} of {value} makes no view: it must be {expected}")]
    Camera {
        /// The name of the parameter.
        what: &'static str,
        /// The value of the parameter.
        value: f32,
        /// The values that are allowed.
        expected: &'static str,
    },
    /// No plan can be made for the settings.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// The device failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// The session was called wrongly, which is a fault of this crate.
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
