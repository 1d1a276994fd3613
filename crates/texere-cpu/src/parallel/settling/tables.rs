//! What the lanes of a settling read: rows of four floats, so that a vector of them is four loads
//! and a transposition.

use bytemuck::{Pod, Zeroable};
use texere_core::settling::{Place, SettlingPlan, tag};

use super::curves::Curve;
use crate::cells::owners;
use crate::parallel::simd::{
    Job, LANES_MAX, Simd, between, bit_cast, difference, plus, rounded, scale, to_bits, to_floats,
};

/// Places that one task works on.
pub(super) const TASK: usize = 512;

/// What never changes.
#[derive(Debug)]
pub(super) struct Fixed {
    /// Of each place's interval: the growth of its half width, its half width and its half height
    /// at the beginning, the growth of that, mm.
    pub(super) halves: Vec<[f32; 4]>,
    /// Of each place's interval: the largest half width or half height.
    pub(super) thickest: Vec<f32>,
    /// The place of each chord's interval.
    pub(super) owners: Vec<u32>,
    /// Of each chord: where along the interval it begins and ends, its number there, and one over
    /// their count.
    pub(super) shares: Vec<[f32; 4]>,
}

impl Fixed {
    pub(super) fn new(plan: &SettlingPlan) -> Self {
        let (count, chords) = (plan.counts().places as usize, plan.counts().chords as usize);
        let mut fixed = Self {
            halves: vec![[0.0; 4]; count + BACK],
            thickest: vec![0.0; count],
            owners: owners(plan),
            shares: vec![[0.0; 4]; chords + BACK],
        };
        for place in (0..count).filter(|&place| plan.tags()[place] & tag::INTERVAL != 0) {
            let [start, end] = [place, place + 1].map(|place| plan.places()[place].halves);
            let growth = [end.width() - start.width(), end.height() - start.height()];
            fixed.halves[place] = [growth[0], start.width(), start.height(), growth[1]];
            fixed.thickest[place] = plan.interval(plan.places(), place).thickest();
            let own = plan.chords()[place]..plan.chords()[place + 1];
            let pieces = own.len() as f32;
            for (piece, chord) in (0_u32..).zip(own) {
                let piece = piece as f32;
                fixed.shares[chord as usize] = [piece / pieces, (piece + 1.0) / pieces, piece, 1.0 / pieces];
            }
        }
        fixed
    }
}

/// An interval: where it begins (as bits of `i32`) and the growth of its half width; what goes with
/// u and its half width; with u² and its half height; with u³ and the growth of that.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct IntervalRow(pub(super) [[f32; 4]; 4]);

/// A chord: where it begins and the place of its interval (as bits); its span and the interval's
/// thickest half.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct ChordRow(pub(super) [[f32; 4]; 2]);

/// What pulls at the control points of an interval.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct PullRow {
    /// The slots of the core's `Pull`, of twelve numbers, the last three of them 0.
    pub(super) slots: [[[f32; 4]; 3]; 4],
    /// Half of the length that the interval has too much, along its chord, and its length, mm.
    pub(super) length: [f32; 4],
    /// The least distance seen, mm, the same over both reaches, the least radius of curvature in
    /// diameters, and the share by which the length is off.
    pub(super) seen: [f32; 4],
}

impl PullRow {
    pub(super) const NONE: Self = Self {
        slots: [[[0.0; 4]; 3]; 4],
        length: [0.0; 4],
        seen: [f32::INFINITY, f32::INFINITY, f32::INFINITY, 0.0],
    };

    /// Which of its rows is `length`, and which is `seen`.
    pub(super) const LENGTH: usize = 12;
    pub(super) const SEEN: usize = 13;

    /// As rows of four.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn rows(pulls: &[Self]) -> &[[[f32; 4]; 14]] {
        bytemuck::cast_slice(pulls)
    }

    /// Takes note of a distance to another yarn.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn see(&mut self, distance: f32, ratio: f32) {
        self.seen[0] = self.seen[0].min(distance);
        self.seen[1] = self.seen[1].min(ratio);
    }
}

/// Entries before the first place's and behind the last one's, so that no window of a vector ends
/// outside.
pub(super) const FRONT: usize = 4;
pub(super) const BACK: usize = 2 * LANES_MAX;

/// Makes the rows of intervals from places, and those of their chords: a task's.
pub(super) struct Make<'a> {
    pub(super) plan: &'a SettlingPlan,
    pub(super) fixed: &'a Fixed,
    /// With [`FRONT`] entries before the first place.
    pub(super) places: &'a [Place],
    /// The place of the first of `intervals`.
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
            // As the core's coefficients.
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
