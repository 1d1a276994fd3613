//! The spline at places of an interval, as sums of its four control points.

use std::ops::{AddAssign, Mul, SubAssign};

use glam::DVec3;

/// The nodes of Gauss's rule with three nodes on \[0, 1\], and their weights.
pub(super) const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// A place of an interval: the weights of the four control points in the position and in both
/// derivatives by u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    /// The weights in the position. Their sum is 1.
    pub(super) position: [f64; 4],
    /// The weights in the first derivative. Their sum is 0.
    pub(super) velocity: [f64; 4],
    /// The weights in the second derivative. Their sum is 0.
    pub(super) acceleration: [f64; 4],
}

impl Node {
    /// The place `u`, 0 to 1, with `s = (1 - tension) / 2`.
    pub(super) fn new(u: f64, s: f64) -> Self {
        // The values, or a derivative, of u, u² and u³, and of the constant 1.
        let weights = |[one, linear, square, cube]: [f64; 4]| {
            let before = (2.0 * square - linear - cube) * s;
            let after = (cube - square) * s;
            let end = s * linear + (3.0 - 2.0 * s) * square + (s - 2.0) * cube;
            [before, one - before - end - after, end, after]
        };
        Self {
            position: weights([1.0, u, u * u, u * u * u]),
            velocity: weights([0.0, 1.0, 2.0 * u, 3.0 * u * u]),
            acceleration: weights([0.0, 0.0, 2.0, 6.0 * u]),
        }
    }
}

/// The sum of four control points times their weights.
#[inline]
pub(super) fn blend(weights: &[f64; 4], points: &[DVec3; 4]) -> DVec3 {
    points[0] * weights[0] + points[1] * weights[1] + points[2] * weights[2] + points[3] * weights[3]
}

/// Values of an interval's four control points, such as weights or slopes. The values of virtual
/// ends are moved to the points that these ends are computed from. `opens` says whether the
/// interval is the first of an open yarn, and `ends` whether it is the last.
pub(super) fn folded<T>(mut four: [T; 4], [opens, ends]: [bool; 2]) -> [T; 4]
where
    T: Copy + Default + AddAssign + SubAssign + Mul<f64, Output = T>,
{
    let [before, start, end, after] = &mut four;
    if opens {
        *start += *before * 2.0;
        *end -= std::mem::take(before);
    }
    if ends {
        *end += *after * 2.0;
        *start -= std::mem::take(after);
    }
    four
}
