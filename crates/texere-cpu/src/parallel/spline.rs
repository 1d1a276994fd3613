//! The spline in lanes: the cubics of consecutive intervals, and the places of rings on them.

use texere_core::backend::Plan;
use texere_core::definitions::{NO_LENGTH, RADIUS_FLOOR, SLOPE_LIMIT, ZERO_VELOCITY};

use super::simd::{Floats, Integers, LANES_MAX, Mask, Simd, dot};

/// The places of a vector of consecutive rings on their cubics: for each ring its interval, counted
/// from the first ring's, and its parameter.
#[derive(Debug)]
pub(super) struct Seats {
    pub(super) interval: [u32; LANES_MAX],
    pub(super) t: [f32; LANES_MAX],
}

impl Seats {
    /// The seats of a vector, for each place in an interval at which its first ring can lie.
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
    /// Position and half height at t = 0.
    start: [S::Floats; 4],
    /// Position at t = 1, relative to the start.
    span: [S::Floats; 3],
    /// The coefficients of t, t² and t³.
    terms: [[S::Floats; 4]; 3],
    /// The largest square of a velocity that counts as standing still.
    at_rest: S::Floats,
    /// The least half height.
    floor: S::Floats,
    /// The cubics of half widths. They have no meaning for a round yarn, whose half width is its
    /// half height.
    pub(super) half_width: Widths<S>,
}

/// The spline at the places of rings, a ring in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sampled<S: Simd> {
    pub(super) start: [S::Floats; 4],
    /// Position and half height relative to the interval's start.
    pub(super) offset: [S::Floats; 4],
    /// The derivative of `offset` by t.
    pub(super) velocity: [S::Floats; 4],
    pub(super) span: [S::Floats; 3],
    pub(super) at_rest: S::Floats,
    pub(super) floor: S::Floats,
}

impl<S: Simd> Cubics<S> {
    /// The cubics of the intervals from number `first` on. Interval j reads the padded points from
    /// number j on.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new<const FLATTENED: bool>(simd: S, points: &[[f32; 4]], first: usize, s: f32) -> Self {
        let [mut before, mut start, mut end, mut after] = neighbours(simd, points, first);
        let half_width = if FLATTENED {
            Widths::new(simd, sizes(simd, low_halves(before[3]), low_halves(after[3])), s)
        } else {
            Widths { start: start[3], terms: [start[3]; 3], floor: start[3] }
        };
        [before[3], start[3], end[3], after[3]] = sizes(simd, before[3], after[3]);
        let zero = simd.splat(0.0);
        let (mut a, mut b, mut c) = ([zero; 4], [zero; 4], [zero; 4]);
        let mut terms = [[zero; 4]; 3];
        for k in 0..4 {
            a[k] = before[k] - start[k];
            b[k] = end[k] - start[k];
            c[k] = after[k] - start[k];
            [terms[0][k], terms[1][k], terms[2][k]] = coefficients(simd, a[k], b[k], c[k], s);
        }
        let ([a, b, c], least) = ([xyz(a), xyz(b), xyz(c)], start[3].min(end[3]));
        Self {
            start,
            span: b,
            terms,
            at_rest: (simd.splat(ZERO_VELOCITY) * (dot(a, a) + dot(b, b) + dot(c, c)))
                .max(simd.splat(NO_LENGTH)),
            floor: least * simd.splat(RADIUS_FLOOR),
            half_width,
        }
    }

    /// The spline at `t` of each lane's interval, which is number `interval` of these cubics.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn sample(&self, simd: S, interval: S::Integers, t: S::Floats) -> Sampled<S> {
        let zero = simd.splat(0.0);
        let (mut start, mut offset, mut velocity) = ([zero; 4], [zero; 4], [zero; 4]);
        for k in 0..4 {
            let terms = [self.terms[0][k], self.terms[1][k], self.terms[2][k]];
            start[k] = self.start[k].permute(interval);
            (offset[k], velocity[k]) = cubic(simd, terms, interval, t);
        }
        let [x, y, z] = self.span;
        let span = [x.permute(interval), y.permute(interval), z.permute(interval)];
        let (at_rest, floor) = (self.at_rest.permute(interval), self.floor.permute(interval));
        Sampled { start, offset, velocity, span, at_rest, floor }
    }
}

/// The coefficients of `Size` in the core for half widths, an interval in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Widths<S: Simd> {
    start: S::Floats,
    terms: [S::Floats; 3],
    floor: S::Floats,
}

impl<S: Simd> Widths<S> {
    #[cfg_attr(optimized, inline(always))]
    fn new(simd: S, [before, start, end, after]: [S::Floats; 4], s: f32) -> Self {
        let terms = coefficients(simd, before - start, end - start, after - start, s);
        Self { start, terms, floor: start.min(end) * simd.splat(RADIUS_FLOOR) }
    }

    /// The size at `t` of each lane's interval, and its growth along the yarn. `inverse` is one
    /// over the speed.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn sample(
        &self,
        simd: S,
        interval: S::Integers,
        t: S::Floats,
        inverse: S::Floats,
    ) -> (S::Floats, S::Floats) {
        let (offset, velocity) = cubic(simd, self.terms, interval, t);
        let (size, floor) = (self.start.permute(interval) + offset, self.floor.permute(interval));
        held_size(simd, size, floor, velocity * inverse)
    }
}

/// A size and its growth, with both limits applied. A size below `floor` is held at `floor`, and
/// does not grow. Any other size grows or shrinks by [`SLOPE_LIMIT`] at most.
#[cfg_attr(optimized, inline(always))]
pub(super) fn held_size<S: Simd>(
    simd: S,
    size: S::Floats,
    floor: S::Floats,
    growth: S::Floats,
) -> (S::Floats, S::Floats) {
    let limit = simd.splat(SLOPE_LIMIT);
    let held = size.less(floor);
    (held.select(floor, size), held.select(simd.splat(0.0), growth.max(-limit).min(limit)))
}

/// The coefficients of t, t² and t³ between a point and the next. Relative to the point, `a` is the
/// point before, `b` is the next, and `c` is the one after the next.
#[cfg_attr(optimized, inline(always))]
fn coefficients<S: Simd>(simd: S, a: S::Floats, b: S::Floats, c: S::Floats, s: f32) -> [S::Floats; 3] {
    let (doubled, rest, less) = (simd.splat(2.0 * s), simd.splat(3.0 - 2.0 * s), simd.splat(s - 2.0));
    let s = simd.splat(s);
    [(b - a) * s, a * doubled + b * rest - c * s, (c - a) * s + b * less]
}

/// A cubic without its constant term, and its derivative, at `t` of each lane's interval.
#[cfg_attr(optimized, inline(always))]
fn cubic<S: Simd>(
    simd: S,
    [c1, c2, c3]: [S::Floats; 3],
    interval: S::Integers,
    t: S::Floats,
) -> (S::Floats, S::Floats) {
    let (c1, c2, c3) = (c1.permute(interval), c2.permute(interval), c3.permute(interval));
    let value = (c1 + (c2 + c3 * t) * t) * t;
    (value, c1 + (c2 * simd.splat(2.0) + c3 * (simd.splat(3.0) * t)) * t)
}

/// Each lane's low 16 bits, moved to the high ones.
#[cfg_attr(optimized, inline(always))]
fn low_halves<F: Floats<Integers: Integers<Floats = F>>>(halves: F) -> F {
    halves.to_bits().shift_left::<16>().bit_cast()
}

/// The sizes at an interval's four points. They are half floats in the high 16 bits of `before` and
/// `after`. Only these two vectors are converted. The sizes at the two points between are taken
/// from other lanes of `before` and `after`.
#[cfg_attr(optimized, inline(always))]
fn sizes<S: Simd>(simd: S, before: S::Floats, after: S::Floats) -> [S::Floats; 4] {
    let (before, after) = (from_half(simd, before), from_half(simd, after));
    let mut sizes = [0.0; LANES_MAX + 3];
    before.store(&mut sizes);
    after.store(&mut sizes[3..]);
    [before, simd.load(&sizes[1..]), simd.load(&sizes[2..]), after]
}

/// The half floats in the lanes' high 16 bits, converted exactly. They are neither NaN nor
/// infinite.
#[cfg_attr(optimized, inline(always))]
fn from_half<S: Simd>(simd: S, half: S::Floats) -> S::Floats {
    /// Two to the difference of the exponents' biases.
    const BIAS: f32 = (1u128 << 112) as f32;
    /// The bits that a float has in common with a half float.
    const SIGN_AND_SIZE: u32 = 0x8fff_e000;
    // Exponent and fraction are moved to their places in a float. A subnormal half float gives a
    // subnormal float, which the multiplication makes normal.
    half.to_bits().shift_right_signed::<3>().masked(SIGN_AND_SIZE).bit_cast() * simd.splat(BIAS)
}

/// The first three components.
#[cfg_attr(optimized, inline(always))]
pub(super) fn xyz<F: Floats>([x, y, z, _]: [F; 4]) -> [F; 3] {
    [x, y, z]
}

/// Whether none of `points` is flattened.
#[cfg_attr(optimized, inline(always))]
pub(super) fn all_round(points: &[[f32; 4]]) -> bool {
    let mut apart = 0;
    for [_, _, _, sizes] in points {
        apart |= sizes.to_bits() ^ sizes.to_bits().rotate_left(16);
    }
    apart == 0
}

/// Four vectors of points, with a point in each lane. The first has the points from number `first`
/// on, and each of the others begins one point later.
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

/// The points from number `first` on, followed by zeros.
#[cold]
fn last_points(points: &[[f32; 4]], first: usize) -> [[f32; 4]; LANES_MAX + 3] {
    let mut window = [[0.0; 4]; LANES_MAX + 3];
    for (point, left) in window.iter_mut().zip(points.iter().skip(first)) {
        *point = *left;
    }
    window
}
