//! What can go wrong between a design and its yarns.

use texere_contact::ContactError;
use texere_core::{BoundaryError, OutOfMemory, YarnError, counted};
use thiserror::Error;

use crate::warp::WarpError;
use crate::weft::WeftError;
use crate::woven::WovenError;
use crate::yarn_check::ThreadError;

/// A structure that can't be taken, or whose yarns can't be made or measured. What only one kind of
/// structure can have wrong is that kind's.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FabricError {
    /// Woven cloth.
    #[error(transparent)]
    Woven(#[from] WovenError),
    /// A weft knit, or the loops of any knit.
    #[error(transparent)]
    Weft(#[from] WeftError),
    /// A warp knit.
    #[error(transparent)]
    Warp(#[from] WarpError),
    /// A thread, of whatever structure.
    #[error(transparent)]
    Thread(#[from] ThreadError),
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// What was made of the structure could not be measured.
    #[error(transparent)]
    Contact(ContactError),
    /// A boundary that is not that of the yarns.
    #[error("the boundary is not that of the yarns")]
    Boundary(#[from] BoundaryError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// Yarns that are not those that a repeat is laid with.
    #[error("yarns of {points}; the repeat's have {planned}", points = counted(*.points, "control point"))]
    OtherYarns {
        /// Control points of the yarns.
        points: u64,
        /// Control points of the repeat's.
        planned: u64,
    },
    /// The yarns can't be taken.
    #[error("the cloth's yarns are not sound")]
    Yarns(#[from] YarnError),
}

impl From<ContactError> for FabricError {
    /// Short memory and a request to stop keep their names, whatever met them.
    fn from(error: ContactError) -> Self {
        match error {
            ContactError::OutOfMemory(error) => Self::OutOfMemory(error),
            ContactError::Cancelled => Self::Cancelled,
            error => Self::Contact(error),
        }
    }
}
