//! What of a cloth an error is about, so that readers can say where a design says that.

use crate::{BackendError, BoundaryError, CrossingsError, Origin, SettlingError, YarnError};

/// What of a cloth an error is about, in the words of whoever designed it. Numbers are counted from
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
    /// How large it is, and what follows from that.
    Size,
    /// How many wales a warp knit has.
    Width,
    /// How many courses a warp knit has.
    Height,
    /// How often a repeat is copied.
    Copies,
    /// How its yarns go: its weave, its stitches or its laps.
    Structure,
    /// How far wales lie apart.
    Wales,
    /// How far courses lie apart.
    Courses,
    /// How long loops are.
    Loops,
    /// How far ends lie apart, all of them.
    Ends,
    /// How far picks lie apart, all of them.
    Picks,
    /// How far an end or a pick lies from the one before.
    Spacing(Origin),
    /// How thick a thread is.
    Thickness(Origin),
    /// How flat a thread is.
    Flatness(Origin),
    /// How stiff a thread is.
    Stiffness(Origin),
    /// How a thread is twisted.
    Twist(Origin),
    /// The colour or material of a thread.
    Color(Origin),
    /// The section of a thread.
    Section(Origin),
    /// The warp's share of the crimp.
    Crimp,
    /// Which yarns are knitted.
    Carriers,
    /// How many guide bars there are.
    Bars,
    /// What the guides of that bar hold.
    Threading(usize),
    /// Where that bar stands.
    Offset(usize),
    /// How much yarn that bar takes.
    RunIn(usize),
    /// What that bar's Jacquard displaces.
    Jacquard(usize),
    /// Which length yarns are given while they settle.
    Length,
    /// What draws yarns in while they settle.
    Tension,
    /// What a knit is pressed to.
    Press,
    /// How far cloth is stretched along its warp.
    WarpStretch,
    /// How far cloth is stretched along its weft.
    WeftStretch,
    /// How taut the warp is.
    WarpTension,
    /// How taut the weft is.
    WeftTension,
    /// How hard woven cloth is pressed.
    Calender,
}

// None of these has an arm for all others, so that whoever adds an error says what it is about.

impl SettlingError {
    /// What of the cloth it is about. None of memory, of settings that no design has, and of calls
    /// that don't fit the yarns.
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

impl CrossingsError {
    /// What of the cloth it is about. None of memory, of settings that no design has, and of calls
    /// that don't fit the threads.
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        Some(match self {
            Self::OutOfMemory(_) | Self::Drawdown { .. } => return None,
            Self::TooFew { .. } | Self::TooMany { .. } => Subject::Size,
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
                    "diameter" => Subject::Thickness(thread),
                    _ => Subject::Structure,
                }
            }
        })
    }
}

impl BoundaryError {
    /// What of the cloth it is about. None of calls that don't fit the yarns.
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
    /// What of the cloth it is about; which thread it is it does not know. None of tables that
    /// don't fit one another, and of splines' tension, which no design says.
    #[must_use]
    pub const fn subject(&self) -> Option<Subject> {
        Some(match self {
            Self::NoYarns
            | Self::TooFewPoints { .. }
            | Self::NotFinite { .. }
            | Self::TooFar { .. }
            | Self::Size { .. } => Subject::Size,
            Self::UnknownMaterial { .. } | Self::Hairiness { .. } => Subject::Color(Origin::Unknown),
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
    /// What of the cloth it is about. None of devices, and of memory.
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
            | Self::OutOfMemory(_)
            | Self::DeviceLost { .. }
            | Self::Unsupported { .. }
            | Self::Compile { .. }
            | Self::NotLoaded { .. }
            | Self::Driver { .. } => None,
        }
    }
}
