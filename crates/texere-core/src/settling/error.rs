//! Errors of settling.

use crate::{BoundaryError, OutOfMemory, counted};
use thiserror::Error;

/// A cloth that can't be settled as asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SettlingError {
    /// A boundary that does not fit the yarns.
    #[error(transparent)]
    Boundary(#[from] BoundaryError),
    /// A repeat so short that a yarn could meet two images of another at once.
    #[error(
        "a repeat of {repeat} mm along {axis} is too short for yarns of {diameter} mm: copy it until it is {least} mm"
    )]
    ShortRepeat {
        /// `x` or `y`.
        axis: char,
        /// The length given, mm.
        repeat: f32,
        /// The thickest yarn's diameter, mm.
        diameter: f32,
        /// The least length that is accepted, mm.
        least: f32,
    },
    /// A yarn with too few control points.
    #[error("yarn {} has {points}, settling needs {least}", .yarn + 1, points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn's number, counted from 0.
        yarn: usize,
        /// Number of the yarn's control points.
        points: u64,
        /// The least number that is accepted.
        least: u64,
    },
    /// A cloth that is too large for its thinnest yarn, because the units of places would be too
    /// coarse.
    #[error("a cloth of {extent} mm is too large to settle with yarns of {diameter} mm")]
    TooLarge {
        /// The distance along one axis from the cloth's middle to its furthest point, plus the
        /// greater of the repeat's length and the way to a yarn's next copy, mm.
        extent: f32,
        /// The thinnest yarn's diameter, mm.
        diameter: f32,
    },
    /// A yarn that is so long for its thickness, from one control point to the next, that it needs
    /// too many chords.
    #[error(
        "yarn {}: from one of its control points to the next, along {axis}, {chords} are needed, more than {limit}: it is too long for its thickness",
        .yarn + 1, chords = counted(*.chords, "chord"))]
    LongInterval {
        /// The yarn's number, counted from 0.
        yarn: usize,
        /// The axis along which the yarn goes most: `x` or `y`.
        axis: char,
        /// Number of chords needed.
        chords: u64,
        /// The largest number that is accepted.
        limit: u64,
    },
    /// Yarns that are so long for their thickness, all together, that they need too many chords for
    /// their number of control points.
    #[error(
        "yarns of {points} need {chords}, more than {limit}: they are too long for their thickness", points = counted(*.points, "control point"), chords = counted(*.chords, "chord"))]
    LongYarns {
        /// Number of control points.
        points: u64,
        /// Number of chords needed.
        chords: u64,
        /// The most chords for this number of points.
        limit: u64,
    },
    /// A count above its limit.
    #[error("{count} {what} are more than {limit}")]
    TooMany {
        /// The things that are counted.
        what: &'static str,
        /// Number of these things.
        count: u64,
        /// The largest number that is accepted.
        limit: u64,
    },
    /// An allocation failed.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// A setting out of its range.
    #[error("{setting} is {value}, not between {low} and {high}")]
    Setting {
        /// The setting's name.
        setting: &'static str,
        /// The setting's value.
        value: f32,
        /// The least value that is accepted.
        low: f32,
        /// The largest value that is accepted.
        high: f32,
    },
    /// A pinned control point that does not exist.
    #[error("control point {point} can't be pinned, there are {points}")]
    Pinned {
        /// The point's number, counted from 0.
        point: u64,
        /// Number of control points.
        points: u64,
    },
}

impl SettlingError {
    /// The number of the refused yarn, counted from 0. `None` if the error is not about one yarn.
    ///
    /// ```
    /// use texere_core::SettlingError;
    /// assert_eq!(SettlingError::LongInterval { yarn: 2, axis: 'x', chords: 5000, limit: 4096 }.yarn(), Some(2));
    /// ```
    #[must_use]
    pub const fn yarn(&self) -> Option<usize> {
        match self {
            Self::TooFewPoints { yarn, .. } | Self::LongInterval { yarn, .. } => Some(*yarn),
            _ => None,
        }
    }
}
