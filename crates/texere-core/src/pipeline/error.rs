//! Errors of pipelines.

use thiserror::Error;

use crate::backend::SessionError;
use crate::{BackendError, OutOfMemory, PlanError};

/// A failed run of a pipeline.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// The settings can't be planned for, or not even one block fits the limits.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The backend failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// A settler of other yarns. The pipeline itself never misuses its session.
    #[error(transparent)]
    Session(SessionError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl From<SessionError> for PipelineError {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Backend(error) => Self::Backend(error),
            SessionError::Plan(error) => Self::Plan(error),
            misuse => Self::Session(misuse),
        }
    }
}

impl From<OutOfMemory> for PipelineError {
    fn from(error: OutOfMemory) -> Self {
        Self::Backend(error.into())
    }
}
