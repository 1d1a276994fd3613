//! An oracle for `contacts.rs`: the centreline of a yarn by the polynomials of the Catmull-Rom
//! spline, its bends, and the way downhill from a contact to the nearest approach.

use std::collections::{HashSet, VecDeque};
use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec3, Vec4Swizzles};
use texere_contact::{CLEARANCE_ACCURACY, Contact};
use texere_core::definitions::Segment;
use texere_core::{ControlPoint, Yarns};

/// The four control points that shape an interval.
pub(crate) fn four(points: &[ControlPoint], closed: bool, interval: usize) -> [ControlPoint; 4] {
    let count = points.len() as isize;
    let at = |k: isize| match k {
        -1 if !closed => points[0].reflected(&points[1]),
        _ if !closed && k == count => points[points.len() - 1].reflected(&points[points.len() - 2]),
        _ => points[k.rem_euclid(count) as usize],
    };
    std::array::from_fn(|k| at(interval as isize + k as isize - 1))
}

/// Centreline and radius of a yarn at the place `at`, counted in intervals from its first point, by
/// the Catmull-Rom spline's own polynomials.
pub(crate) fn place(tangle: &Yarns, yarn: usize, at: f64) -> (DVec3, f64) {
    let (points, closed) = (tangle.yarn_points(yarn).unwrap(), tangle.layout().yarns()[yarn].closed);
    let count = points.len() - usize::from(!closed);
    let at = if closed { at.rem_euclid(count as f64) } else { at.clamp(0.0, count as f64) };
    let interval = (at as usize).min(count - 1);
    let t = at - interval as f64;
    let whole = |point: ControlPoint| point.position().as_dvec3().extend(f64::from(point.half_width()));
    let [p, q, r, u] = four(points, closed, interval).map(whole);
    let place = 0.5
        * (2.0 * q + t * ((r - p) + t * ((2.0 * p - 5.0 * q + 4.0 * r - u) + t * (u - p + 3.0 * (q - r)))));
    (place.xyz(), place.w)
}

/// Leads `at` downhill to the nearest place where `ratio` is least. Returns the ratio there.
fn descend(ratio: &impl Fn([f64; 2]) -> f64, at: &mut [f64; 2]) -> f64 {
    let (mut least, mut step) = (ratio(*at), 0.01);
    while step > 1e-7 {
        let tried = (0..16).map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / 16.0).sin_cos();
            [at[0] + step * cos, at[1] + step * sin]
        });
        let best = tried.map(|at| (ratio(at), at)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        if best.0 < least {
            (least, *at) = best;
            step = f64::min(2.0 * step, 0.01);
        } else {
            step /= 2.0;
        }
    }
    least
}

/// A place with a lower ratio than `least`, which is the ratio at `at`, if a way leads there over a
/// rise of less than [`CLEARANCE_ACCURACY`]. The way goes along a lattice whose places lie a 500th
/// of an interval apart, over 5,000 of them at most.
fn over_a_rise(ratio: &impl Fn([f64; 2]) -> f64, at: [f64; 2], least: f64) -> Option<[f64; 2]> {
    let there = |[i, j]: [i32; 2]| [at[0] + f64::from(i) / 500.0, at[1] + f64::from(j) / 500.0];
    let (mut seen, mut left) = (HashSet::from([[0, 0]]), VecDeque::from([[0, 0]]));
    while let Some([i, j]) = left.pop_front().filter(|_| seen.len() < 5000) {
        let beside = (-1..=1).flat_map(|di| (-1..=1).map(move |dj| [i + di, j + dj]));
        for place in beside {
            let here = ratio(there(place));
            if here < least - 1e-9 {
                return Some(there(place));
            }
            if here < least + CLEARANCE_ACCURACY && seen.insert(place) {
                left.push_back(place);
            }
        }
    }
    None
}

/// The ratio at the end of the way downhill in `tangle`, from a contact of a similar tangle. None
/// if the places at the end are so near one another along one yarn that they are no contact, or
/// almost none.
pub(crate) fn downhill(tangle: &Yarns, from: &Contact) -> Option<f64> {
    let [one, other] = from.places.each_ref().map(|place| place.yarn);
    let ratio = |[s, t]: [f64; 2]| {
        let (a, b) = (place(tangle, one, s), place(tangle, other, t));
        a.0.distance(b.0) / (a.1 + b.1)
    };
    let mut at = from.places.each_ref().map(|place| place.interval as f64 + place.t);
    let mut least = descend(&ratio, &mut at);
    // A rise that is lower than the accuracy of a ratio does not make two contacts of one.
    while let Some(lower) = over_a_rise(&ratio, at, least) {
        at = lower;
        least = descend(&ratio, &mut at);
    }
    // Length along the yarn by chords between its points. Around a closed yarn the way has two
    // directions.
    let way = |[s, t]: [f64; 2]| -> f64 {
        let knots = (s as usize + 1..t.ceil() as usize).map(|knot| knot as f64);
        let places: Vec<_> =
            [s].into_iter().chain(knots).chain([t]).map(|at| place(tangle, one, at).0).collect();
        places.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    };
    let [s, t] = if at[0] < at[1] { at } else { [at[1], at[0]] };
    let count = tangle.yarn_points(one).unwrap().len() as f64;
    let window = 1.01 * FRAC_PI_2 * (place(tangle, one, s).1 + place(tangle, other, t).1);
    let closed = tangle.layout().yarns()[one].closed;
    let near = one == other && (way([s, t]) < window || (closed && way([t, s + count]) < window));
    (!near).then_some(least)
}

/// Radius of curvature over the yarn's radius, by the Catmull-Rom spline's own derivatives.
pub(crate) fn bend(points: &[ControlPoint], closed: bool, interval: usize, t: f64) -> f64 {
    let four = four(points, closed, interval);
    let [p, q, r, u] = four.map(|point| point.position().as_dvec3());
    let velocity =
        0.5 * ((r - p) + 2.0 * t * (2.0 * p - 5.0 * q + 4.0 * r - u) + 3.0 * t * t * (u - p + 3.0 * (q - r)));
    let acceleration = (2.0 * p - 5.0 * q + 4.0 * r - u) + 3.0 * t * (u - p + 3.0 * (q - r));
    let radius = f64::from(Segment::new(&four, 0.5).sample(t as f32).half_width);
    velocity.length().powi(3) / velocity.cross(acceleration).length() / radius
}
