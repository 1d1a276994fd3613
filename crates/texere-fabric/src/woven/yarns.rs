//! From cloth to yarns: one control point a crossing, and one before and after.

use rayon::prelude::*;
use texere_core::{ControlPoint, Layout, Origin, Section, Yarn, Yarns};

use super::{POINTS_MAX, Thread, Woven, crossing, zeroed};
use crate::FabricError;

/// The source of a control point that is no crossing: a yarn's first and last.
pub const NO_CROSSING: u32 = u32::MAX;

/// Every crossing has two control points, so that none is numbered as high as [`NO_CROSSING`].
const _: () = assert!(POINTS_MAX / 2 < NO_CROSSING as u64);

/// The threads of one direction, as tables for those that cross them.
pub(super) struct Set {
    /// Where each thread lies, mm.
    at: Vec<f32>,
    /// Half the height of each thread's section, mm.
    pub(super) half_height: Vec<f32>,
    /// Mean distance of each thread to its neighbours, mm.
    pub(super) pitch: Vec<f32>,
    /// Sum of all spacings, mm: where a yarn that crosses them ends.
    extent: f32,
}

impl Set {
    pub(super) fn new(threads: &[Thread], sections: &[Section]) -> Self {
        let heights: Vec<f32> = sections.iter().map(Section::half_height).collect();
        let half_height = |thread: &Thread| thread.radius_mm * heights[thread.section as usize];
        // The first thread lies half its spacing inside the cloth, the last half its own.
        let mut edge = -threads.first().map_or(0.0, |thread| thread.spacing_mm) / 2.0;
        let at = threads.iter().map(|thread| {
            edge += thread.spacing_mm;
            edge as f32
        });
        let at = at.collect();
        let last = threads.last().map_or(0.0, |thread| thread.spacing_mm);
        let after = threads.iter().skip(1).map(|thread| thread.spacing_mm).chain([last]);
        Self {
            at,
            half_height: threads.iter().map(half_height).collect(),
            pitch: threads
                .iter()
                .zip(after)
                .map(|(own, after)| ((own.spacing_mm + after) / 2.0) as f32)
                .collect(),
            extent: (edge + last / 2.0) as f32,
        }
    }
}

impl Woven {
    /// The yarns of the cloth: all ends, then all picks.
    ///
    /// An end runs along +y and has one control point for each pick and one half a pitch before and after, in the cloth's
    /// middle (z = 0); a pick likewise along +x. The cloth spans \[0, width\] × \[0, height\] (see [`Woven::size_mm`]). At a
    /// crossing the upper thread is at +z and the lower at -z, far enough apart for their sections' heights. Origins
    /// are [`Origin::End`] and [`Origin::Pick`]; the source of a control point is the crossing's number, pick × ends +
    /// end, both from 0, or [`NO_CROSSING`] at the yarn's ends.
    ///
    /// **Errors**: [`FabricError::OutOfMemory`], and [`FabricError::Yarns`] for what only the whole shows.
    ///
    /// **Source**: one control point a crossing is the paper's count; the height of a crossing follows Peirce, "The
    /// geometry of cloth structure", Journal of the Textile Institute 28, 1937 (h₁ + h₂ = d₁ + d₂, balanced).
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        let (ends, picks) = (self.drawdown().ends(), self.drawdown().picks());
        let (end_points, pick_points) = (picks + 2, ends + 2);
        let (warp, weft) = (Set::new(self.warp(), self.sections()), Set::new(self.weft(), self.sections()));

        let total = self.point_count();
        let mut points: Vec<ControlPoint> = zeroed("control points", total)?;
        let mut sources: Vec<u32> = zeroed("sources", total)?;
        let (warp_points, weft_points) = points.split_at_mut(ends * end_points);
        let (warp_sources, weft_sources) = sources.split_at_mut(ends * end_points);

        warp_points
            .par_chunks_exact_mut(end_points)
            .zip(warp_sources.par_chunks_exact_mut(end_points))
            .enumerate()
            .for_each(|(end, (points, sources))| {
                let (x, radius) = (warp.at[end], self.warp()[end].radius_mm);
                let at = |y, z| ControlPoint::new(x, y, z, radius);
                lay(points, &weft, warp.half_height[end], at, |pick| self.drawdown().up(end, pick));
                trace(sources, |pick| pick * ends + end);
            });
        weft_points
            .par_chunks_exact_mut(pick_points)
            .zip(weft_sources.par_chunks_exact_mut(pick_points))
            .enumerate()
            .for_each(|(pick, (points, sources))| {
                let (y, radius) = (weft.at[pick], self.weft()[pick].radius_mm);
                let at = |x, z| ControlPoint::new(x, y, z, radius);
                lay(points, &warp, weft.half_height[pick], at, |end| !self.drawdown().up(end, pick));
                trace(sources, |end| pick * ends + end);
            });

        let layout = Layout::new(
            self.yarn_table(),
            offsets(ends, end_points, picks, pick_points),
            self.sections().to_vec(),
        )?;
        Ok(Yarns::new(layout, self.materials().to_vec(), points)?.with_sources(sources)?)
    }

    /// What belongs to each yarn beside its control points.
    fn yarn_table(&self) -> Vec<Yarn> {
        let yarn = |thread: &Thread, origin| Yarn {
            material: thread.material,
            section: thread.section,
            closed: false,
            twist: thread.twist,
            origin,
        };
        let ends = (1..).map(Origin::End).zip(self.warp());
        let picks = (1..).map(Origin::Pick).zip(self.weft());
        ends.chain(picks).map(|(origin, thread)| yarn(thread, origin)).collect()
    }
}

/// Where each yarn's control points start, and their total.
fn offsets(ends: usize, end_points: usize, picks: usize, pick_points: usize) -> Vec<u64> {
    let (end_points, pick_points) = (end_points as u64, pick_points as u64);
    let warp = (0..ends as u64).map(|end| end * end_points);
    let weft = (0..=picks as u64).map(|pick| ends as u64 * end_points + pick * pick_points);
    warp.chain(weft).collect()
}

/// Lays one yarn over and under the threads of `crossed`; `at` makes a control point from the place along the yarn and z.
fn lay(
    points: &mut [ControlPoint],
    crossed: &Set,
    half_height: f32,
    at: impl Fn(f32, f32) -> ControlPoint,
    above: impl Fn(usize) -> bool,
) {
    let [first, points @ .., last] = points else { return };
    *first = at(0.0, 0.0);
    *last = at(crossed.extent, 0.0);
    let threads = crossed.at.iter().zip(&crossed.half_height).zip(&crossed.pitch);
    for (number, (point, ((&along, &height), &pitch))) in points.iter_mut().zip(threads).enumerate() {
        let depth = crossing::depth(half_height + height, pitch);
        *point = at(along, if above(number) { depth } else { -depth });
    }
}

/// Writes which crossing each control point of a yarn comes from.
fn trace(sources: &mut [u32], crossing: impl Fn(usize) -> usize) {
    let [first, sources @ .., last] = sources else { return };
    (*first, *last) = (NO_CROSSING, NO_CROSSING);
    for (number, source) in sources.iter_mut().enumerate() {
        *source = crossing(number) as u32;
    }
}
