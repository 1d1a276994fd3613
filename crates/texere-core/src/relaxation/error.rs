//! Errors of a relaxation.

use thiserror::Error;

use crate::{BoundaryError, OutOfMemory, counted};

/// Yarns that can't be relaxed as asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RelaxationError {
    /// A boundary that does not fit the yarns.
    #[error(transparent)]
    Boundary(#[from] BoundaryError),
    /// Elastic properties for another number of yarns.
    #[error("elastic properties of {given} for {yarns}", given = counted(*.given as u64, "yarn"), yarns = counted(*.yarns as u64, "yarn"))]
    ElasticCount {
        /// Number of elastic properties given.
        given: usize,
        /// Number of yarns.
        yarns: usize,
    },
    /// A property that no yarn has.
    #[error("yarn {}: {property} of {value}: it must be {allowed}", .yarn + 1)]
    Elastic {
        /// The yarn's number, counted from 0.
        yarn: usize,
        /// The property.
        property: &'static str,
        /// The value given.
        value: f64,
        /// The values that are accepted.
        allowed: &'static str,
    },
    /// A yarn with too few control points.
    #[error("yarn {} has {points}, relaxing needs {least}", .yarn + 1, points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn's number, counted from 0.
        yarn: usize,
        /// Number of the yarn's control points.
        points: u64,
        /// The least number that is accepted.
        least: u64,
    },
    /// An interval that needs too many samples, or that has no length.
    #[error("yarn {}: {length} mm from control point {} to the next, with a core of {core} mm: it must be more than 0 and at most {most} mm", .yarn + 1, .point + 1)]
    Interval {
        /// The yarn's number, counted from 0.
        yarn: usize,
        /// The number of the control point in its yarn, counted from 0.
        point: u64,
        /// The interval's length, mm.
        length: f64,
        /// The radius of the yarn's core, mm.
        core: f64,
        /// The largest length that is accepted, mm.
        most: f64,
    },
    /// A setting out of its range.
    #[error("{setting} of {value}: it must be {low} to {high}")]
    Setting {
        /// The setting.
        setting: &'static str,
        /// The value given.
        value: f64,
        /// The least value that is accepted.
        low: f64,
        /// The greatest value that is accepted.
        high: f64,
    },
    /// A pinned control point that does not exist.
    #[error("control point {} is pinned, but there are {points}", .point + 1)]
    Pinned {
        /// The point's number, counted from 0.
        point: u64,
        /// Number of control points.
        points: u64,
    },
    /// More of something than the tables can count.
    #[error("{count} {what} are more than {limit}")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// Their number.
        count: u64,
        /// The limit.
        limit: u64,
    },
    /// Memory that the system refused.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}
