//! What can go wrong between a design and its yarns.

use texere_contact::ContactError;
use texere_core::{BoundaryError, OutOfMemory, YarnError, counted};
use thiserror::Error;

use crate::warp::WarpError;
use crate::weft::WeftError;
use crate::woven::WovenError;
use crate::yarn_check::ThreadError;

/// A structure that is refused, or whose yarns can't be made or measured. Each kind of structure
/// has an error of its own for faults that only this kind can have.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FabricError {
    /// An error of woven cloth.
    #[error(transparent)]
    Woven(#[from] WovenError),
    /// An error of a weft knit, or of the loops of any knit.
    #[error(transparent)]
    Weft(#[from] WeftError),
    /// An error of a warp knit.
    #[error(transparent)]
    Warp(#[from] WarpError),
    /// An error of a thread of any structure.
    #[error(transparent)]
    Thread(#[from] ThreadError),
    /// The system refused memory.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// The structure's yarns could not be measured.
    #[error(transparent)]
    Contact(ContactError),
    /// A boundary that does not belong to the yarns.
    #[error("the boundary is not that of the yarns")]
    Boundary(#[from] BoundaryError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// Yarns that don't belong to the repeat whose copies are to be placed.
    #[error("yarns of {points}; the repeat's have {planned}", points = counted(*.points, "control point"))]
    OtherYarns {
        /// Control points of the yarns.
        points: u64,
        /// Control points of the repeat's yarns.
        planned: u64,
    },
    /// Yarns that the core refuses.
    #[error("the cloth's yarns are not sound")]
    Yarns(#[from] YarnError),
}

impl From<ContactError> for FabricError {
    /// Short memory and a cancelled call keep their own variants.
    fn from(error: ContactError) -> Self {
        match error {
            ContactError::OutOfMemory(error) => Self::OutOfMemory(error),
            ContactError::Cancelled => Self::Cancelled,
            error => Self::Contact(error),
        }
    }
}
