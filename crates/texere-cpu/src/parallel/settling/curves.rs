//! Intervals in lanes.

use super::tables::IntervalRow;
use crate::parallel::simd::{Floats, Mask, Simd, dot, plus, scale, to_bits};

/// A vector of intervals.
#[derive(Clone, Copy)]
pub(super) struct Curve<S: Simd> {
    pub(super) start: [S::Integers; 3],
    pub(super) terms: [[S::Floats; 3]; 3],
    /// Half width and half height at the beginning, and the growth of each along the interval, mm.
    pub(super) halves: [[S::Floats; 2]; 2],
}

impl<S: Simd> Curve<S> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, intervals: &[IntervalRow], numbers: &[u32]) -> Self {
        let intervals: &[[[f32; 4]; 4]] = bytemuck::cast_slice(intervals);
        let [x, y, z, width_growth] = simd.rows(intervals, numbers, 0);
        let [a, b, c, width] = simd.rows(intervals, numbers, 1);
        let [d, e, f, height] = simd.rows(intervals, numbers, 2);
        let [g, h, i, height_growth] = simd.rows(intervals, numbers, 3);
        Self {
            start: to_bits([x, y, z]),
            terms: [[a, b, c], [d, e, f], [g, h, i]],
            halves: [[width, height], [width_growth, height_growth]],
        }
    }

    #[cfg_attr(optimized, inline(always))]
    pub(super) fn offset(&self, u: S::Floats) -> [S::Floats; 3] {
        let [c1, c2, c3] = self.terms;
        scale(plus(c1, scale(plus(c2, scale(c3, u)), u)), u)
    }

    #[cfg_attr(optimized, inline(always))]
    pub(super) fn velocity(&self, simd: S, u: S::Floats) -> [S::Floats; 3] {
        velocity(simd, &self.terms, u)
    }

    #[cfg_attr(optimized, inline(always))]
    pub(super) fn acceleration(&self, simd: S, u: S::Floats) -> [S::Floats; 3] {
        acceleration(simd, &self.terms, u)
    }

    /// The length of the velocity at `u`.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn speed(&self, simd: S, u: f32) -> S::Floats {
        let velocity = self.velocity(simd, simd.splat(u));
        dot(velocity, velocity).sqrt()
    }

    /// `Interval::reach` of the core.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn reach(
        &self,
        simd: S,
        u: S::Floats,
        tangent: [S::Floats; 3],
        towards: [S::Floats; 3],
    ) -> S::Floats {
        reach(simd, self.halves, u, tangent, towards)
    }
}

/// `Interval::velocity` of the core.
#[cfg_attr(optimized, inline(always))]
pub(super) fn velocity<S: Simd>(simd: S, [c1, c2, c3]: &[[S::Floats; 3]; 3], u: S::Floats) -> [S::Floats; 3] {
    let thrice = simd.splat(3.0) * u;
    plus(*c1, scale(plus(scale(*c2, simd.splat(2.0)), scale(*c3, thrice)), u))
}

/// `Interval::acceleration` of the core.
#[cfg_attr(optimized, inline(always))]
pub(super) fn acceleration<S: Simd>(
    simd: S,
    [_, c2, c3]: &[[S::Floats; 3]; 3],
    u: S::Floats,
) -> [S::Floats; 3] {
    plus(scale(*c2, simd.splat(2.0)), scale(*c3, simd.splat(6.0) * u))
}

/// `Interval::reach` of the core, for intervals whose direction at `u` is `tangent`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn reach<S: Simd>(
    simd: S,
    [start, growth]: [[S::Floats; 2]; 2],
    u: S::Floats,
    tangent: [S::Floats; 3],
    towards: [S::Floats; 3],
) -> S::Floats {
    let width = start[0] + growth[0] * u;
    let height = start[1] + growth[1] * u;
    let round = (width - height).is_zero();
    if round.bits() == S::ALL {
        // Most yarns are round, and reach equally far in all directions.
        return width;
    }
    let [x, y, z] = tangent;
    let level = x * x + y * y;
    let square = level + z * z;
    let stands = (simd.splat(1e-12) * square).less(level);
    let aside = (towards[1] * x - towards[0] * y) * width;
    let up = (towards[2] * level - (towards[0] * x + towards[1] * y) * z) * height;
    let flat = ((aside * aside + up * up / square) / level).sqrt();
    round.select(width, stands.select(flat, width))
}

/// The weights of an interval's four control points at `u`, as in the core.
#[cfg_attr(optimized, inline(always))]
pub(super) fn weights<S: Simd>(simd: S, u: S::Floats, s: f32) -> [S::Floats; 4] {
    let (square, one) = (u * u, simd.splat(1.0));
    let cube = square * u;
    let before = (simd.splat(2.0) * square - u - cube) * simd.splat(s);
    let after = (cube - square) * simd.splat(s);
    let end = simd.splat(s) * u + simd.splat(3.0 - 2.0 * s) * square + simd.splat(s - 2.0) * cube;
    [before, one - before - end - after, end, after]
}
