//! Subjects of errors: the property of a cloth that an error is about. With the subject, readers of
//! designs can name the line that sets the property.

use crate::{BackendError, BoundaryError, CrossingsError, Origin, RelaxationError, SettlingError, YarnError};

/// The property of a cloth that an error is about, in a designer's words. Numbers are counted from
/// 1.
///
/// ```
/// use texere_core::SettlingError;
/// use texere_core::Subject;
/// let error = SettlingError::ShortRepeat { axis: 'x', repeat: 0.5, diameter: 0.2, least: 1.0 };
/// assert_eq!(error.subject(), Some(Subject::Wales));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The cloth's size, and quantities that follow from it.
    Size,
    /// The number of wales of a warp knit.
    Width,
    /// The number of courses of a warp knit.
    Height,
    /// The number of copies of a repeat.
    Copies,
    /// The structure: weave, stitches or laps.
    Structure,
    /// The spacing of wales.
    Wales,
    /// The spacing of courses.
    Courses,
    /// The length of loops.
    Loops,
    /// The spacing of all ends.
    Ends,
    /// The spacing of all picks.
    Picks,
    /// The spacing of one end or pick from the one before.
    Spacing(Origin),
    /// The thickness of a thread.
    Thickness(Origin),
    /// The flatness of a thread.
    Flatness(Origin),
    /// The stiffness of a thread.
    Stiffness(Origin),
    /// The firmness of a thread's section.
    Firmness(Origin),
    /// The least area of a thread's section.
    LeastArea(Origin),
    /// The twist of a thread.
    Twist(Origin),
    /// The colour or material of a thread.
    Color(Origin),
    /// The section of a thread.
    Section(Origin),
    /// The warp's share of the crimp.
    Crimp,
    /// The carriers of a knit.
    Carriers,
    /// The number of guide bars.
    Bars,
    /// The threading of a guide bar.
    Threading(usize),
    /// The offset of a guide bar.
    Offset(usize),
    /// The run-in of a guide bar.
    RunIn(usize),
    /// The Jacquard of a guide bar.
    Jacquard(usize),
    /// How a knit comes to rest: by contact or by its energy.
    Rest,
    /// The length that settling gives yarns.
    Length,
    /// The tension that draws yarns in while they settle.
    Tension,
    /// The thickness that a knit is pressed to.
    Press,
    /// The stretch of cloth along its warp.
    WarpStretch,
    /// The stretch of cloth along its weft.
    WeftStretch,
    /// The tension of the warp.
    WarpTension,
    /// The tension of the weft.
    WeftTension,
    /// The pressure on woven cloth.
    Calender,
}

// The methods below match every variant by name, so that each new error must be given a subject.

impl SettlingError {
    /// The property of the cloth that the error is about. `None` for memory, settings that no
    /// design has, and calls that don't fit the yarns.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        Some(match self {
            Self::OutOfMemory(_) | Self::Pinned { .. } => return None,
            Self::Boundary(error) => return error.subject(),
            Self::ShortRepeat { axis: 'x', .. } | Self::LongInterval { axis: 'x', .. } => Subject::Wales,
            Self::ShortRepeat { .. } | Self::LongInterval { .. } => Subject::Courses,
            Self::LongYarns { .. } => Subject::Loops,
            Self::TooFewPoints { .. } | Self::TooLarge { .. } | Self::TooMany { .. } => Subject::Size,
            Self::Setting { setting, .. } => match *setting {
                "the length" => Subject::Length,
                "the tension" => Subject::Tension,
                "the gap between the plates" => Subject::Press,
                _ => return None,
            },
        })
    }
}

impl RelaxationError {
    /// The property of the cloth that the error is about. `None` for memory, settings that no
    /// design has, and calls that don't fit the yarns.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        Some(match self {
            Self::OutOfMemory(_) | Self::Pinned { .. } | Self::ElasticCount { .. } => return None,
            Self::Boundary(error) => return error.subject(),
            Self::Elastic { .. } => Subject::Thickness(Origin::Unknown),
            Self::Interval { .. } => Subject::Loops,
            Self::TooFewPoints { .. } | Self::TooMany { .. } => Subject::Size,
            Self::Setting { setting: "the length", .. } => Subject::Length,
            Self::Setting { .. } => return None,
        })
    }
}

impl CrossingsError {
    /// The property of the cloth that the error is about. `None` for memory, settings that no
    /// design has, and calls that don't fit the threads.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        Some(match self {
            Self::OutOfMemory(_) | Self::Drawdown { .. } | Self::Levels { .. } => return None,
            Self::TooFew { .. } | Self::TooMany { .. } => Subject::Size,
            Self::Level { .. } => Subject::Structure,
            Self::Setting { setting, .. } => match *setting {
                "tension of the warp" => Subject::WarpTension,
                "tension of the weft" => Subject::WeftTension,
                "press" => Subject::Calender,
                _ => return None,
            },
            Self::Thread { set, thread, setting, .. } => {
                let number = u32::try_from(thread + 1).unwrap_or(u32::MAX);
                let thread = if *set == "warp" { Origin::End(number) } else { Origin::Pick(number) };
                match *setting {
                    "pitch" => Subject::Spacing(thread),
                    "stiffness" => Subject::Stiffness(thread),
                    "firmness" => Subject::Firmness(thread),
                    "flatness" => Subject::Flatness(thread),
                    "least area" => Subject::LeastArea(thread),
                    "diameter" => Subject::Thickness(thread),
                    _ => Subject::Structure,
                }
            }
        })
    }
}

impl BoundaryError {
    /// The property of the cloth that the error is about. `None` for calls that don't fit the
    /// yarns.
    #[must_use]
    pub const fn subject(&self) -> Option<Subject> {
        match self {
            Self::Repeat { .. } => Some(Subject::Size),
            Self::EndsCount { .. } | Self::Closed { .. } | Self::NoRepeat { .. } | Self::NoWayOn { .. } => {
                None
            }
        }
    }
}

impl YarnError {
    /// The property of the cloth that the error is about. The thread is unknown here. `None` for
    /// tables that don't fit one another, invalid up directions, an unknown yarn, and the tension
    /// of splines, which no design sets.
    #[must_use]
    pub const fn subject(&self) -> Option<Subject> {
        Some(match self {
            Self::NoYarns
            | Self::TooFewPoints { .. }
            | Self::NotFinite { .. }
            | Self::TooFar { .. }
            | Self::Size { .. } => Subject::Size,
            Self::UnknownMaterial { .. }
            | Self::Hairiness { .. }
            | Self::LinearDensity { .. }
            | Self::Bending { .. } => Subject::Color(Origin::Unknown),
            Self::UnknownSection { .. } | Self::Section { .. } => Subject::Section(Origin::Unknown),
            Self::Twist { .. } => Subject::Twist(Origin::Unknown),
            Self::OffsetCount { .. }
            | Self::OffsetOrder { .. }
            | Self::PointCount { .. }
            | Self::SourceCount { .. }
            | Self::UpCount { .. }
            | Self::Up { .. }
            | Self::Tension { .. }
            | Self::OtherTension { .. }
            | Self::UnknownYarn { .. } => return None,
        })
    }
}

impl BackendError {
    /// The property of the cloth that the error is about. `None` for errors of devices and memory.
    #[must_use]
    pub const fn subject(&self) -> Option<Subject> {
        match self {
            Self::Crowded { .. } => Some(Subject::Structure),
            Self::NoDevice { .. }
            | Self::NoFeature { .. }
            | Self::NoInstructionSet { .. }
            | Self::NoAttributes
            | Self::NoPacking
            | Self::NoEditing
            | Self::NoSettling { .. }
            | Self::NoCrossings { .. }
            | Self::NoRelaxation { .. }
            | Self::OutOfMemory(_)
            | Self::DeviceLost { .. }
            | Self::Unsupported { .. }
            | Self::Compile { .. }
            | Self::NotLoaded { .. }
            | Self::Driver { .. } => None,
        }
    }
}
