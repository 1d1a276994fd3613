//! What the lanes of a settling read: rows of four floats, so that a vector of them is four loads and a transposition.

use bytemuck::{Pod, Zeroable};
use texere_core::settling::{Place, SettlingPlan, tag};

use crate::parallel::simd::{Floats, Integers, Job, LANES_MAX, Simd, difference, plus, scale};

/// Places that one task works on.
pub(super) const TASK: usize = 512;

/// What never changes.
#[derive(Debug)]
pub(super) struct Fixed {
    /// Of each place's interval: the growth of its half width, its half width and its half height at the beginning, the growth
    /// of that, mm.
    pub(super) halves: Vec<[f32; 4]>,
    /// Of each place's interval: the largest half width or half height.
    pub(super) thickest: Vec<f32>,
    /// The place of each chord's interval.
    pub(super) owners: Vec<u32>,
    /// Of each chord: where along the interval it begins and ends, its number there, and one over their count.
    pub(super) shares: Vec<[f32; 4]>,
    /// Whether all yarns are round.
    pub(super) round: bool,
}

impl Fixed {
    pub(super) fn new(plan: &SettlingPlan) -> Self {
        let (count, chords) = (plan.counts().places as usize, plan.counts().chords as usize);
        let mut fixed = Self {
            halves: vec![[0.0; 4]; count + BACK],
            thickest: vec![0.0; count],
            owners: vec![0; chords],
            shares: vec![[0.0; 4]; chords + BACK],
            round: true,
        };
        for place in (0..count).filter(|&place| plan.tags()[place] & tag::INTERVAL != 0) {
            let [start, end] = [place, place + 1].map(|place| plan.places()[place].halves);
            let growth = [end.width() - start.width(), end.height() - start.height()];
            fixed.halves[place] = [growth[0], start.width(), start.height(), growth[1]];
            fixed.thickest[place] = plan.interval(plan.places(), place).thickest();
            fixed.round &= start.width() == start.height() && end.width() == end.height();
            let own = plan.chords()[place]..plan.chords()[place + 1];
            let pieces = own.len() as f32;
            for (piece, chord) in (0_u32..).zip(own) {
                let piece = piece as f32;
                fixed.owners[chord as usize] = place as u32;
                fixed.shares[chord as usize] = [piece / pieces, (piece + 1.0) / pieces, piece, 1.0 / pieces];
            }
        }
        fixed
    }
}

/// An interval: where it begins (as bits of `i32`) and the growth of its half width; what goes with u and its half width; with u²
/// and its half height; with u³ and the growth of that.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct IntervalRow(pub(super) [[f32; 4]; 4]);

/// A chord: where it begins and the place of its interval (as bits); its span and the interval's thickest half.
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
    /// The least distance seen, mm, the same over both reaches, the least radius of curvature in diameters, and the share by which
    /// the length is off.
    pub(super) seen: [f32; 4],
}

impl PullRow {
    pub(super) const NONE: Self = Self {
        slots: [[[0.0; 4]; 3]; 4],
        length: [0.0; 4],
        seen: [f32::INFINITY, f32::INFINITY, f32::INFINITY, 0.0],
    };

    /// Takes note of a distance to another yarn.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn see(&mut self, distance: f32, ratio: f32) {
        self.seen[0] = self.seen[0].min(distance);
        self.seen[1] = self.seen[1].min(ratio);
    }
}

/// Row `ROW` of the entries numbered `numbers`, in lanes.
#[cfg_attr(optimized, inline(always))]
pub(super) fn rows<S: Simd, const ROWS: usize, const ROW: usize>(
    simd: S,
    table: &[[[f32; 4]; ROWS]],
    numbers: &[u32],
) -> [S::Floats; 4] {
    let mut lanes = [[0.0; 4]; LANES_MAX];
    for (lane, &number) in lanes.iter_mut().zip(&numbers[..S::LANES]) {
        *lane = table[number as usize][ROW];
    }
    simd.components(&lanes)
}

/// Entries before the first place's and behind the last one's, so that no window of a vector ends outside.
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
            let window = |ahead: usize| {
                let [x, y, z, _] = simd.components(&places[done + ahead..]);
                [x, y, z].map(Floats::to_bits)
            };
            let [before, start, end, after] = [window(0), window(1), window(2), window(3)];
            let way = |to: [S::Integers; 3]| {
                [0, 1, 2].map(|axis| (to[axis] - start[axis]).signed_to_floats() * unit)
            };
            let (a, b, c) = (way(before), way(end), way(after));
            let by = |v, factor| scale(v, simd.splat(factor));
            let c1 = by(difference(b, a), s);
            let c2 = difference(plus(by(a, 2.0 * s), by(b, 3.0 - 2.0 * s)), by(c, s));
            let c3 = plus(by(difference(c, a), s), by(b, s - 2.0));
            let halves = simd.components(&self.fixed.halves[self.first + done..]);
            let [x, y, z] = start.map(Integers::bit_cast);
            let rows = [
                [x, y, z, halves[0]],
                [c1[0], c1[1], c1[2], halves[1]],
                [c2[0], c2[1], c2[2], halves[2]],
                [c3[0], c3[1], c3[2], halves[3]],
            ];
            let mut made = [IntervalRow::default(); LANES_MAX];
            let floats: &mut [f32] = bytemuck::cast_slice_mut(&mut made);
            for (row, values) in rows.into_iter().enumerate() {
                simd.scatter(values, &mut floats[4 * row..], 16);
            }
            out.copy_from_slice(&made[..out.len()]);
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn make_chords<S: Simd>(&mut self, simd: S) {
        let Self { plan, fixed, .. } = *self;
        let intervals: &[[[f32; 4]; 4]] = bytemuck::cast_slice(self.intervals);
        let first = plan.chords()[self.first] as usize;
        let units = simd.splat(1.0 / plan.scale().unit());
        for (number, out) in self.chords.chunks_mut(S::LANES).enumerate() {
            let chord = first + number * S::LANES;
            let (mut own, mut thickest) = ([0; LANES_MAX], [0.0; LANES_MAX]);
            for (lane, &owner) in fixed.owners[chord..][..out.len()].iter().enumerate() {
                (own[lane], thickest[lane]) = (owner - self.first as u32, fixed.thickest[owner as usize]);
            }
            let [x, y, z, _] = rows::<S, 4, 0>(simd, intervals, &own);
            let start = [x, y, z].map(Floats::to_bits);
            let [c1, c2, c3] = terms(simd, intervals, &own);
            let [from, to, ..] = simd.components(&fixed.shares[chord..]);
            let offset = |u| scale(plus(c1, scale(plus(c2, scale(c3, u)), u)), u);
            let begins = offset(from);
            let span = difference(offset(to), begins);
            let half = simd.splat(0.5);
            let at = [0, 1, 2].map(|axis| start[axis] + (begins[axis] * units + half).floor().to_signed());
            let [x, y, z] = at.map(Integers::bit_cast);
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

/// What goes with u, u² and u³ of the intervals numbered `numbers`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn terms<S: Simd>(simd: S, intervals: &[[[f32; 4]; 4]], numbers: &[u32]) -> [[S::Floats; 3]; 3] {
    let [a, b, c, _] = rows::<S, 4, 1>(simd, intervals, numbers);
    let [d, e, f, _] = rows::<S, 4, 2>(simd, intervals, numbers);
    let [g, h, i, _] = rows::<S, 4, 3>(simd, intervals, numbers);
    [[a, b, c], [d, e, f], [g, h, i]]
}
