//! The spline in lanes: the cubics of consecutive intervals, and where on them rings lie.

use texere_core::{NO_LENGTH, Plan, RADIUS_FLOOR, ZERO_VELOCITY};

use super::simd::{Floats, LANES_MAX, Simd, dot};

/// Where on their cubics a vector of consecutive rings lies: each one's interval, counted from the first one's, and its
/// parameter.
#[derive(Debug)]
pub(super) struct Seats {
    pub(super) interval: [u32; LANES_MAX],
    pub(super) t: [f32; LANES_MAX],
}

impl Seats {
    /// Those for each place in an interval at which a vector's first ring can lie.
    pub(super) fn at_each_place(plan: &Plan) -> Vec<Self> {
        let (per_interval, step) = (plan.settings().subdivisions + 1, plan.sampling().step());
        let seats = |place: u32| Self {
            interval: std::array::from_fn(|lane| (place + lane as u32) / per_interval),
            t: std::array::from_fn(|lane| ((place + lane as u32) % per_interval) as f32 * step),
        };
        (0..per_interval).map(seats).collect()
    }
}

/// The coefficients of `Segment` in the core, an interval in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubics<S: Simd> {
    /// Position and radius at t = 0.
    start: [S::Floats; 4],
    /// Position at t = 1, relative to the start.
    span: [S::Floats; 3],
    /// What goes with t, t² and t³.
    terms: [[S::Floats; 4]; 3],
    /// A squared velocity that counts as none.
    at_rest: S::Floats,
    /// The least radius.
    floor: S::Floats,
}

/// The cubics of rings, a ring in each lane, at its own parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sampled<S: Simd> {
    pub(super) start: [S::Floats; 4],
    /// From the start, and the derivative there: position and radius.
    pub(super) offset: [S::Floats; 4],
    pub(super) velocity: [S::Floats; 4],
    pub(super) span: [S::Floats; 3],
    pub(super) at_rest: S::Floats,
    pub(super) floor: S::Floats,
}

impl<S: Simd> Cubics<S> {
    /// The cubics of the intervals from number `first` on; interval j reads the padded points from number j on.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, points: &[[f32; 4]], first: usize, s: f32) -> Self {
        let [before, start, end, after] = neighbours(simd, points, first);
        let (doubled, rest, less) = (simd.splat(2.0 * s), simd.splat(3.0 - 2.0 * s), simd.splat(s - 2.0));
        let (s, zero) = (simd.splat(s), simd.splat(0.0));
        let (mut a, mut b, mut c) = ([zero; 4], [zero; 4], [zero; 4]);
        let mut terms = [[zero; 4]; 3];
        for k in 0..4 {
            a[k] = before[k] - start[k];
            b[k] = end[k] - start[k];
            c[k] = after[k] - start[k];
            terms[0][k] = (b[k] - a[k]) * s;
            terms[1][k] = a[k] * doubled + b[k] * rest - c[k] * s;
            terms[2][k] = (c[k] - a[k]) * s + b[k] * less;
        }
        let ([a, b, c], radii) = ([xyz(a), xyz(b), xyz(c)], start[3].min(end[3]));
        Self {
            start,
            span: b,
            terms,
            at_rest: (simd.splat(ZERO_VELOCITY) * (dot(a, a) + dot(b, b) + dot(c, c)))
                .max(simd.splat(NO_LENGTH)),
            floor: radii * simd.splat(RADIUS_FLOOR),
        }
    }

    /// The spline at `t` of each lane's interval, which is number `interval` of these.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn sample(&self, simd: S, interval: S::Integers, t: S::Floats) -> Sampled<S> {
        let zero = simd.splat(0.0);
        let thrice = simd.splat(3.0) * t;
        let (mut start, mut offset, mut velocity) = ([zero; 4], [zero; 4], [zero; 4]);
        for k in 0..4 {
            let c1 = self.terms[0][k].permute(interval);
            let c2 = self.terms[1][k].permute(interval);
            let c3 = self.terms[2][k].permute(interval);
            start[k] = self.start[k].permute(interval);
            offset[k] = (c1 + (c2 + c3 * t) * t) * t;
            velocity[k] = c1 + (c2 * simd.splat(2.0) + c3 * thrice) * t;
        }
        let [x, y, z] = self.span;
        let span = [x.permute(interval), y.permute(interval), z.permute(interval)];
        let (at_rest, floor) = (self.at_rest.permute(interval), self.floor.permute(interval));
        Sampled { start, offset, velocity, span, at_rest, floor }
    }
}

/// The first three components.
#[cfg_attr(optimized, inline(always))]
pub(super) fn xyz<F: Floats>([x, y, z, _]: [F; 4]) -> [F; 3] {
    [x, y, z]
}

/// The points from number `first` on, one in each lane, and those from the next three numbers on.
#[cfg_attr(optimized, inline(always))]
pub(super) fn neighbours<S: Simd>(simd: S, points: &[[f32; 4]], first: usize) -> [[S::Floats; 4]; 4] {
    let last;
    let window = match points.get(first..first + S::LANES + 3) {
        Some(window) => window,
        None => {
            last = last_points(points, first);
            &last[..S::LANES + 3]
        }
    };
    [
        simd.components(window),
        simd.components(&window[1..]),
        simd.components(&window[2..]),
        simd.components(&window[3..]),
    ]
}

/// The points from number `first` on, and zeros past the last one.
#[cold]
fn last_points(points: &[[f32; 4]], first: usize) -> [[f32; 4]; LANES_MAX + 3] {
    let mut window = [[0.0; 4]; LANES_MAX + 3];
    for (point, left) in window.iter_mut().zip(points.iter().skip(first)) {
        *point = *left;
    }
    window
}
