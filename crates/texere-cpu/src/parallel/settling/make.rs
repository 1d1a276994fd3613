//! The rows of intervals and of their chords, made from places before each pass and before
//! neighbours are listed.

use texere_core::settling::{Place, SettlingPlan};

use super::curves::Curve;
use super::tables::{ChordRow, FRONT, Fixed, IntervalRow};
use crate::parallel::simd::{
    Job, LANES_MAX, Simd, between, bit_cast, difference, plus, rounded, scale, to_bits, to_floats,
};

/// Makes a task's rows of intervals from places, and the rows of their chords.
pub(super) struct Make<'a> {
    pub(super) plan: &'a SettlingPlan,
    pub(super) fixed: &'a Fixed,
    /// All places. [`FRONT`] entries come before the first.
    pub(super) places: &'a [Place],
    /// The number of the place at which the first of `intervals` begins.
    pub(super) first: usize,
    pub(super) intervals: &'a mut [IntervalRow],
    /// All chords of these intervals.
    pub(super) chords: &'a mut [ChordRow],
}

impl Job for Make<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(mut self, simd: S) {
        self.make_intervals(simd);
        self.make_chords(simd);
    }
}

impl Make<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn make_intervals<S: Simd>(&mut self, simd: S) {
        let (unit, s) = (simd.splat(self.plan.scale().unit()), self.plan.s());
        let places: &[[f32; 4]] = bytemuck::cast_slice(&self.places[FRONT + self.first - 1..]);
        for (number, out) in self.intervals.chunks_mut(S::LANES).enumerate() {
            let done = number * S::LANES;
            let start = corner(simd, &places[done + 1..]);
            let a = scale(to_floats(between(start, corner(simd, &places[done..]))), unit);
            let b = scale(to_floats(between(start, corner(simd, &places[done + 2..]))), unit);
            let c = scale(to_floats(between(start, corner(simd, &places[done + 3..]))), unit);
            // The coefficients, worked out as in the core.
            let c1 = scale(difference(b, a), simd.splat(s));
            let sum = plus(scale(a, simd.splat(2.0 * s)), scale(b, simd.splat(3.0 - 2.0 * s)));
            let c2 = difference(sum, scale(c, simd.splat(s)));
            let c3 = plus(scale(difference(c, a), simd.splat(s)), scale(b, simd.splat(s - 2.0)));
            let halves = simd.components(&self.fixed.halves[self.first + done..]);
            let [x, y, z] = bit_cast(start);
            let mut made = [IntervalRow::default(); LANES_MAX];
            let floats: &mut [f32] = bytemuck::cast_slice_mut(&mut made);
            simd.scatter([x, y, z, halves[0]], floats, 16);
            simd.scatter([c1[0], c1[1], c1[2], halves[1]], &mut floats[4..], 16);
            simd.scatter([c2[0], c2[1], c2[2], halves[2]], &mut floats[8..], 16);
            simd.scatter([c3[0], c3[1], c3[2], halves[3]], &mut floats[12..], 16);
            out.copy_from_slice(&made[..out.len()]);
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn make_chords<S: Simd>(&mut self, simd: S) {
        let Self { plan, fixed, .. } = *self;
        let first = plan.chords()[self.first] as usize;
        let units = simd.splat(1.0 / plan.scale().unit());
        for (number, out) in self.chords.chunks_mut(S::LANES).enumerate() {
            let chord = first + number * S::LANES;
            let (mut own, mut thickest) = ([0; LANES_MAX], [0.0; LANES_MAX]);
            for (lane, &owner) in fixed.owners[chord..][..out.len()].iter().enumerate() {
                (own[lane], thickest[lane]) = (owner - self.first as u32, fixed.thickest[owner as usize]);
            }
            let curve = Curve::<S>::new(simd, self.intervals, &own);
            let [from, to, ..] = simd.components(&fixed.shares[chord..]);
            let begins = curve.offset(from);
            let span = difference(curve.offset(to), begins);
            let [dx, dy, dz] = rounded(simd, scale(begins, units));
            let [x, y, z] = curve.start;
            let [x, y, z] = bit_cast([x + dx, y + dy, z + dz]);
            let mut made = [ChordRow::default(); LANES_MAX];
            let floats: &mut [f32] = bytemuck::cast_slice_mut(&mut made);
            simd.scatter([x, y, z, simd.splat(0.0)], floats, 8);
            simd.scatter([span[0], span[1], span[2], simd.load(&thickest)], &mut floats[4..], 8);
            for (lane, (out, made)) in out.iter_mut().zip(&made).enumerate() {
                *out = *made;
                out.0[0][3] = f32::from_bits(own[lane] + self.first as u32);
            }
        }
    }
}

/// The coordinates of consecutive places.
#[cfg_attr(optimized, inline(always))]
fn corner<S: Simd>(simd: S, places: &[[f32; 4]]) -> [S::Integers; 3] {
    let [x, y, z, _] = simd.components(places);
    to_bits([x, y, z])
}
