//! Yarns that are equal to their mirror image.
//!
//! Loops of plain, rib and garter stitches are symmetrical, and stay so in cloth. Without friction,
//! the least energy of such cloth is often that of loops that all lean to one side, and rounding
//! alone would lead there. The forces of yarns that are symmetrical at the start are therefore made
//! symmetrical.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::RelaxationState;

/// The largest distance of a control point from the mirror image of another, as a share of the
/// radius of its core. With half the value, and with twice, no test is red.
const NEAR: f64 = 1e-3;

/// The most control points of yarns whose mirror image is sought. Each point with the y and z of
/// the first one is tried as the image of the first one. Each try looks up the images of points
/// until one has none.
const POINTS_MAX: usize = 1 << 14;

/// For each control point the number of its mirror image in x, if all have one. `cores` are the
/// radii of cores at all points, mm.
pub(super) fn find(state: &RelaxationState, cores: &[f64]) -> Option<Vec<u32>> {
    let RelaxationState { points, repeat } = state;
    let near = NEAR * cores.iter().copied().fold(f64::INFINITY, f64::min);
    if points.len() > POINTS_MAX || near <= 0.0 {
        return None;
    }
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for (number, point) in (0..).zip(points) {
        cells.entry(cell(within(*point, *repeat), near)).or_default().push(number);
    }
    let image_of = |point: DVec3, core: f64| {
        // Rounding may put a point beyond the edge of the repeat, or into the next cell.
        let around = |axis: usize| {
            let [at, length] = [point[axis], if axis < 2 { repeat[axis] } else { 0.0 }];
            [at - near, at, at + near].map(|at| if length > 0.0 { at.rem_euclid(length) } else { at })
        };
        let [xs, ys, zs] = [0, 1, 2].map(around);
        let places = xs
            .into_iter()
            .flat_map(|x| ys.into_iter().flat_map(move |y| zs.into_iter().map(move |z| DVec3::new(x, y, z))));
        places.filter_map(|place| cells.get(&cell(place, near))).flatten().copied().find(|number| {
            let [found, own] = [points[*number as usize], point];
            cores[*number as usize] == core && apart(found - own, *repeat) <= near
        })
    };
    let (first, own) = (points.first()?, cores.first()?);
    // Only a point with the y and z of the first one can be the mirror image of the first one.
    let level = |(point, core): &(&DVec3, &f64)| {
        *core == own && apart((**point - *first).with_x(0.0), *repeat) <= near
    };
    points.iter().zip(cores).filter(level).find_map(|(point, _)| {
        let middle = first.x + point.x;
        let mirrored =
            |(own, core): (&DVec3, &f64)| image_of(DVec3::new(middle - own.x, own.y, own.z), *core);
        let images: Vec<u32> = points.iter().zip(cores).map(mirrored).collect::<Option<_>>()?;
        let twice = (0..).zip(&images).all(|(own, image)| images[*image as usize] == own);
        twice.then_some(images)
    })
}

fn cell(point: DVec3, size: f64) -> [i64; 3] {
    (point / (4.0 * size)).floor().to_array().map(|cell| cell as i64)
}

/// `point`, moved by whole repeats into the first one.
fn within(point: DVec3, repeat: DVec2) -> DVec3 {
    let wrapped = |at: f64, length: f64| if length > 0.0 { at.rem_euclid(length) } else { at };
    DVec3::new(wrapped(point.x, repeat.x), wrapped(point.y, repeat.y), point.z)
}

/// The largest coordinate of `way`, apart from whole repeats.
fn apart(way: DVec3, repeat: DVec2) -> f64 {
    let rest = |way: f64, length: f64| if length > 0.0 { way - length * (way / length).round() } else { way };
    DVec3::new(rest(way.x, repeat.x), rest(way.y, repeat.y), way.z).abs().max_element()
}
