//! The part of a yarn that counts for the cloth.

use std::ops::Range;

use texere_contact::{part_length_mm, round_length_mm};
use texere_core::{ControlPoint, Yarns};

/// The part of a yarn that counts for the cloth. The rest of the yarn lies beyond the cloth. Its
/// length depends on where a sample is cut off.
#[derive(Debug, Clone)]
pub(crate) struct Own {
    /// The range of the part's control points.
    pub(crate) points: Range<usize>,
    /// For a yarn that repeats without end, the vector (x and y, mm) from this round of the yarn to
    /// the next one. After the last point of the part comes the first point of the next round.
    pub(crate) onward: Option<[f64; 2]>,
}

impl Own {
    /// The part of a yarn that repeats without end: all its points except `before` points at its
    /// beginning and `beyond` points at its end. If no point is left, the part is the whole yarn,
    /// taken as a yarn that ends.
    pub(crate) fn round(yarns: &Yarns, yarn: usize, [before, beyond]: [u32; 2], onward: [f64; 2]) -> Self {
        let count = yarns.yarn_points(yarn).map_or(0, <[ControlPoint]>::len);
        let points = before as usize..count.saturating_sub(beyond as usize);
        if points.is_empty() {
            return Self { points: 0..count, onward: None };
        }
        Self { points, onward: Some(onward) }
    }

    /// The intervals of the part, by the numbers of their first points. If the yarn ends, no
    /// interval begins at its last point.
    pub(crate) fn intervals(&self) -> Range<usize> {
        let Range { start, end } = self.points;
        start..end.saturating_sub(usize::from(self.onward.is_none()))
    }

    /// Length of the part, mm.
    pub(crate) fn length_mm(&self, yarns: &Yarns, yarn: usize) -> f64 {
        let points = yarns.yarn_points(yarn).unwrap_or(&[]);
        match self.onward {
            Some(onward) => round_length_mm(&points[self.points.clone()], onward, yarns.tension()),
            None => part_length_mm(points, self.points.clone(), yarns.tension()),
        }
    }
}
