//! The part of a yarn that is the cloth's own.

use std::ops::Range;

use texere_contact::{part_length_mm, round_length_mm};
use texere_core::{ControlPoint, Yarns};

/// The part of a yarn that is the cloth's. What lies beyond depends on where a sample is cut off.
#[derive(Debug, Clone)]
pub(crate) struct Own {
    /// The range of its control points.
    pub(crate) points: Range<usize>,
    /// The vector (x and y, mm) from this round to the next, of a yarn that goes on for ever. The
    /// last point then leads to the first of the next round.
    pub(crate) onward: Option<[f64; 2]>,
}

impl Own {
    /// The part of a yarn that goes on for ever: all its points without `before` at its beginning
    /// and `beyond` at its end.
    pub(crate) fn round(yarns: &Yarns, yarn: usize, [before, beyond]: [u32; 2], onward: [f64; 2]) -> Self {
        let count = yarns.yarn_points(yarn).map_or(0, <[ControlPoint]>::len);
        let points = before as usize..count.saturating_sub(beyond as usize);
        if points.is_empty() {
            return Self { points: 0..count, onward: None };
        }
        Self { points, onward: Some(onward) }
    }

    /// The intervals of the part. Where the yarn ends none begins at its last point.
    pub(crate) fn intervals(&self) -> Range<usize> {
        let Range { start, end } = self.points;
        start..end.saturating_sub(usize::from(self.onward.is_none()))
    }

    /// Its length, mm.
    pub(crate) fn length_mm(&self, yarns: &Yarns, yarn: usize) -> f64 {
        let points = yarns.yarn_points(yarn).unwrap_or(&[]);
        match self.onward {
            Some(onward) => round_length_mm(&points[self.points.clone()], onward, yarns.tension()),
            None => part_length_mm(points, self.points.clone(), yarns.tension()),
        }
    }
}
