//! What can go wrong while the contacts of yarns are measured.

use texere_core::{BoundaryError, OutOfMemory, PlanError, Subject, YarnError, counted};
use thiserror::Error;

/// Yarns whose contacts can't be measured. Yarns are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ContactError {
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// Points between control points that no mesh is made with.
    #[error(transparent)]
    Settings(#[from] PlanError),
    /// More control points than clearance is measured for.
    #[error("clearance of {points}; {limit} are measured at most", points = counted(*.points, "control point"))]
    ClearancePoints {
        /// Control points of all yarns.
        points: u64,
        /// Most taken.
        limit: u64,
    },
    /// More control intervals than linking is compared for, with all their copies in a repeat that
    /// they reach into.
    #[error("linking of {intervals} with their copies; {limit} are compared at most", intervals = counted(*.intervals, "control interval"))]
    LinkingSize {
        /// Intervals of all yarns, with their copies.
        intervals: u64,
        /// Most taken.
        limit: u64,
    },
    /// Yarns whose linking can't be compared, for they are not the same ones.
    #[error("yarn {yarn} after is not the same as before: another number of control points, or another yarn")]
    OtherLayout {
        /// The first yarn that differs, from 0.
        yarn: usize,
    },
    /// Yarns that can't be compared, for their splines have another tension.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// A boundary that is not that of the yarns.
    #[error("the boundary is not that of the yarns")]
    Boundary(#[from] BoundaryError),
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl ContactError {
    /// What of the cloth it is about. None of memory, of somebody who asked to stop, of settings
    /// that no design has, and of calls that don't fit the yarns.
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
