//! Errors of yarns.

use thiserror::Error;

use crate::{SectionError, counted};

/// Invalid yarns. Yarns, points, sections and materials are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum YarnError {
    /// There are no yarns.
    #[error("no yarns")]
    NoYarns,
    /// The number of offsets is not one more than that of yarns.
    #[error("{offsets} for {yarns}, but there must be one more than yarns", offsets = counted(*.offsets, "offset"), yarns = counted(*.yarns, "yarn"))]
    OffsetCount {
        /// Number of offsets given.
        offsets: usize,
        /// Number of yarns given.
        yarns: usize,
    },
    /// Offsets that do not start at 0, or that fall.
    #[error("offsets of yarn {yarn} run from {start} to {end}")]
    OffsetOrder {
        /// Number of the yarn.
        yarn: usize,
        /// The offset at which the yarn starts.
        start: u64,
        /// The offset at which the yarn ends.
        end: u64,
    },
    /// A yarn with too few control points. An open yarn needs two, and a closed yarn three.
    #[error("yarn {yarn} has {points}, needs {least}{}", if *.closed { " since it is closed" } else { "" }, points = counted(*.points, "control point"))]
    TooFewPoints {
        /// Number of the yarn.
        yarn: usize,
        /// Number of the yarn's control points.
        points: u64,
        /// The least number that the yarn needs.
        least: u64,
        /// Whether the yarn is closed.
        closed: bool,
    },
    /// The number of control points differs from what the offsets say.
    #[error("{points}, but {planned} were planned", points = counted(*.points, "control point"))]
    PointCount {
        /// Number of control points given.
        points: u64,
        /// Number of control points by the offsets.
        planned: u64,
    },
    /// The number of sources differs from that of control points.
    #[error("{sources} for {points}", sources = counted(*.sources, "source"), points = counted(*.points, "control point"))]
    SourceCount {
        /// Number of sources given.
        sources: usize,
        /// Number of control points.
        points: usize,
    },
    /// The number of up directions differs from that of control points.
    #[error("{ups} for {points}", ups = counted(*.ups, "up direction"), points = counted(*.points, "control point"))]
    UpCount {
        /// Number of up directions given.
        ups: usize,
        /// Number of control points.
        points: usize,
    },
    /// An up direction that is zero, infinite or NaN.
    #[error("the up direction of point {point} of yarn {yarn} is {up:?}, which points nowhere")]
    Up {
        /// Number of the yarn.
        yarn: usize,
        /// Number of the point within the yarn.
        point: usize,
        /// The vector that was given.
        up: [f32; 3],
    },
    /// A tension outside [0, 1).
    #[error("tension is {tension}, outside 0 to below 1")]
    Tension {
        /// The tension that was given.
        tension: f32,
    },
    /// Yarns of different tensions. All yarns of a cloth must have splines of one tension.
    #[error("yarns of tension {given} beside yarns of tension {tension}")]
    OtherTension {
        /// The tension of the yarns that were given.
        given: f32,
        /// The tension of the other yarns.
        tension: f32,
    },
    /// There is no yarn of this number.
    #[error("no yarn {yarn}; there are {yarns}")]
    UnknownYarn {
        /// The number that was asked for.
        yarn: usize,
        /// Number of yarns.
        yarns: usize,
    },
    /// A yarn refers to a material that is missing.
    #[error("yarn {yarn} is of material {material}, but there are {materials}")]
    UnknownMaterial {
        /// Number of the yarn.
        yarn: usize,
        /// The yarn's material.
        material: u32,
        /// Number of materials.
        materials: usize,
    },
    /// A yarn refers to a section that is missing.
    #[error("yarn {yarn} has section {section}, but there are {sections}")]
    UnknownSection {
        /// Number of the yarn.
        yarn: usize,
        /// The yarn's section.
        section: u32,
        /// Number of sections.
        sections: usize,
    },
    /// A section with invalid parameters.
    #[error("section {section} is not sound")]
    Section {
        /// Number of the section.
        section: usize,
        /// The section's error.
        source: SectionError,
    },
    /// A twist that is NaN, infinite or too large.
    #[error("yarn {yarn} has a twist of {twist} rad/mm, beyond ±{limit}")]
    Twist {
        /// Number of the yarn.
        yarn: usize,
        /// The yarn's twist, rad/mm.
        twist: f32,
        /// The largest twist that is accepted, rad/mm.
        limit: f32,
    },
    /// A linear density that is NaN, infinite, 0 or negative.
    #[error("material {material} has {tex} tex, which is no positive number")]
    LinearDensity {
        /// Number of the material.
        material: usize,
        /// Its linear density, tex.
        tex: f32,
    },
    /// A bending stiffness that is NaN, too small or too large.
    #[error("material {material} has a bending stiffness of {bending} N mm², outside {low} to {high} N mm²")]
    Bending {
        /// Number of the material.
        material: usize,
        /// Its bending stiffness, N mm².
        bending: f32,
        /// The least that is accepted, N mm².
        low: f32,
        /// The greatest that is accepted, N mm².
        high: f32,
    },
    /// A hairiness that is NaN, below 0 or too large.
    #[error("material {material} has a hairiness of {hairiness}, which is not between 0 and {limit}")]
    Hairiness {
        /// Number of the material.
        material: usize,
        /// The material's hairiness, Uster's H.
        hairiness: f32,
        /// The largest hairiness that is accepted.
        limit: f32,
    },
    /// A control point with a component that is NaN or infinite.
    #[error("{field} of point {point} of yarn {yarn} is {value}")]
    NotFinite {
        /// Number of the yarn.
        yarn: usize,
        /// Number of the point within the yarn.
        point: usize,
        /// The component's name.
        field: &'static str,
        /// The component's value.
        value: f32,
    },
    /// A control point too far from the origin.
    #[error("{field} of point {point} of yarn {yarn} is {value} mm, beyond ±{limit} mm")]
    TooFar {
        /// Number of the yarn.
        yarn: usize,
        /// Number of the point within the yarn.
        point: usize,
        /// The component's name.
        field: &'static str,
        /// The component's value, mm.
        value: f32,
        /// The largest value that is accepted, mm.
        limit: f32,
    },
    /// A half width or half height that is too small, negative or too large.
    #[error("{field} of point {point} of yarn {yarn} is {size} mm, outside {low} to {high} mm")]
    Size {
        /// Number of the yarn.
        yarn: usize,
        /// Number of the point within the yarn.
        point: usize,
        /// `half width` or `half height`.
        field: &'static str,
        /// The size, mm. It is infinite if it is more than a half float holds.
        size: f32,
        /// The least size that is accepted, mm.
        low: f32,
        /// The largest size that is accepted, mm.
        high: f32,
    },
}
