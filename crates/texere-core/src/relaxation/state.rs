//! The unknowns of a relaxation.

use glam::{DVec2, DVec3};

/// The unknowns of a relaxation: the places of all control points, and the repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct RelaxationState {
    /// The places of control points, mm. There is one element per control point of all yarns.
    pub points: Vec<DVec3>,
    /// The length of the repeat along x and y, mm, 0 for none.
    pub repeat: DVec2,
}

impl RelaxationState {
    /// This state with the lengths of its repeat multiplied by `factors`. Points move with the
    /// repeat.
    #[must_use]
    pub fn stretched(&self, factors: DVec2) -> Self {
        let factor = factors.extend(1.0);
        Self {
            points: self.points.iter().map(|point| *point * factor).collect(),
            repeat: self.repeat * factors,
        }
    }
}
