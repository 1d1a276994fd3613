//! What can end a call of a session.

use thiserror::Error;

use crate::{BackendError, OutOfMemory, PlanError, YarnError};

/// A session's call that failed: misuse, reported alike on every backend, or a failure of the
/// backend.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SessionError {
    /// A plan of only a [region](crate::backend::Plan::within), of which nothing can be edited.
    #[error("a mesh that is edited is of the whole cloth, and the plan is of a region of it")]
    Region,
    /// A yarn that there is not.
    #[error("yarn {yarn}, but there are {yarns}, counted from 0")]
    NoYarn {
        /// The yarn.
        yarn: usize,
        /// How many there are.
        yarns: usize,
    },
    /// Control points that no yarn can have.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// An upload past the last control point.
    #[error("upload of points {first} to {end}, but there are {points}")]
    UploadRange {
        /// First point.
        first: u64,
        /// One past the last.
        end: u64,
        /// How many there are.
        points: u64,
    },
    /// A stage was called before the one that it depends on.
    #[error("{call} was called before {needed}")]
    OutOfOrder {
        /// The call.
        call: &'static str,
        /// What has to come first.
        needed: &'static str,
    },
    /// A settler of other yarns than the session's: their numbers of control points differ.
    #[error("the settler's yarns have other numbers of control points than the session's")]
    OtherYarns,
    /// A chunk that is not of the session's plan.
    #[error("chunk {chunk} is of another plan than the session's")]
    ForeignChunk {
        /// The chunk's index.
        chunk: u64,
    },
    /// A chunk was read that no stage has run for, or whose memory has been reused since.
    #[error("chunk {chunk} is not in flight")]
    NotInFlight {
        /// The chunk's index.
        chunk: u64,
    },
    /// A chunk that there is not.
    #[error("chunk {chunk}, but there are {chunks}, counted from 0")]
    NoChunk {
        /// The chunk.
        chunk: usize,
        /// How many there are.
        chunks: usize,
    },
    /// An output slice that is not exactly as long as planned.
    #[error("{what} has room for {given}, but the chunk has {planned}")]
    OutputLength {
        /// Which slice.
        what: &'static str,
        /// Its length.
        given: u64,
        /// What the plan says.
        planned: u64,
    },
    /// The plan can't be made, or not even one block of it fits the device.
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
