//! What can go wrong while the contacts of yarns are measured.

use texere_core::{BoundaryError, OutOfMemory, PlanError, Subject, YarnError, counted};
use thiserror::Error;

/// Yarns whose contacts can't be measured. Yarns are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ContactError {
    /// The system refused memory.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// Settings with which no mesh of the yarns can be made.
    #[error(transparent)]
    Settings(#[from] PlanError),
    /// More control points than clearance is measured for.
    #[error("clearance of {points}; {limit} are measured at most", points = counted(*.points, "control point"))]
    ClearancePoints {
        /// Number of control points of all yarns.
        points: u64,
        /// The largest number that is accepted.
        limit: u64,
    },
    /// More control intervals than linking is compared for. In a repeat, an interval counts once
    /// for each copy of the repeat that it reaches into.
    #[error("linking of {intervals} with their copies; {limit} are compared at most", intervals = counted(*.intervals, "control interval"))]
    LinkingSize {
        /// An upper bound on the number of intervals of all yarns, with their copies. It is the
        /// number of control points times the most copies of an interval along x and along y.
        intervals: u64,
        /// The largest number that is accepted.
        limit: u64,
    },
    /// Two shapes that are not shapes of the same yarns, so that their linking can't be compared.
    #[error("yarn {yarn} differs before and after: in its number of control points, or it is another yarn")]
    OtherLayout {
        /// Number of the first yarn that differs, counted from 0.
        yarn: usize,
    },
    /// Two shapes whose splines have different tensions, so that they can't be compared.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// A boundary that does not belong to the yarns.
    #[error("the boundary is not that of the yarns")]
    Boundary(#[from] BoundaryError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl ContactError {
    /// The property of the cloth that the error is about. None if the error is not about the cloth:
    /// for a lack of memory, a cancelled call, settings, two shapes of different yarns or tensions,
    /// and ends of a boundary that don't fit the yarns.
    ///
    /// ```
    /// use texere_contact::ContactError;
    /// use texere_core::Subject;
    /// assert_eq!(ContactError::ClearancePoints { points: 9, limit: 8 }.subject(), Some(Subject::Size));
    /// assert_eq!(ContactError::Cancelled.subject(), None);
    /// ```
    #[must_use]
    pub const fn subject(&self) -> Option<Subject> {
        match self {
            Self::ClearancePoints { .. } | Self::LinkingSize { .. } => Some(Subject::Size),
            Self::Boundary(error) => error.subject(),
            Self::Yarns(error) => error.subject(),
            Self::OutOfMemory(_) | Self::Settings(_) | Self::OtherLayout { .. } | Self::Cancelled => None,
        }
    }
}
