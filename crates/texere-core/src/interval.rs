//! Control intervals: the stretches of a yarn between one control point and the next.

use std::ops::Range;

use glam::Vec3;

use crate::ControlPoint;
use crate::definitions::Segment;

/// The numbers of a yarn's control intervals.
pub(crate) const fn intervals(points: &[ControlPoint], closed: bool) -> Range<usize> {
    0..if closed { points.len() } else { points.len() - 1 }
}

/// The four control points that steer interval number `interval` of a yarn, virtual ends included.
pub(crate) fn window(points: &[ControlPoint], closed: bool, interval: usize) -> [ControlPoint; 4] {
    let count = points.len();
    let mut window = [0, 1, 2, 3].map(|further| points[(interval + count + further - 1) % count]);
    if !closed && interval == 0 {
        window[0] = window[1].reflected(&window[2]);
    }
    if !closed && interval + 2 == count {
        window[3] = window[2].reflected(&window[1]);
    }
    window
}

/// The tangent at a control point.
pub(crate) fn tangent(points: &[ControlPoint], closed: bool, point: usize) -> Vec3 {
    // At control points it is that of any tension.
    let (interval, t) = if !closed && point + 1 == points.len() { (point - 1, 1.0) } else { (point, 0.0) };
    Segment::new(&window(points, closed, interval), 0.5).sample(t).tangent
}
