//! The part of a cloth that an error of its structure, or of its settling, is about.

use texere_core::{Origin, Subject};

use crate::warp::WarpError;
use crate::weft::WeftError;
use crate::{FabricError, FinishError, ThreadError, WovenError};

// No match here has a `_` arm, so that a new variant can't be left without a subject by oversight.

impl FabricError {
    /// The part of the cloth that the error is about. None if no design is at fault: for a lack of
    /// memory, a cancelled call, and a call that doesn't fit the cloth.
    ///
    /// ```
    /// use texere_core::{Origin, Subject};
    /// use texere_fabric::{FabricError, ThreadError};
    /// let error = ThreadError::Radius { thread: Origin::End(3), radius_mm: 0.0, low: 0.1, high: 1.0 };
    /// assert_eq!(FabricError::from(error).subject(), Some(Subject::Thickness(Origin::End(3))));
    /// assert_eq!(FabricError::Cancelled.subject(), None);
    /// ```
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        match self {
            Self::Woven(error) => error.subject(),
            Self::Weft(error) => Some(error.subject()),
            Self::Warp(error) => Some(error.subject()),
            Self::Thread(error) => Some(error.subject()),
            Self::Contact(error) => error.subject(),
            Self::Boundary(error) => error.subject(),
            Self::Yarns(error) => error.subject(),
            Self::OutOfMemory(_) | Self::Cancelled | Self::OtherYarns { .. } => None,
        }
    }
}

impl WovenError {
    /// The part of the cloth that the error is about. None for a call that doesn't fit the cloth.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        Some(match *self {
            Self::NoCrossing { .. } | Self::NoMaterial { .. } | Self::OtherCloth { .. } => return None,
            Self::Size { .. }
            | Self::Crossings { .. }
            | Self::Points { .. }
            | Self::Repeat { .. }
            | Self::ThreadCount { .. } => Subject::Size,
            Self::TieUp { .. }
            | Self::Notation { .. }
            | Self::NoWeave { .. }
            | Self::Hyphen { .. }
            | Self::Slash { .. }
            | Self::SatinMove { .. }
            | Self::NoSatin { .. }
            | Self::TwillMove { .. } => Subject::Structure,
            Self::Spacing { thread, .. } => Subject::Spacing(thread),
            Self::Extent { set: "ends", .. } => Subject::Ends,
            Self::Extent { .. } => Subject::Picks,
            Self::Flatness { thread, .. } | Self::Half { thread, .. } => Subject::Flatness(thread),
            Self::Stiffness { thread, .. } => Subject::Stiffness(thread),
            Self::Firmness { thread, .. } => Subject::Firmness(thread),
            Self::LeastArea { thread, .. } => Subject::LeastArea(thread),
            Self::Crimp { .. } => Subject::Crimp,
        })
    }
}

impl WeftError {
    /// The part of the cloth that the error is about.
    #[must_use]
    pub fn subject(&self) -> Subject {
        match *self {
            Self::KnitPoints { .. } => Subject::Size,
            Self::KnitSize { .. }
            | Self::KnitRuns { .. }
            | Self::KnitRepeat { .. }
            | Self::KnitNeedle { .. }
            | Self::KnitCarriers { .. }
            | Self::Stitches { .. } => Subject::Structure,
            Self::Copies { .. } => Subject::Copies,
            Self::Gauge { what: "wales", .. } => Subject::Wales,
            Self::Gauge { what: "courses", .. } => Subject::Courses,
            Self::Gauge { .. } => Subject::Loops,
            Self::Carrier { .. } => Subject::Carriers,
        }
    }
}

impl WarpError {
    /// The part of the cloth that the error is about.
    #[must_use]
    pub fn subject(&self) -> Subject {
        match *self {
            Self::NoLoops => Subject::Structure,
            Self::Laps { .. } | Self::WarpRepeat { what: "wale", .. } => Subject::Width,
            Self::WarpRepeat { .. } => Subject::Height,
            Self::Bars { .. } => Subject::Bars,
            Self::GuideYarn { bar, .. } => Subject::Threading(bar),
            Self::BarOffset { bar, .. } => Subject::Offset(bar),
            Self::RunIn { bar, .. } => Subject::RunIn(bar),
            Self::JacquardCourses { bar, .. } | Self::JacquardLap { bar, .. } => Subject::Jacquard(bar),
        }
    }
}

impl ThreadError {
    /// The part of the cloth that the error is about.
    #[must_use]
    pub const fn subject(&self) -> Subject {
        match *self {
            Self::Radius { thread, .. } => Subject::Thickness(thread),
            Self::Twist { thread, .. } => Subject::Twist(thread),
            Self::UnknownMaterial { thread, .. } => Subject::Color(thread),
            Self::UnknownSection { thread, .. } => Subject::Section(thread),
            Self::Section { .. } => Subject::Section(Origin::Unknown),
        }
    }
}

impl FinishError {
    /// The part of the cloth that the error is about: for most variants, the subject of the error
    /// that they hold. None if a device is at fault, and for a request that no design can make.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        match self {
            Self::Fabric(error) => error.subject(),
            Self::Settling(error) | Self::Thread { source: error, .. } => error.subject(),
            Self::Relaxation(error) => error.subject(),
            Self::NoEnergy { .. } | Self::Passed { .. } => Some(Subject::Rest),
            Self::Crossings(error) => error.subject(),
            Self::Backend(error) => error.subject(),
            Self::Woven { asked: "a length" } => Some(Subject::Length),
            Self::Woven { asked: "a press" } => Some(Subject::Press),
            Self::Woven { .. } | Self::Strains { .. } => None,
            Self::Stretch { along: "warp", .. } => Some(Subject::WarpStretch),
            Self::Stretch { .. } => Some(Subject::WeftStretch),
        }
    }
}
