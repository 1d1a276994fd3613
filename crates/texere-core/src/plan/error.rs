//! What can't be planned for.

use thiserror::Error;

use crate::counted;

/// Settings that can't be planned for, or a plan that does not fit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Too many inserted points.
    #[error("{subdivisions}, more than {limit}", subdivisions = counted(*.subdivisions, "subdivision"))]
    Subdivisions {
        /// Given.
        subdivisions: u32,
        /// Most allowed.
        limit: u32,
    },
    /// Too few or too many sides.
    #[error("{sides}, outside {low} to {high}", sides = counted(*.sides, "side"))]
    Sides {
        /// Given.
        sides: u32,
        /// Least allowed.
        low: u32,
        /// Most allowed.
        high: u32,
    },
    /// A polygon section needs as many sides as it has corners.
    #[error(
        "section {section} is a polygon of {corners}, but tubes have {sides}; set sides to {}", .corners, corners = counted(*.corners, "corner"), sides = counted(*.sides, "side"))]
    PolygonSides {
        /// The section.
        section: usize,
        /// Its corners.
        corners: usize,
        /// The plan's sides.
        sides: u32,
    },
    /// One yarn has more rings than a `u32` counts.
    #[error("yarn {yarn} has {rings}, more than {limit}", rings = counted(*.rings, "ring"))]
    YarnRings {
        /// The yarn, from 0.
        yarn: usize,
        /// Its rings.
        rings: u64,
        /// Most allowed.
        limit: u64,
    },
    /// All yarns together have more rings than any machine holds.
    #[error("{rings}, more than {limit}", rings = counted(*.rings, "ring"))]
    Rings {
        /// All rings.
        rings: u64,
        /// Most allowed.
        limit: u64,
    },
    /// A yarn is to have more control points than the plan has room for.
    #[error("yarn {yarn} of {points}, but the plan has room for {room}", points = counted(*.points, "control point"))]
    NoRoom {
        /// The yarn, from 0.
        yarn: usize,
        /// Its control points.
        points: u64,
        /// Most that it may have.
        room: u64,
    },
    /// A yarn is to have too few control points.
    #[error("yarn {yarn} of {points}, fewer than {least}", points = counted(*.points, "control point"))]
    TooFewPoints {
        /// The yarn, from 0.
        yarn: usize,
        /// Its control points.
        points: u64,
        /// Least allowed.
        least: u64,
    },
    /// A yarn is to become what takes a new plan.
    #[error("yarn {yarn} can't be {what}: that takes a new plan")]
    OtherPlan {
        /// The yarn, from 0.
        yarn: usize,
        /// What it would be.
        what: &'static str,
    },
    /// Not even one block fits the limits of memory.
    #[error("one block of {rings} needs {needed} for {what}, but the limit is {limit}", rings = counted(*.rings, "ring"), needed = counted(*.needed, "byte"), limit = counted(*.limit, "byte"))]
    BlockTooLarge {
        /// Rings in the block.
        rings: u32,
        /// For which buffer.
        what: &'static str,
        /// Bytes that it needs.
        needed: u64,
        /// Bytes allowed.
        limit: u64,
    },
    /// Not even one block fits what a launch may count: see
    /// [`Limits::blocks`](crate::Limits::blocks).
    #[error("one block of {rings} takes {needed} {what}, but the limit is {limit}", rings = counted(*.rings, "ring"))]
    BlockOverCount {
        /// Rings in the block.
        rings: u32,
        /// What is counted: blocks, vertices or indices.
        what: &'static str,
        /// How many it takes.
        needed: u64,
        /// How many are allowed.
        limit: u64,
    },
}
