//! The judge: it finds the nearest of all triangles by arithmetic of its own.

use rayon::prelude::*;
use texere_core::backend::Plan;
use texere_core::{End, Mesh, MeshPlace, Pipeline, Ray, Settings, Yarns};
use texere_cpu::{Hit, Picker, SerialBackend};

/// Tolerance of the distance of a hit, as a share of the distance, or of the triangle's size if
/// that is larger. The judge's own arithmetic is no more accurate.
pub(crate) const SAME: f64 = 1e-9;

/// The largest share of rays that may meet an edge, where rounding decides what they hit.
pub(crate) const EDGES: f64 = 2e-3;

/// Pseudo-random numbers, the same on every run (splitmix64).
#[derive(Clone, Copy)]
pub(crate) struct Chance(pub(crate) u64);

impl Chance {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }
}

pub(crate) fn sum(a: [f64; 3], b: [f64; 3], times: f64) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] + times * b[axis])
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let (next, after) = ((k + 1) % 3, (k + 2) % 3);
        a[next] * b[after] - a[after] * b[next]
    })
}

pub(crate) type Triangle = ([[f64; 3]; 3], MeshPlace);

/// All triangles of a mesh with their places.
pub(crate) fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let corner = |index: u64| mesh.vertices[index as usize].position.map(f64::from);
    let places = mesh.chunks.iter().flat_map(|chunk| {
        (0..chunk.indices() / 3).filter_map(|triangle| mesh.plan.place_of_triangle(chunk, triangle))
    });
    let all: Vec<_> = mesh.triangles().map(|triangle| triangle.map(corner)).zip(places).collect();
    assert_eq!(all.len() as u64, mesh.plan.counts().triangles);
    all
}

pub(crate) fn mesh_of(yarns: &Yarns, settings: Settings) -> Mesh {
    Pipeline::new(yarns).settings(settings).mesh(&SerialBackend::new()).unwrap()
}

/// The distance, in lengths of the ray's direction, at which the ray meets a triangle (Möller and
/// Trumbore 1997). The triangle's edges are moved out by `slack`, a share of its size.
pub(crate) fn meets(ray: &Ray, [a, b, c]: &[[f64; 3]; 3], slack: f64) -> Option<f64> {
    let (one, other) = (sum(*b, *a, -1.0), sum(*c, *a, -1.0));
    let across = cross(ray.direction, other);
    let scale = dot(one, across);
    if scale == 0.0 {
        return None;
    }
    let from = sum(ray.origin, *a, -1.0);
    let u = dot(from, across) / scale;
    let aslant = cross(from, one);
    let v = dot(ray.direction, aslant) / scale;
    let along = dot(other, aslant) / scale;
    (u >= -slack && v >= -slack && u + v <= 1.0 + slack && along >= 0.0).then_some(along)
}

/// The number of triangles in one ball of [`balls`].
const IN_BALL: usize = 32;

/// The middle and the radius of a ball round every [`IN_BALL`] triangles in a row.
pub(crate) fn balls(all: &[Triangle]) -> Vec<([f64; 3], f64)> {
    let ball = |triangles: &[Triangle]| {
        let corners = || triangles.iter().flat_map(|(corners, _)| corners);
        let count = corners().count() as f64;
        let middle = corners().fold([0.0; 3], |middle, corner| sum(middle, *corner, 1.0 / count));
        let away = |corner: &[f64; 3]| sum(*corner, middle, -1.0);
        (middle, corners().map(|corner| dot(away(corner), away(corner))).fold(0.0, f64::max).sqrt())
    };
    all.chunks(IN_BALL).map(ball).collect()
}

/// The distance and the place of the nearest of all triangles, and the length of its longest edge.
/// Both lengths are in lengths of the ray's direction. A triangle is left out if the ray's line
/// passes its ball by more than a millionth of the sum of the ball's radius and distance. That is a
/// thousand times the largest slack with which [`compare`] calls this function.
pub(crate) fn nearest(
    ray: &Ray,
    all: &[Triangle],
    balls: &[([f64; 3], f64)],
    slack: f64,
) -> Option<(f64, MeshPlace, f64)> {
    assert_eq!(balls.len(), all.len().div_ceil(IN_BALL));
    let length = dot(ray.direction, ray.direction).sqrt();
    let close = |&(middle, radius): &([f64; 3], f64)| {
        let from = sum(middle, ray.origin, -1.0);
        let off = cross(from, ray.direction);
        dot(off, off).sqrt() <= (radius + 1e-6 * (radius + dot(from, from).sqrt())) * length
    };
    let near = all.chunks(IN_BALL).zip(balls).filter(|(_, ball)| close(ball)).flat_map(|(all, _)| all);
    let hits = near.filter_map(|(corners, place)| Some((meets(ray, corners, slack)?, *place, corners)));
    let (distance, place, [a, b, c]) = hits.min_by(|one, other| one.0.total_cmp(&other.0))?;
    let edges = [(a, b), (b, c), (c, a)].map(|(one, other)| sum(*one, *other, -1.0));
    let longest = edges.iter().map(|edge| dot(*edge, *edge)).fold(0.0, f64::max);
    Some((distance, place, (longest / dot(ray.direction, ray.direction)).sqrt()))
}

/// A ray towards a place on the cloth or near it.
pub(crate) fn ray(all: &[Triangle], chance: &mut Chance) -> Ray {
    let (corners, _) = &all[chance.below(all.len())];
    let (u, v) = (chance.within(-0.5, 1.5), chance.within(-0.5, 1.5));
    let [one, other] = [1, 2].map(|corner| sum(corners[corner], corners[0], -1.0));
    let target = sum(sum(corners[0], one, u), other, v);
    let slanted = std::array::from_fn(|_| chance.within(-1.0, 1.0));
    let direction = match chance.below(4) {
        0 => [0.0, 0.0, -1.0],
        1 => sum([0.0; 3], slanted, 1e3),
        _ => slanted,
    };
    let back = chance.within(0.1, 30.0) / dot(direction, direction).sqrt();
    Ray { origin: sum(target, direction, -back), direction }
}

pub(crate) fn near(one: f64, other: f64, size: f64) -> bool {
    (one - other).abs() <= SAME * one.abs().max(other.abs()).max(size)
}

/// Shoots `rays` rays, and compares each hit with the nearest of all triangles. Returns the number
/// of hits at edges.
pub(crate) fn compare(picker: &Picker, mesh: &Mesh, rays: usize, seed: u64) -> usize {
    let all = triangles(mesh);
    let balls = balls(&all);
    let tried = (0..rays).into_par_iter().map(|number| {
        let mut chance = Chance(seed ^ (number as u64) << 20);
        let ray = ray(&all, &mut chance);
        let (hit, truth) = (picker.pick(&ray), nearest(&ray, &all, &balls, 0.0));
        if let (Some(hit), Some((distance, place, size))) = (hit, truth)
            && near(hit.distance, distance, size)
            && hit.place == place
        {
            sound(picker.plan(), &ray, &hit);
            return [1, 0];
        }
        if hit.is_none() && truth.is_none() {
            return [0, 0];
        }
        // At an edge either triangle may be hit. The judge or the picker alone may also miss both,
        // and hit a triangle behind them.
        let found = hit.map_or(f64::INFINITY, |hit| hit.distance);
        let nowhere = (f64::INFINITY, MeshPlace { yarn: 0, ring: 0, side: 0, cap: None }, 0.0);
        let [wide, narrow] = [1e-9, -1e-9].map(|slack| nearest(&ray, &all, &balls, slack).unwrap_or(nowhere));
        let between = (found >= wide.0 || near(found, wide.0, wide.2))
            && (found <= narrow.0 || near(found, narrow.0, narrow.2));
        assert!(between, "{ray:?}: {hit:?} instead of {truth:?}");
        [1, 1]
    });
    let [hits, edges] = tried.reduce(|| [0, 0], |one, other| [one[0] + other[0], one[1] + other[1]]);
    assert!(hits > rays / 3, "only {hits} of {rays} rays hit anything");
    edges
}

/// Checks the values of a hit other than its distance.
pub(crate) fn sound(plan: &Plan, ray: &Ray, hit: &Hit) {
    let point = sum(ray.origin, ray.direction, hit.distance);
    let off = sum(hit.position, point, -1.0);
    let far = dot(point, point).sqrt() + hit.distance * dot(ray.direction, ray.direction).sqrt();
    assert!(dot(off, off).sqrt() <= 1e-9 * far, "{hit:?} is not at {point:?}");
    let (interval, from) = plan.interval(hit.place.ring);
    let along = f64::from(hit.interval) - f64::from(interval) + hit.t - f64::from(from);
    let step = 1.0 / f64::from(plan.settings().subdivisions + 1);
    match hit.place.cap {
        Some(End::Start) => assert_eq!((hit.interval, hit.t), (0, 0.0)),
        Some(End::Finish) => assert_eq!((hit.interval + 1, hit.t), (interval, 1.0)),
        None => assert!(along >= -1e-6 && along <= step + 1e-6, "{hit:?}, {along} after {from}"),
    }
}

pub(crate) fn picker_of(mesh: &Mesh, yarns: &Yarns) -> Picker {
    Picker::new(mesh.plan.clone(), yarns.points()).unwrap()
}
