//! What the lanes of a settling read: rows of four floats, so that a vector of them is four loads
//! and a transposition.

use bytemuck::{Pod, Zeroable};
use texere_core::settling::{SettlingPlan, tag};

use crate::cells::owners;
use crate::parallel::simd::LANES_MAX;

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
