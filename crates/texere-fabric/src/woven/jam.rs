//! Room of threads: beside one another, and between the threads that cross them.

use rayon::prelude::*;
use texere_core::Origin;

use super::shape::Set;
use super::thread::pitches;
use super::{Shape, Woven, crossing};
use crate::FabricWarning;

/// The share by which a pitch may fall short without counting as too small, because radii are
/// rounded to `f32`.
pub(super) const ROUNDING: f64 = 1e-6;

/// The least pitch of two threads, divided by the sum of two lengths: half the sum of the threads'
/// widths, and the height of a thread that changes sides between them. `share` is the share of the
/// crimp of the thread between.
///
/// The thread between is jammed if it goes from arc to arc with nothing straight between. Round a
/// crossed thread its centreline follows a circle of radius R, half the sum of the heights of both
/// threads. The centre of the circle is (1 - share) R beyond the cloth's middle, so that the circle
/// meets the middle √(share (2 - share)) R to the side. Flat threads stretch the circle sideways:
/// half the width of the crossed thread plus half the height of the thread between takes the place
/// of R. Two sets of round threads of diameter d with half the crimp each need √3 d.
///
/// **Source**: Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28,
/// 1937, where both sets jam at l = D θ, with the length l of thread from crossing to crossing, the
/// sum D of both diameters, and the weave angle θ in radians. Here each set jams by its own share
/// of the crimp.
pub(super) fn reach(share: f32) -> f32 {
    (share * (2.0 - share)).sqrt()
}

/// Two neighbouring threads of one set.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    /// Number of the second thread, counted from 1.
    pub(super) thread: u32,
    /// Distance between the two threads, mm.
    pub(super) pitch: f64,
    /// Half the sum of the widths of the two threads, mm.
    pub(super) widths: f32,
    /// Half the sum of the heights of the two threads, mm.
    heights: f32,
    /// Height of the thickest thread that changes sides between the two threads, mm; none if no
    /// thread does.
    pub(super) between: Option<f32>,
}

impl Gap {
    /// The least pitch at which the threads that change sides between the two are not jammed, mm.
    /// `share` is the share of the crimp of the threads between.
    pub(super) fn needed(&self, shape: Shape, share: f32) -> f64 {
        self.between.map_or(0.0, |between| match shape {
            Shape::Crossing => f64::from(crossing::PITCH_MIN * (self.heights + between) / 2.0),
            Shape::Round => f64::from(reach(share) * (self.widths + between)),
        })
    }
}

/// The gaps between the threads of `set`. `apart(thread, other)` says whether thread `other` of the
/// set `crossing` lies on different sides of `thread` and of the next thread.
pub(super) fn gaps(
    set: &Set,
    pitches: impl Iterator<Item = f64>,
    crossing: &Set,
    apart: impl Fn(usize, usize) -> bool + Sync,
) -> Vec<Gap> {
    let pitches: Vec<f64> = pitches.collect();
    // The thickest threads come first, so that the first one that changes sides is the thickest.
    let mut crossing: Vec<(usize, f32)> = crossing.half_height.iter().copied().enumerate().collect();
    crossing.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    pitches
        .into_par_iter()
        .enumerate()
        .map(|(first, pitch)| {
            let thickest = crossing.iter().find(|(other, _)| apart(first, *other));
            Gap {
                thread: first as u32 + 2,
                pitch,
                widths: set.half_width[first] + set.half_width[first + 1],
                heights: set.half_height[first] + set.half_height[first + 1],
                between: thickest.map(|(_, height)| 2.0 * height),
            }
        })
        .collect()
}

impl Woven {
    /// The gaps between ends, and the gaps between picks.
    pub(super) fn gaps(&self) -> [Vec<Gap>; 2] {
        let (warp, weft) = (Set::new(self.warp(), self.sections()), Set::new(self.weft(), self.sections()));
        let up = |end, pick| self.drawdown().up(end, pick);
        let [ends, picks] = [self.warp(), self.weft()].map(pitches);
        [
            gaps(&warp, ends, &weft, |end, pick| up(end, pick) != up(end + 1, pick)),
            gaps(&weft, picks, &warp, |pick, end| up(end, pick) != up(end, pick + 1)),
        ]
    }

    /// Warnings of threads without the room that they need.
    #[must_use]
    pub fn warnings(&self) -> Vec<FabricWarning> {
        let [warp, weft] = self.gaps();
        let share = self.warp_share();
        [
            crowded(&warp, Origin::End),
            crowded(&weft, Origin::Pick),
            self.jammed(&warp, 1.0 - share, Origin::End),
            self.jammed(&weft, share, Origin::Pick),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// A warning of threads that lie so close together that crossing threads can't pass between
    /// them.
    fn jammed(&self, gaps: &[Gap], share: f32, origin: fn(u32) -> Origin) -> Option<FabricWarning> {
        let lacking = gaps.iter().map(|gap| (origin(gap.thread), gap.needed(self.shape(), share), gap.pitch));
        let (count, first, (worst, needed_mm, pitch_mm)) = worst(lacking)?;
        Some(FabricWarning::Jammed { count, first, worst, needed_mm, pitch_mm })
    }
}

/// A warning of threads that lie so close beside the thread before them that the two pierce one
/// another.
fn crowded(gaps: &[Gap], origin: fn(u32) -> Origin) -> Option<FabricWarning> {
    let lacking = gaps.iter().map(|gap| (origin(gap.thread), f64::from(gap.widths), gap.pitch));
    let (count, first, (worst, needed_mm, spacing_mm)) = worst(lacking)?;
    Some(FabricWarning::Crowded { count, first, worst, needed_mm, spacing_mm })
}

/// The number of threads that lack room, the first of them, and the one that lacks the largest
/// share. Each of `threads` has the room that it needs and the room that it has.
fn worst(threads: impl Iterator<Item = (Origin, f64, f64)>) -> Option<(usize, Origin, (Origin, f64, f64))> {
    threads.filter(|(_, needed, room)| *needed > room * (1.0 + ROUNDING)).fold(None, |found, thread| {
        Some(match found {
            None => (1, thread.0, thread),
            Some((count, first, worst)) => {
                let more = thread.1 / thread.2 > worst.1 / worst.2;
                (count + 1, first, if more { thread } else { worst })
            }
        })
    })
}
