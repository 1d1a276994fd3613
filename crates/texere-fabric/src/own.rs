//! What of a yarn is the cloth's own.

use std::ops::Range;

use texere_contact::{part_length_mm, round_length_mm};
use texere_core::{ControlPoint, Yarns};

/// What of a yarn is the cloth's: what lies beyond is cut off where a sample ends, and another
/// sample would have it elsewhere.
#[derive(Debug, Clone)]
pub(crate) struct Own {
    /// The control points.
    pub(crate) points: Range<usize>,
    /// How far its next round lies from this one, mm, where it goes on for ever; the last point
    /// leads to that one's first.
    pub(crate) onward: Option<[f64; 2]>,
}

impl Own {
    /// The yarn goes on for ever: all its points but so many before and beyond.
    pub(crate) fn round(yarns: &Yarns, yarn: usize, [before, beyond]: [u32; 2], onward: [f64; 2]) -> Self {
        let count = yarns.yarn_points(yarn).map_or(0, <[ControlPoint]>::len);
        let points = before as usize..count.saturating_sub(beyond as usize);
        if points.is_empty() {
            return Self { points: 0..count, onward: None };
        }
        Self { points, onward: Some(onward) }
    }

    /// The intervals that begin at its points: where it ends, none does at the last one.
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
