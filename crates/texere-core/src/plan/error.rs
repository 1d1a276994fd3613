//! Errors of plans.

use thiserror::Error;

use crate::counted;

/// Settings that can't be planned for, a plan that exceeds limits, or an edit that its plan can't
/// take.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Too many points inserted between control points.
    #[error("{subdivisions}, more than {limit}", subdivisions = counted(*.subdivisions, "subdivision"))]
    Subdivisions {
        /// Number of subdivisions given.
        subdivisions: u32,
        /// The largest number allowed.
        limit: u32,
    },
    /// Too few or too many sides.
    #[error("{sides}, outside {low} to {high}", sides = counted(*.sides, "side"))]
    Sides {
        /// Number of sides given.
        sides: u32,
        /// The least number allowed.
        low: u32,
        /// The largest number allowed.
        high: u32,
    },
    /// The number of sides differs from a polygon section's number of corners.
    #[error(
        "section {section} is a polygon of {corners}, but tubes have {sides}; set sides to {}", .corners, corners = counted(*.corners, "corner"), sides = counted(*.sides, "side"))]
    PolygonSides {
        /// Number of the section, counted from 0.
        section: usize,
        /// Number of the section's corners.
        corners: usize,
        /// Number of sides of the plan's tubes.
        sides: u32,
    },
    /// One yarn has more rings than a `u32` counts.
    #[error("yarn {yarn} has {rings}, more than {limit}", rings = counted(*.rings, "ring"))]
    YarnRings {
        /// Number of the yarn, counted from 0.
        yarn: usize,
        /// Number of the yarn's rings.
        rings: u64,
        /// The largest number allowed.
        limit: u64,
    },
    /// All yarns together have more rings than a plan may have.
    #[error("{rings}, more than {limit}", rings = counted(*.rings, "ring"))]
    Rings {
        /// Number of all rings.
        rings: u64,
        /// The largest number allowed.
        limit: u64,
    },
    /// A yarn is to have more control points than the plan has room for.
    #[error("yarn {yarn} of {points}, but the plan has room for {room}", points = counted(*.points, "control point"))]
    NoRoom {
        /// Number of the yarn, counted from 0.
        yarn: usize,
        /// Number of the yarn's control points.
        points: u64,
        /// The largest number that there is room for.
        room: u64,
    },
    /// A yarn is to have too few control points.
    #[error("yarn {yarn} of {points}, fewer than {least}", points = counted(*.points, "control point"))]
    TooFewPoints {
        /// Number of the yarn, counted from 0.
        yarn: usize,
        /// Number of the yarn's control points.
        points: u64,
        /// The least number allowed.
        least: u64,
    },
    /// An edit that needs a new plan.
    #[error("yarn {yarn} can't be {what}: that takes a new plan")]
    OtherPlan {
        /// Number of the yarn, counted from 0.
        yarn: usize,
        /// The change, as in "yarn 3 can't be ...".
        what: &'static str,
    },
    /// Not even one block fits a limit of bytes.
    #[error("one block of {rings} needs {needed} for {what}, but the limit is {limit}", rings = counted(*.rings, "ring"), needed = counted(*.needed, "byte"), limit = counted(*.limit, "byte"))]
    BlockTooLarge {
        /// Number of rings of the block.
        rings: u32,
        /// The buffer, or all buffers together.
        what: &'static str,
        /// The bytes needed.
        needed: u64,
        /// The bytes allowed.
        limit: u64,
    },
    /// A single block exceeds [`Limits::blocks`](crate::Limits::blocks), or has more vertices or
    /// indices than an indexed draw can count.
    #[error("one block of {rings} takes {needed} {what}, but the limit is {limit}", rings = counted(*.rings, "ring"))]
    BlockOverCount {
        /// Number of rings of the block.
        rings: u32,
        /// The things that are counted: blocks, vertices or indices.
        what: &'static str,
        /// The number needed.
        needed: u64,
        /// The number allowed.
        limit: u64,
    },
}
