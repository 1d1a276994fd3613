//! The tables that the lanes of a settling read and write. Rows have four floats, so that a vector
//! of rows is loaded a row at a time and then transposed.

use bytemuck::{Pod, Zeroable};
use texere_core::settling::{SettlingPlan, tag};

use crate::cells::owners;
use crate::parallel::simd::LANES_MAX;

/// The number of places that one task works on.
pub(super) const TASK: usize = 512;

/// Tables that never change during a settling.
#[derive(Debug)]
pub(super) struct Fixed {
    /// For the interval at each place: the growth of its half width, its half width and its half
    /// height at the beginning, and the growth of its half height, mm.
    pub(super) halves: Vec<[f32; 4]>,
    /// For the interval at each place: the largest half width or half height, mm.
    pub(super) thickest: Vec<f32>,
    /// For each chord, the place at which its interval begins.
    pub(super) owners: Vec<u32>,
    /// For each chord: the shares of its interval at which it begins and ends, its number in the
    /// interval, and one over the number of the interval's chords.
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

/// An interval, in four rows. Each row has a vector and a number: the beginning (as bits of `i32`)
/// and the growth of the half width; the coefficient of u and the half width; the coefficient of u²
/// and the half height; the coefficient of u³ and the growth of the half height.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct IntervalRow(pub(super) [[f32; 4]; 4]);

/// A chord, in two rows: the point where it begins and the place of its interval (both as bits);
/// its span, mm, and the largest half width or half height of its interval, mm.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct ChordRow(pub(super) [[f32; 4]; 2]);

/// The pulls of an interval at its control points.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct PullRow {
    /// The slots of the core's `Pull`. Each has twelve numbers, of which the last three are 0.
    pub(super) slots: [[[f32; 4]; 3]; 4],
    /// Half of the interval's surplus length, as a vector along its chord, and the interval's
    /// length, mm.
    pub(super) length: [f32; 4],
    /// Four measures: the least distance to another stretch of yarn, mm; the least ratio of such a
    /// distance to the sum of both reaches, the distances from the centrelines to the surfaces; the
    /// least radius of curvature, in diameters; the share by which the length is off.
    pub(super) seen: [f32; 4],
}

impl PullRow {
    pub(super) const NONE: Self = Self {
        slots: [[[0.0; 4]; 3]; 4],
        length: [0.0; 4],
        seen: [f32::INFINITY, f32::INFINITY, f32::INFINITY, 0.0],
    };

    /// The number of the row `length` in [`PullRow::rows`].
    pub(super) const LENGTH: usize = 12;
    /// The number of the row `seen` in [`PullRow::rows`].
    pub(super) const SEEN: usize = 13;

    /// All of `pulls` as rows of four numbers.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn rows(pulls: &[Self]) -> &[[[f32; 4]; 14]] {
        bytemuck::cast_slice(pulls)
    }

    /// Takes a distance to another stretch of yarn, and its ratio to the sum of both reaches, into
    /// the measures.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn see(&mut self, distance: f32, ratio: f32) {
        self.seen[0] = self.seen[0].min(distance);
        self.seen[1] = self.seen[1].min(ratio);
    }
}

/// The number of entries before the first place's, so that no vector reaches outside.
pub(super) const FRONT: usize = 4;
/// The number of entries behind the last place's, so that no vector reaches outside.
pub(super) const BACK: usize = 2 * LANES_MAX;
