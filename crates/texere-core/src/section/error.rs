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
        /// The parameter's name.
        field: &'static str,
        /// The parameter's value.
        value: f32,
        /// The least value allowed.
        low: f32,
        /// The largest value allowed.
        high: f32,
    },
    /// A polygon with too few or too many corners.
    #[error("polygon has {corners}, outside {low} to {high}", corners = counted(*.corners, "corner"))]
    Corners {
        /// The number of corners.
        corners: usize,
        /// The least number allowed.
        low: u32,
        /// The largest number allowed.
        high: u32,
    },
    /// Two neighbouring corners coincide.
    #[error("corner {corner} of the polygon and the next coincide")]
    RepeatedCorner {
        /// Number of the first of the two corners, counted from 0.
        corner: usize,
    },
    /// The outline crosses, touches or folds onto itself.
    #[error("edges {first} and {second} of the polygon meet")]
    SelfIntersecting {
        /// Number of one edge, counted from 0.
        first: usize,
        /// Number of the other edge.
        second: usize,
    },
    /// The corners run clockwise, so that the tube would be inside out. Their order must be
    /// reversed.
    #[error("polygon runs clockwise; give its corners counter-clockwise")]
    Clockwise,
}
