//! Triangulation of a section, for the caps at a yarn's ends.

use super::SectionPoint;

/// The `n - 2` triangles that fill an outline of `n` points, as numbers of corners,
/// counter-clockwise like the outline.
///
/// The method is ear clipping (Meisters 1975), because lobed sections and some polygons are not
/// convex. The result always has `n - 2` triangles. If rounding leaves no corner that can be cut
/// cleanly, the corner with the best-shaped triangle is cut.
#[must_use]
pub(crate) fn triangulate(outline: &[SectionPoint]) -> Vec<[u32; 3]> {
    let mut left: Vec<u32> = (0..outline.len() as u32).collect();
    let mut triangles = Vec::with_capacity(outline.len().saturating_sub(2));
    while left.len() > 3 {
        let ear = sharpest_ear(outline, &left);
        let count = left.len();
        triangles.push([left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]]);
        left.remove(ear);
    }
    triangles.extend(<[u32; 3]>::try_from(left));
    triangles
}

/// The place in `left` of the corner to cut. Its triangle holds no other corner, and its area
/// divided by its longest side squared is largest, which avoids slivers.
fn sharpest_ear(outline: &[SectionPoint], left: &[u32]) -> usize {
    let count = left.len();
    let at = |place: usize| {
        let point = &outline[left[place % count] as usize];
        [f64::from(point.x), f64::from(point.y)]
    };
    let mut best = (false, f64::NEG_INFINITY, 0);
    for place in 0..count {
        let corners = [at(place + count - 1), at(place), at(place + 1)];
        let area = doubled_area(corners);
        let empty = (0..count)
            .filter(|&other| ![(place + count - 1) % count, place, (place + 1) % count].contains(&other))
            .all(|other| !inside(corners, at(other)));
        let longest =
            (0..3).map(|k| squared(corners[k], corners[(k + 1) % 3])).fold(f64::MIN_POSITIVE, f64::max);
        let candidate = (empty && area > 0.0, area / longest, place);
        if (candidate.0, candidate.1) > (best.0, best.1) {
            best = candidate;
        }
    }
    best.2
}

fn squared(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)
}

fn doubled_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn inside([a, b, c]: [[f64; 2]; 3], point: [f64; 2]) -> bool {
    doubled_area([a, b, point]) >= 0.0
        && doubled_area([b, c, point]) >= 0.0
        && doubled_area([c, a, point]) >= 0.0
}
