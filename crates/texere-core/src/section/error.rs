//! Errors of cross-sections.

use thiserror::Error;

use crate::counted;

/// A section with invalid parameters.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SectionError {
    /// A number outside its limits, or not a number.
    #[error("{field} is {value}, outside {low} to {high}")]
    OutOfRange {
        /// The parameter.
        field: &'static str,
        /// Its value.
        value: f32,
        /// Least allowed.
        low: f32,
        /// Most allowed.
        high: f32,
    },
    /// A polygon with too few or too many corners.
    #[error("polygon has {corners}, outside {low} to {high}", corners = counted(*.corners, "corner"))]
    Corners {
        /// The number of corners.
        corners: usize,
        /// Least allowed.
        low: u32,
        /// Most allowed.
        high: u32,
    },
    /// Two neighbouring corners coincide.
    #[error("corners {corner} and the next of the polygon coincide")]
    RepeatedCorner {
        /// The first of the two, from 0.
        corner: usize,
    },
    /// The outline crosses, touches or folds onto itself.
    #[error("edges {first} and {second} of the polygon meet")]
    SelfIntersecting {
        /// One edge, from 0.
        first: usize,
        /// The other.
        second: usize,
    },
    /// The corners run clockwise: the tube would be inside out. Reverse them.
    #[error("polygon runs clockwise; give its corners counter-clockwise")]
    Clockwise,
}
