//! Errors of yarns.

use thiserror::Error;

use crate::{SectionError, counted};

/// Invalid yarns. Yarns and points are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum YarnError {
    /// There are no yarns.
    #[error("no yarns")]
    NoYarns,
    /// There must be one more offset than yarns.
    #[error("{offsets} for {yarns}, which need one more than yarns", offsets = counted(*.offsets, "offset"), yarns = counted(*.yarns, "yarn"))]
    OffsetCount {
        /// Offsets given.
        offsets: usize,
        /// Yarns given.
        yarns: usize,
    },
    /// Offsets must start at 0 and never fall.
    #[error("offsets of yarn {yarn} run from {start} to {end}")]
    OffsetOrder {
        /// The yarn.
        yarn: usize,
        /// Its first offset.
        start: u64,
        /// Its second offset.
        end: u64,
    },
    /// An open yarn needs two control points, a closed one three.
    #[error("yarn {yarn} has {points}, needs {least}{}", if *.closed { " since it is closed" } else { "" }, points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn.
        yarn: usize,
        /// Control points it has.
        points: u64,
        /// Control points it needs.
        least: u64,
        /// Whether it is closed.
        closed: bool,
    },
    /// The control points don't match the offsets.
    #[error("{points} where {planned} were planned", points = counted(*.points, "control point"))]
    PointCount {
        /// Given.
        points: u64,
        /// Planned.
        planned: u64,
    },
    /// There must be one source per control point.
    #[error("{sources} for {points}", sources = counted(*.sources, "source"), points = counted(*.points, "control point"))]
    SourceCount {
        /// Given.
        sources: usize,
        /// Needed.
        points: usize,
    },
    /// There must be one up direction per control point.
    #[error("{ups} for {points}", ups = counted(*.ups, "up direction"), points = counted(*.points, "control point"))]
    UpCount {
        /// Given.
        ups: usize,
        /// Needed.
        points: usize,
    },
    /// An up direction must not be zero, infinite or NaN.
    #[error("the up direction of point {point} of yarn {yarn} is {up:?}, which points nowhere")]
    Up {
        /// The yarn, from 0.
        yarn: usize,
        /// The point of the yarn, from 0.
        point: usize,
        /// Given.
        up: [f32; 3],
    },
    /// Tension must lie in [0, 1).
    #[error("tension is {tension}, outside 0 to below 1")]
    Tension {
        /// Given.
        tension: f32,
    },
    /// All yarns of a cloth have splines of one tension.
    #[error("yarns of tension {given} beside yarns of tension {tension}")]
    OtherTension {
        /// Theirs.
        given: f32,
        /// That of the others.
        tension: f32,
    },
    /// There is no yarn of this number.
    #[error("no yarn {yarn}; there are {yarns}")]
    UnknownYarn {
        /// The number asked for.
        yarn: usize,
        /// The number that exist.
        yarns: usize,
    },
    /// A yarn refers to a material that is missing.
    #[error("yarn {yarn} is of material {material}, but there are {materials}")]
    UnknownMaterial {
        /// The yarn.
        yarn: usize,
        /// Its material.
        material: u32,
        /// The number that exist.
        materials: usize,
    },
    /// A yarn refers to a section that is missing.
    #[error("yarn {yarn} has section {section}, but there are {sections}")]
    UnknownSection {
        /// The yarn.
        yarn: usize,
        /// Its section.
        section: u32,
        /// The number that exist.
        sections: usize,
    },
    /// A section with invalid parameters.
    #[error("section {section} is not sound")]
    Section {
        /// Its number.
        section: usize,
        /// Why.
        source: SectionError,
    },
    /// A twist that is not finite or too large.
    #[error("yarn {yarn} has a twist of {twist} rad/mm, beyond ±{limit}")]
    Twist {
        /// The yarn.
        yarn: usize,
        /// Its twist, rad/mm.
        twist: f32,
        /// The largest accepted.
        limit: f32,
    },
    /// A linear density that is not finite, 0 or below.
    #[error("material {material} has {tex} tex, which is no positive number")]
    LinearDensity {
        /// Number of the material.
        material: usize,
        /// Its linear density, tex.
        tex: f32,
    },
    /// A hairiness that is NaN, below 0 or too large.
    #[error("material {material} has a hairiness of {hairiness}, which is not between 0 and {limit}")]
    Hairiness {
        /// The material.
        material: usize,
        /// Its hairiness, Uster's H.
        hairiness: f32,
        /// The largest accepted.
        limit: f32,
    },
    /// A control point with NaN or infinity in it.
    #[error("{field} of point {point} of yarn {yarn} is {value}")]
    NotFinite {
        /// The yarn.
        yarn: usize,
        /// The point.
        point: usize,
        /// The component.
        field: &'static str,
        /// Its value.
        value: f32,
    },
    /// A control point too far from the origin.
    #[error("{field} of point {point} of yarn {yarn} is {value} mm, beyond ±{limit} mm")]
    TooFar {
        /// The yarn.
        yarn: usize,
        /// The point.
        point: usize,
        /// The component.
        field: &'static str,
        /// Its value, mm.
        value: f32,
        /// The largest accepted, mm.
        limit: f32,
    },
    /// A half width or half height that is too small, negative or too large.
    #[error("{field} of point {point} of yarn {yarn} is {size} mm, outside {low} to {high} mm")]
    Size {
        /// The yarn.
        yarn: usize,
        /// The point.
        point: usize,
        /// Half width or half height.
        field: &'static str,
        /// Its value, mm. Infinite if it is more than a half float holds.
        size: f32,
        /// The least accepted, mm.
        low: f32,
        /// The largest accepted, mm.
        high: f32,
    },
}
