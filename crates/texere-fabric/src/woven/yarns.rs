//! From cloth to yarns: the control points of every end and every pick.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::{ControlPoint, Layout, Origin, Yarn, Yarns};

use super::selvedge::{self, TURN_POINTS};
use super::shape::{Course, Set, Shape};
use super::{POINTS_MAX, Thread, Woven, zeroed};
use crate::FabricError;

/// The source of a control point that is next to no crossing: a yarn's first and last, and its turns at a selvedge.
pub const NO_CROSSING: u32 = u32::MAX;

/// Every crossing has two control points, so that none is numbered as high as [`NO_CROSSING`].
const _: () = assert!(POINTS_MAX / 2 < NO_CROSSING as u64);

/// What one yarn is woven as.
#[derive(Debug, Clone)]
enum Strand {
    /// This end.
    End(usize),
    /// These picks.
    Picks(Range<usize>),
}

/// A cloth's threads, measured.
struct Loom<'a> {
    cloth: &'a Woven,
    warp: Set,
    weft: Set,
    warp_share: f32,
}

impl Woven {
    /// The yarns of the cloth: all ends, then all picks.
    ///
    /// An end runs along +y, from half a pitch before the first pick to half a pitch after the last; a pick likewise
    /// along +x. The cloth spans \[0, width\] × \[0, height\] (see [`Woven::size_mm`]). At a crossing the upper thread is at
    /// +z and the lower at -z, far enough apart for their sections' heights ([`Crimp`](crate::Crimp) says how far each).
    /// Between crossings threads go as [`Shape`] says. Origins are [`Origin::End`] and [`Origin::Pick`].
    /// The source of a control point is the number, pick × ends + end, both from 0, of the crossing at which it lies or
    /// next to which it bends (half way between two, of the first along the yarn), or [`NO_CROSSING`] at the yarn's
    /// ends.
    ///
    /// With a selvedge ([`Woven::set_selvedge`]) consecutive picks that are alike in material, section and twist are one
    /// yarn, whose origin is its first pick. Odd picks run along +x, even ones back.
    ///
    /// **Errors**: [`FabricError::Points`] for more than [`POINTS_MAX`] control points, [`FabricError::OutOfMemory`],
    /// and [`FabricError::Yarns`] for what only the whole shows.
    ///
    /// **Source**: one control point a crossing is the paper's count; the height of a crossing and round threads follow
    /// Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28, 1937 (h₁ + h₂ = d₁ + d₂).
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        let loom = self.loom();
        let strands = self.strands();
        let counts: Vec<usize> = strands.par_iter().map(|strand| loom.points(strand)).collect();
        let mut offsets = vec![0u64];
        let mut total = 0;
        offsets.extend(counts.iter().map(|&count| {
            total += count as u64;
            total
        }));
        if total > POINTS_MAX {
            let (ends, picks) = (self.warp().len(), self.weft().len());
            return Err(FabricError::Points { ends, picks, points: total, limit: POINTS_MAX });
        }

        let mut points: Vec<ControlPoint> = zeroed("control points", total)?;
        let mut sources: Vec<u32> = zeroed("sources", total)?;
        let mut parts = Vec::with_capacity(strands.len());
        let (mut points_left, mut sources_left) = (points.as_mut_slice(), sources.as_mut_slice());
        for (strand, &count) in strands.iter().zip(&counts) {
            let (points, points_after) = points_left.split_at_mut(count);
            let (sources, sources_after) = sources_left.split_at_mut(count);
            (points_left, sources_left) = (points_after, sources_after);
            parts.push((strand, Pen { points: points.iter_mut(), sources: sources.iter_mut() }));
        }
        parts.into_par_iter().for_each(|(strand, mut pen)| {
            loom.lay(strand, |point, source| pen.write(point, source));
        });

        let table = strands.iter().map(|strand| self.yarn(strand)).collect();
        let layout = Layout::new(table, offsets, self.sections().to_vec())?;
        Ok(Yarns::new(layout, self.materials().to_vec(), points)?.with_sources(sources)?)
    }

    /// Control points of all yarns, in the present [`Shape`] and with or without selvedge.
    #[must_use]
    pub fn point_count(&self) -> u64 {
        let loom = self.loom();
        self.strands().par_iter().map(|strand| loom.points(strand) as u64).sum()
    }

    fn loom(&self) -> Loom<'_> {
        Loom {
            cloth: self,
            warp: Set::new(self.warp(), self.sections()),
            weft: Set::new(self.weft(), self.sections()),
            warp_share: self.warp_share(),
        }
    }

    fn strands(&self) -> Vec<Strand> {
        let ends = (0..self.warp().len()).map(Strand::End);
        ends.chain(selvedge::runs(self.weft(), self.selvedge()).into_iter().map(Strand::Picks)).collect()
    }

    /// What belongs to a yarn beside its control points.
    fn yarn(&self, strand: &Strand) -> Yarn {
        let (thread, origin): (Thread, _) = match strand {
            Strand::End(end) => (self.warp()[*end], Origin::End(*end as u32 + 1)),
            Strand::Picks(picks) => (self.weft()[picks.start], Origin::Pick(picks.start as u32 + 1)),
        };
        Yarn {
            material: thread.material,
            section: thread.section,
            closed: false,
            twist: thread.twist,
            origin,
        }
    }
}

impl Loom<'_> {
    /// Control points of one yarn.
    fn points(&self, strand: &Strand) -> usize {
        if self.cloth.shape() == Shape::Crossing {
            // One a crossing and one at each end need not be laid to be counted.
            return match strand {
                Strand::End(_) => self.weft.at.len() + 2,
                Strand::Picks(picks) => {
                    picks.len() * self.warp.at.len() + 2 + (picks.len() - 1) * TURN_POINTS
                }
            };
        }
        let mut count = 0;
        self.lay(strand, |_, _| count += 1);
        count
    }

    /// Calls `write` with each control point of a yarn and its source.
    fn lay(&self, strand: &Strand, mut write: impl FnMut(ControlPoint, u32)) {
        match strand {
            Strand::End(end) => self.lay_end(*end, &mut write),
            Strand::Picks(picks) => {
                for pick in picks.clone() {
                    if pick > picks.start {
                        self.turn(pick).into_iter().for_each(|point| write(point, NO_CROSSING));
                    }
                    self.lay_pick(pick, [pick == picks.start, pick + 1 == picks.end], &mut write);
                }
            }
        }
    }

    fn lay_end(&self, end: usize, write: &mut impl FnMut(ControlPoint, u32)) {
        let course = Course {
            shape: self.cloth.shape(),
            crossed: &self.weft,
            half_height: self.warp.half_height[end],
            share: self.warp_share,
            back: false,
        };
        let (x, radius) = (self.warp.at[end], self.cloth.warp()[end].radius_mm);
        course.walk(
            |pick| self.cloth.drawdown().up(end, pick),
            [true; 2],
            |stop| {
                let source =
                    stop.crossing.map_or(NO_CROSSING, |pick| (pick * self.warp.at.len() + end) as u32);
                write(ControlPoint::new(x, stop.along, stop.z, radius), source);
            },
        );
    }

    /// One pick, cut off at its beginning and its end as `cut` says.
    fn lay_pick(&self, pick: usize, cut: [bool; 2], write: &mut impl FnMut(ControlPoint, u32)) {
        let (y, radius) = (self.weft.at[pick], self.cloth.weft()[pick].radius_mm);
        self.weft_course(pick).walk(
            |end| !self.cloth.drawdown().up(end, pick),
            cut,
            |stop| {
                let source =
                    stop.crossing.map_or(NO_CROSSING, |end| (pick * self.warp.at.len() + end) as u32);
                write(ControlPoint::new(stop.along, y, stop.z, radius), source);
            },
        );
    }

    fn weft_course(&self, pick: usize) -> Course<'_> {
        Course {
            shape: self.cloth.shape(),
            crossed: &self.warp,
            half_height: self.weft.half_height[pick],
            share: 1.0 - self.warp_share,
            back: selvedge::runs_left(pick, self.cloth.selvedge()),
        }
    }

    /// The turn from the pick before to `pick`. It begins as far beyond the edge end as both threads are wide by half, so
    /// that the two can't touch whatever the end's height, or a quarter of the picks' distance, so that the turn's steps
    /// are not much longer than the one that leads to it.
    fn turn(&self, pick: usize) -> [ControlPoint; TURN_POINTS] {
        let right = self.weft_course(pick).back;
        let (end, outwards) = if right { (self.warp.at.len() - 1, 1.0) } else { (0, -1.0) };
        let widest = self.weft.half_width[pick].max(self.weft.half_width[pick - 1]);
        let touching = self.warp.half_width[end] + widest;
        let apart = self.weft.at[pick] - self.weft.at[pick - 1];
        let x = self.warp.at[end] + outwards * touching.max(apart / 4.0);
        let [from, to] = [pick - 1, pick].map(|pick| {
            let z = self.weft_course(pick).leaving_z(end, |end| !self.cloth.drawdown().up(end, pick));
            ControlPoint::new(x, self.weft.at[pick], z, self.cloth.weft()[pick].radius_mm)
        });
        selvedge::turn(x, outwards, &from, &to)
    }
}

/// Writes one yarn's control points and sources, one after another.
struct Pen<'a> {
    points: std::slice::IterMut<'a, ControlPoint>,
    sources: std::slice::IterMut<'a, u32>,
}

impl Pen<'_> {
    fn write(&mut self, point: ControlPoint, source: u32) {
        if let (Some(to), Some(from)) = (self.points.next(), self.sources.next()) {
            (*to, *from) = (point, source);
        }
    }
}
