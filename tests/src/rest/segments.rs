//! Closest points of two segments.

use glam::DVec3;

/// The places of the closest points of two segments, each in \[0, 1\].
///
/// The squared distance is convex. If the inner solution lies outside the unit square, the least is
/// on one of its four edges.
pub(super) fn closest(one: [DVec3; 2], other: [DVec3; 2]) -> (f64, f64) {
    let (along, across, apart) = (one[1] - one[0], other[1] - other[0], one[0] - other[0]);
    let (a, b, c) = (along.length_squared(), along.dot(across), across.length_squared());
    let (d, e) = (along.dot(apart), across.dot(apart));
    let determinant = a * c - b * b;
    if determinant > 1e-12 * a * c {
        let (s, t) = ((b * e - c * d) / determinant, (a * e - b * d) / determinant);
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            return (s, t);
        }
    }
    let ratio = |part: f64, whole: f64| if whole > 0.0 { (part / whole).clamp(0.0, 1.0) } else { 0.0 };
    let edges = [(0.0, ratio(e, c)), (1.0, ratio(e + b, c)), (ratio(-d, a), 0.0), (ratio(b - d, a), 1.0)];
    let distance = |(s, t): (f64, f64)| (apart + along * s - across * t).length_squared();
    edges.into_iter().min_by(|&one, &other| distance(one).total_cmp(&distance(other))).unwrap_or_default()
}
