//! What may be wrong with a problem.

use crate::{BoundaryError, OutOfMemory, counted};
use thiserror::Error;

/// A cloth that can't be settled as asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SettlingError {
    /// A boundary that is not the yarns' own.
    #[error(transparent)]
    Boundary(#[from] BoundaryError),
    /// A repeat so short that a yarn could meet two images of another at once.
    #[error(
        "a repeat of {repeat} mm along {axis} is too short for yarns of {diameter} mm: copy it until it is {least} mm"
    )]
    ShortRepeat {
        /// `x` or `y`.
        axis: char,
        /// The length that was given.
        repeat: f32,
        /// The thickest yarn's diameter.
        diameter: f32,
        /// The least length that is taken.
        least: f32,
    },
    /// A yarn with too few control points between its ends.
    #[error("yarn {} has {points}, settling needs {least}", .yarn + 1, points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn's number, from 0.
        yarn: usize,
        /// Its control points.
        points: u64,
        /// The least that are taken.
        least: u64,
    },
    /// A cloth too large for its thinnest yarn: places would be too coarse.
    #[error("a cloth of {extent} mm is too large to settle with yarns of {diameter} mm")]
    TooLarge {
        /// From its middle to its furthest point, mm.
        extent: f32,
        /// The thinnest yarn's diameter, mm.
        diameter: f32,
    },
    /// A yarn so much longer than it is thick, from one control point to the next, that it takes
    /// too many chords.
    #[error(
        "yarn {}: from one of its control points to the next, along {axis}, {chords} are needed, more than {limit}: it is too long for its thickness",
        .yarn + 1, chords = counted(*.chords, "chord"))]
    LongInterval {
        /// The yarn's number, from 0.
        yarn: usize,
        /// Which way it goes most: `x` or `y`.
        axis: char,
        /// Chords that are needed.
        chords: u64,
        /// How many are taken at most.
        limit: u64,
    },
    /// Yarns that in all are so much longer than they are thick that they take too many chords for
    /// their control points.
    #[error(
        "yarns of {points} need {chords}, more than {limit}: they are too long for their thickness", points = counted(*.points, "control point"), chords = counted(*.chords, "chord"))]
    LongYarns {
        /// Control points.
        points: u64,
        /// Chords that are needed.
        chords: u64,
        /// How many are taken at most for so many points.
        limit: u64,
    },
    /// More than can be counted.
    #[error("{count} {what} are more than {limit}")]
    TooMany {
        /// What.
        what: &'static str,
        /// How many.
        count: u64,
        /// How many are taken at most.
        limit: u64,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// A setting that is out of its range.
    #[error("{setting} is {value}, not between {low} and {high}")]
    Setting {
        /// Its name.
        setting: &'static str,
        /// What was given.
        value: f32,
        /// The least that is taken.
        low: f32,
        /// The most that is taken.
        high: f32,
    },
    /// A pinned control point that is not there.
    #[error("control point {point} can't be pinned, there are {points}")]
    Pinned {
        /// The point's number, from 0.
        point: u64,
        /// How many there are.
        points: u64,
    },
}

impl SettlingError {
    /// The number of the yarn that is refused, from 0. None of what is so of all of them.
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
