//! The spline in lanes: the cubics of consecutive intervals, and where on them rings lie.

use texere_core::{NO_LENGTH, Plan, RADIUS_FLOOR, SLOPE_LIMIT, ZERO_VELOCITY};

use super::simd::{Floats, Integers, LANES_MAX, Mask, Simd, difference, dot};

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
    /// Position at t = 0.
    start: [S::Floats; 3],
    /// Position at t = 1, relative to the start.
    span: [S::Floats; 3],
    /// What goes with t, t² and t³.
    terms: [[S::Floats; 3]; 3],
    /// A squared velocity that counts as none.
    at_rest: S::Floats,
    pub(super) half_width: Sizes<S>,
    pub(super) half_height: Sizes<S>,
}

/// The positions of rings, a ring in each lane, at its own parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sampled<S: Simd> {
    pub(super) start: [S::Floats; 3],
    /// From the start, and the derivative there.
    pub(super) offset: [S::Floats; 3],
    pub(super) velocity: [S::Floats; 3],
    pub(super) span: [S::Floats; 3],
    pub(super) at_rest: S::Floats,
}

impl<S: Simd> Cubics<S> {
    /// The cubics of the intervals from number `first` on; interval j reads the padded points from number j on. Without
    /// `FLATTENED` half widths are half heights.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new<const FLATTENED: bool>(simd: S, points: &[[f32; 4]], first: usize, s: f32) -> Self {
        let points = neighbours(simd, points, first);
        let [before, start, end, after] = [xyz(points[0]), xyz(points[1]), xyz(points[2]), xyz(points[3])];
        let (a, b, c) = (difference(before, start), difference(end, start), difference(after, start));
        let mut terms = [[simd.splat(0.0); 3]; 3];
        for axis in 0..3 {
            let [c1, c2, c3] = coefficients(simd, a[axis], b[axis], c[axis], s);
            (terms[0][axis], terms[1][axis], terms[2][axis]) = (c1, c2, c3);
        }
        let half_height = Sizes::new(simd, [points[0][3], points[3][3]], s);
        Self {
            start,
            span: b,
            terms,
            at_rest: (simd.splat(ZERO_VELOCITY) * (dot(a, a) + dot(b, b) + dot(c, c)))
                .max(simd.splat(NO_LENGTH)),
            half_width: if FLATTENED {
                Sizes::new(simd, low_halves([points[0][3], points[3][3]]), s)
            } else {
                half_height
            },
            half_height,
        }
    }

    /// The spline at `t` of each lane's interval, which is number `interval` of these.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn sample(&self, simd: S, interval: S::Integers, t: S::Floats) -> Sampled<S> {
        let zero = simd.splat(0.0);
        let (mut start, mut span) = ([zero; 3], [zero; 3]);
        let (mut offset, mut velocity) = ([zero; 3], [zero; 3]);
        for axis in 0..3 {
            start[axis] = self.start[axis].permute(interval);
            span[axis] = self.span[axis].permute(interval);
            let terms = [self.terms[0][axis], self.terms[1][axis], self.terms[2][axis]];
            (offset[axis], velocity[axis]) = cubic(simd, terms, interval, t);
        }
        Sampled { start, offset, velocity, span, at_rest: self.at_rest.permute(interval) }
    }
}

/// The coefficients of `Size` in the core, an interval in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sizes<S: Simd> {
    /// At t = 0.
    start: S::Floats,
    /// What goes with t, t² and t³.
    terms: [S::Floats; 3],
    /// The least size.
    floor: S::Floats,
}

impl<S: Simd> Sizes<S> {
    /// From the half floats in the high 16 bits of the points from a first one on, and of those from the next but two on.
    #[cfg_attr(optimized, inline(always))]
    fn new(simd: S, [before, after]: [S::Floats; 2], s: f32) -> Self {
        let (before, after) = (from_half(simd, before), from_half(simd, after));
        let mut sizes = [0.0; LANES_MAX + 3];
        before.store(&mut sizes);
        after.store(&mut sizes[3..]);
        let (start, end) = (simd.load(&sizes[1..]), simd.load(&sizes[2..]));
        let terms = coefficients(simd, before - start, end - start, after - start, s);
        Self { start, terms, floor: start.min(end) * simd.splat(RADIUS_FLOOR) }
    }

    /// The size at `t` of each lane's interval, and its growth along the yarn, where `inverse` is one over the speed.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn sample(
        &self,
        simd: S,
        interval: S::Integers,
        t: S::Floats,
        inverse: S::Floats,
    ) -> (S::Floats, S::Floats) {
        let (offset, velocity) = cubic(simd, self.terms, interval, t);
        let limit = simd.splat(SLOPE_LIMIT);
        let growth = (velocity * inverse).max(-limit).min(limit);
        let (size, floor) = (self.start.permute(interval) + offset, self.floor.permute(interval));
        let held = size.less(floor);
        (held.select(floor, size), held.select(simd.splat(0.0), growth))
    }
}

/// What goes with t, t² and t³ between a point and the next, at `b` from it, with the one before at `a` and the one after
/// next at `c`.
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

/// The low 16 bits of each lane, where the high ones were.
#[cfg_attr(optimized, inline(always))]
fn low_halves<F: Floats<Integers: Integers<Floats = F>>>([before, after]: [F; 2]) -> [F; 2] {
    [before.to_bits().shift_left::<16>().bit_cast(), after.to_bits().shift_left::<16>().bit_cast()]
}

/// The half floats in the lanes' high 16 bits, exactly; they are neither NaN nor infinite.
#[cfg_attr(optimized, inline(always))]
fn from_half<S: Simd>(simd: S, half: S::Floats) -> S::Floats {
    /// By how much a float's exponent is counted from further down.
    const BIAS: f32 = (1u128 << 112) as f32;
    /// The bits of a float that a half has, too.
    const SIGN_AND_SIZE: u32 = 0x8fff_e000;
    // Exponent and fraction where a float has them. Halves that are subnormal are so here, too, until they are multiplied.
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
