//! Errors of sessions.

use thiserror::Error;

use crate::{BackendError, OutOfMemory, PlanError, YarnError};

/// A failed call of a session: a misuse, which is reported alike with every backend, or a failure
/// of the backend.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SessionError {
    /// A mesh that is edited needs a plan of the whole cloth, and this plan is of a
    /// [region](crate::backend::Plan::within).
    #[error("to edit a mesh takes a plan of the whole cloth, and this plan is of a region of it")]
    Region,
    /// There is no yarn of this number.
    #[error("there is no yarn {yarn}: there are {yarns}, numbered from 0")]
    NoYarn {
        /// The number that was given.
        yarn: usize,
        /// Number of yarns.
        yarns: usize,
    },
    /// A control point is invalid.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// An upload past the last control point.
    #[error("upload of the points from {first} to before {end}, counted from 0, but there are {points}")]
    UploadRange {
        /// Number of the first point.
        first: u64,
        /// Number of the last point, plus 1.
        end: u64,
        /// Number of control points of the plan.
        points: u64,
    },
    /// A stage was called before the one that it depends on.
    #[error("{call} was called before {needed}")]
    OutOfOrder {
        /// The name of the call.
        call: &'static str,
        /// The name of the call that has to come first.
        needed: &'static str,
    },
    /// The settler has more or fewer yarns than the session, or a yarn of it has more or fewer
    /// control points.
    #[error("the settler's yarns or their control points are not as many as the session's")]
    OtherYarns,
    /// The chunk belongs to another plan than the session's.
    #[error("chunk {chunk} is of another plan than the session's")]
    ForeignChunk {
        /// The chunk's index.
        chunk: u64,
    },
    /// A chunk was read before the stage that makes its data, or after its memory was used for
    /// another chunk.
    #[error("chunk {chunk} is not in flight")]
    NotInFlight {
        /// The chunk's index.
        chunk: u64,
    },
    /// There is no chunk of this number.
    #[error("there is no chunk {chunk}: there are {chunks}, numbered from 0")]
    NoChunk {
        /// The number that was given.
        chunk: usize,
        /// Number of chunks.
        chunks: usize,
    },
    /// An output slice does not have exactly the planned length.
    #[error("the slice for {what} has room for {given}, but {planned} are made")]
    OutputLength {
        /// The slice: `vertices` or `indices`.
        what: &'static str,
        /// The slice's length.
        given: u64,
        /// The planned length.
        planned: u64,
    },
    /// The plan can't be made or edited as asked, or not even one block of it fits the device.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The backend failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

impl From<OutOfMemory> for SessionError {
    fn from(error: OutOfMemory) -> Self {
        Self::Backend(error.into())
    }
}
