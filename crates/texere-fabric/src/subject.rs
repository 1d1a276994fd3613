//! What of a cloth an error of its structure, or of its settling, is about.

use texere_core::{Origin, Subject};

use crate::{FabricError, FinishError};

// As in the core, neither has an arm for all others.

impl FabricError {
    /// What of the cloth it is about. None of memory, of somebody who asked to stop, of what no design says, and of calls that don't fit the
    /// cloth.
    ///
    /// ```
    /// use texere_core::{Origin, Subject};
    /// use texere_fabric::FabricError;
    /// let error = FabricError::Radius { thread: Origin::End(3), radius_mm: 0.0, low: 0.1, high: 1.0 };
    /// assert_eq!(error.subject(), Some(Subject::Thickness(Origin::End(3))));
    /// assert_eq!(FabricError::Cancelled.subject(), None);
    /// ```
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        Some(match *self {
            Self::OutOfMemory(_)
            | Self::Cancelled
            | Self::NoCrossing { .. }
            | Self::NoMaterial { .. }
            | Self::OtherYarns { .. }
            | Self::OtherCloth { .. } => return None,
            Self::Boundary(ref error) => return error.subject(),
            Self::Contact(ref error) => return error.subject(),
            Self::Yarns(ref error) => return error.subject(),
            Self::Size { .. }
            | Self::Crossings { .. }
            | Self::Points { .. }
            | Self::Repeat { .. }
            | Self::ThreadCount { .. }
            | Self::KnitPoints { .. } => Subject::Size,
            Self::KnitSize { .. }
            | Self::KnitRuns { .. }
            | Self::KnitRepeat { .. }
            | Self::KnitNeedle { .. }
            | Self::KnitCarriers { .. }
            | Self::TieUp { .. }
            | Self::Notation { .. }
            | Self::NoWeave { .. }
            | Self::Hyphen { .. }
            | Self::Slash { .. }
            | Self::SatinMove { .. }
            | Self::NoSatin { .. }
            | Self::TwillMove { .. }
            | Self::Stitches { .. }
            | Self::NoLoops => Subject::Structure,
            Self::Laps { .. } | Self::WarpRepeat { what: "wale", .. } => Subject::Width,
            Self::WarpRepeat { .. } => Subject::Height,
            Self::Copies { .. } => Subject::Copies,
            Self::Spacing { thread, .. } => Subject::Spacing(thread),
            Self::Extent { set: "ends", .. } => Subject::Ends,
            Self::Extent { .. } => Subject::Picks,
            Self::Radius { thread, .. } => Subject::Thickness(thread),
            Self::Flatness { thread, .. } | Self::Half { thread, .. } => Subject::Flatness(thread),
            Self::Stiffness { thread, .. } => Subject::Stiffness(thread),
            Self::Twist { thread, .. } => Subject::Twist(thread),
            Self::UnknownMaterial { thread, .. } => Subject::Color(thread),
            Self::UnknownSection { thread, .. } => Subject::Section(thread),
            Self::Section { .. } => Subject::Section(Origin::Unknown),
            Self::Crimp { .. } => Subject::Crimp,
            Self::Gauge { what: "wales", .. } => Subject::Wales,
            Self::Gauge { what: "courses", .. } => Subject::Courses,
            Self::Gauge { .. } => Subject::Loops,
            Self::Carrier { .. } => Subject::Carriers,
            Self::Bars { .. } => Subject::Bars,
            Self::GuideYarn { bar, .. } => Subject::Threading(bar),
            Self::BarOffset { bar, .. } => Subject::Offset(bar),
            Self::RunIn { bar, .. } => Subject::RunIn(bar),
            Self::JacquardCourses { bar, .. } | Self::JacquardLap { bar, .. } => Subject::Jacquard(bar),
        })
    }
}

impl FinishError {
    /// What of the cloth it is about: that of what it holds. None of devices, and of what no design says.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        match self {
            Self::Fabric(error) => error.subject(),
            Self::Settling(error) | Self::Thread { source: error, .. } => error.subject(),
            Self::Crossings(error) => error.subject(),
            Self::Backend(error) => error.subject(),
            Self::Woven { asked: "a length" } => Some(Subject::Length),
            Self::Woven { asked: "a press" } => Some(Subject::Press),
            Self::Woven { .. } => None,
            Self::Stretch { along: "warp", .. } => Some(Subject::WarpStretch),
            Self::Stretch { .. } => Some(Subject::WeftStretch),
        }
    }
}
