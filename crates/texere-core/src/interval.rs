//! Control intervals: the stretches of a yarn between two neighbouring control points.

use std::ops::Range;

use glam::Vec3;

use crate::ControlPoint;
use crate::definitions::Segment;

/// The numbers of a yarn's control intervals.
pub(crate) const fn intervals(points: &[ControlPoint], closed: bool) -> Range<usize> {
    0..if closed { points.len() } else { points.len() - 1 }
}

/// The four control points that define interval `interval`. Beyond the ends of an open yarn they
/// are the paper's virtual ends.
#[inline]
pub fn neighbours(points: &[ControlPoint], closed: bool, interval: usize) -> [ControlPoint; 4] {
    if let Some(&[before, start, end, after]) = points.get(interval.wrapping_sub(1)..interval.wrapping_add(3))
    {
        return [before, start, end, after];
    }
    let count = points.len();
    let at = |index: usize| points[index % count];
    let (start, end) = (at(interval), at(interval + 1));
    let before = if closed || interval > 0 { at(interval + count - 1) } else { start.reflected(&end) };
    let after = if closed || interval + 2 < count { at(interval + 2) } else { end.reflected(&start) };
    [before, start, end, after]
}

/// The unit tangent at control point `point`.
pub(crate) fn tangent(points: &[ControlPoint], closed: bool, point: usize) -> Vec3 {
    // At control points the tangent does not depend on the tension.
    let (interval, t) = if !closed && point + 1 == points.len() { (point - 1, 1.0) } else { (point, 0.0) };
    Segment::new(&neighbours(points, closed, interval), 0.5).sample(t).tangent
}
