//! The yarns of a cloth: the control points of every end and every pick.

use std::sync::Arc;

use rayon::prelude::*;
use texere_core::backend::zeroed;
use texere_core::{ControlPoint, Layout, Origin, Yarn, Yarns};

use super::bend::Bend;
use super::path::{self, Station, ThreadPath};
use super::selvedge::{self, TURN_POINTS};
use super::shape::Set;
use super::{POINTS_MAX, Thread, Woven};
use crate::{FabricError, WovenError};

/// The source of a control point that belongs to no crossing: the first and the last point of a
/// yarn, and the points of its turns at a selvedge.
pub const NO_CROSSING: u32 = u32::MAX;

/// A cloth has at least two control points a crossing, so no crossing's number reaches
/// [`NO_CROSSING`].
const _: () = assert!(POINTS_MAX / 2 < NO_CROSSING as u64);

/// One passage of a thread through the cloth: an end, or a pick with the turn that leads to it, if
/// there is one.
#[derive(Debug, Clone, Copy)]
pub(super) enum Pass {
    End(usize),
    /// A pick, and whether the yarn is cut off at the pick's beginning and at its end.
    Pick(usize, [bool; 2]),
}

/// Everything that the paths of a cloth's threads depend on, except the drawdown.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    warp: Set,
    weft: Set,
    warp_share: f32,
}

/// A cloth whose threads are to be laid, with its measures.
#[derive(Clone, Copy)]
pub(super) struct Laying<'a> {
    cloth: &'a Woven,
    measured: &'a Measured,
}

/// What the threads that share a path have in common: whether they are picks, whether they run to
/// the left, and the bits of their half height.
pub(super) type Kind = (bool, bool, u32);

impl Woven {
    /// The yarns of the cloth: all ends, then all picks.
    ///
    /// An end runs along +y from the lower edge of the cloth to its upper edge, and a pick along +x
    /// from the left edge to the right one. The cloth spans \[0, width\] × \[0, height\] (see
    /// [`Woven::size_mm`]). At a crossing the upper thread is at +z and the lower one at -z. The
    /// two threads are far enough apart for the heights of their sections, and
    /// [`Crimp`](crate::Crimp) says how they share this distance. Between crossings threads run as
    /// [`Shape`](crate::Shape) says. Origins are [`Origin::End`] and [`Origin::Pick`]. The source
    /// of a control point is the number of the crossing at which it lies or beside which it bends:
    /// pick × ends + end, both counted from 0. A point half way between two crossings has the
    /// number of the first one along the yarn. The ends of a yarn have [`NO_CROSSING`].
    ///
    /// With a selvedge ([`Woven::set_selvedge`]) consecutive picks that are alike in material,
    /// section and twist are one yarn, whose origin is its first pick. Picks are counted from 1.
    /// Odd picks run along +x, even ones along -x.
    ///
    /// **Errors**: [`WovenError::Points`] for more than 2³² control points,
    /// [`FabricError::OutOfMemory`], and [`FabricError::Yarns`] for yarns that [`Yarns`] refuses.
    ///
    /// **Source**: the paper that texere implements (README.md) has one control point at each
    /// crossing. The heights at a crossing and the bends of round threads follow Peirce, "The
    /// geometry of cloth structure", Journal of the Textile Institute 28, 1937: h₁ + h₂ = d₁ + d₂,
    /// with the crimp heights h and the diameters d of warp and weft.
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        let (measured, passes) = (self.measured(), self.passes());
        let laying = self.laying(&measured);
        let counts = laying.counts(&passes);
        let mut table = Vec::new();
        let mut offsets = Vec::new();
        let mut total = 0;
        for (pass, &count) in passes.iter().zip(&counts) {
            if let Some(yarn) = self.yarn(pass) {
                table.push(yarn);
                offsets.push(total);
            }
            total += count as u64;
        }
        offsets.push(total);
        if total > POINTS_MAX {
            let (ends, picks) = (self.warp().len(), self.weft().len());
            return Err(WovenError::Points { ends, picks, points: total, limit: POINTS_MAX }.into());
        }

        let mut points: Vec<ControlPoint> = zeroed("control points", total)?;
        let mut sources: Vec<u32> = zeroed("sources", total)?;
        let pens = Pen::all(&mut points, &mut sources, counts);
        laying.each(&passes, pens, |path, pass, mut pen| {
            laying.lay(path, pass, &mut |point, source| pen.write(point, source));
        });

        let layout = Layout::new(table, offsets, self.sections().to_vec())?;
        Ok(Yarns::new(layout, self.materials().to_vec(), points)?.with_sources(sources)?)
    }

    /// Number of control points of all yarns, with the cloth's present [`Shape`](crate::Shape) and
    /// selvedge.
    #[must_use]
    pub fn point_count(&self) -> u64 {
        let measured = self.measured();
        self.laying(&measured).counts(&self.passes()).into_iter().map(|count| count as u64).sum()
    }

    pub(super) fn measured(&self) -> Measured {
        Measured {
            warp: Set::new(self.warp(), self.sections()),
            weft: Set::new(self.weft(), self.sections()),
            warp_share: self.warp_share(),
        }
    }

    pub(super) const fn laying<'a>(&'a self, measured: &'a Measured) -> Laying<'a> {
        Laying { cloth: self, measured }
    }

    /// All ends, then all picks.
    pub(super) fn passes(&self) -> Vec<Pass> {
        let ends = (0..self.warp().len()).map(Pass::End);
        let runs = selvedge::runs(self.weft(), self.selvedge());
        let picks = runs.into_iter().flat_map(|run| {
            run.clone().map(move |pick| Pass::Pick(pick, [pick == run.start, pick + 1 == run.end]))
        });
        ends.chain(picks).collect()
    }

    /// For each end and then each pick, its set (0 for ends and 1 for picks) and the number of its
    /// yarn.
    pub(crate) fn yarns_of_threads(&self) -> impl Iterator<Item = (usize, usize)> {
        let mut yarns = 0;
        self.passes().into_iter().map(move |pass| {
            yarns += usize::from(!pass.turns());
            (usize::from(matches!(pass, Pass::Pick(..))), yarns - 1)
        })
    }

    /// **Errors**: [`WovenError::OtherCloth`] if `yarns` are not the cloth's.
    pub(crate) fn owns(&self, yarns: &Yarns) -> Result<(), WovenError> {
        let own = self.passes().into_iter().filter_map(|pass| self.yarn(&pass));
        let (mut own, mut theirs) = (own, yarns.layout().yarns().iter());
        for yarn in 0.. {
            match (own.next(), theirs.next()) {
                (None, None) => break,
                (Some(own), Some(theirs)) if own == *theirs => {}
                _ => return Err(WovenError::OtherCloth { yarn }),
            }
        }
        Ok(())
    }

    /// The yarn that begins with a pass, without its control points. None if no yarn begins with
    /// the pass.
    pub(super) fn yarn(&self, pass: &Pass) -> Option<Yarn> {
        let (thread, origin): (Thread, _) = match *pass {
            Pass::End(end) => (self.warp()[end], Origin::End(end as u32 + 1)),
            Pass::Pick(pick, [true, _]) => (self.weft()[pick], Origin::Pick(pick as u32 + 1)),
            Pass::Pick(..) => return None,
        };
        Some(Yarn {
            material: thread.material,
            section: thread.section,
            closed: false,
            twist: thread.twist,
            origin,
        })
    }
}

impl<'a> Laying<'a> {
    /// Calls `work`, in parallel, for each pass with its path and its value of `with`. The path is
    /// computed once for all passes of a kind.
    fn each<T: Send>(
        &self,
        passes: &[Pass],
        with: impl IntoIterator<Item = T>,
        work: impl Fn(&ThreadPath<'_>, Pass, T) + Sync,
    ) {
        let mut passes: Vec<(Pass, T)> = passes.iter().copied().zip(with).collect();
        passes.sort_by_key(|(pass, _)| self.kind(*pass));
        let mut kinds = Vec::new();
        while let Some(&(first, _)) = passes.last() {
            let start = passes.partition_point(|(pass, _)| self.kind(*pass) < self.kind(first));
            kinds.push(passes.split_off(start));
        }
        kinds.into_par_iter().for_each(|passes| {
            let Some(&(first, _)) = passes.first() else { return };
            let path = self.path(first, self.stations(first));
            passes.into_par_iter().for_each(|(pass, with)| work(&path, pass, with));
        });
    }

    pub(super) fn kind(&self, pass: Pass) -> Kind {
        let Measured { warp, weft, .. } = self.measured;
        match pass {
            Pass::End(end) => (false, false, warp.half_height[end].to_bits()),
            Pass::Pick(pick, _) => (true, self.runs_left(pick), weft.half_height[pick].to_bits()),
        }
    }

    /// The stations of the path that passes of the kind of `pass` take.
    pub(super) fn stations(&self, pass: Pass) -> Arc<[Station]> {
        path::stations(&self.bend(pass), self.kind(pass).1)
    }

    /// The path of a pass, made of the stations of its kind.
    pub(super) fn path(&self, pass: Pass, stations: Arc<[Station]>) -> ThreadPath<'a> {
        ThreadPath::new(self.bend(pass), stations, self.kind(pass).1)
    }

    /// Number of control points of each pass.
    fn counts(&self, passes: &[Pass]) -> Vec<usize> {
        let mut counts = vec![0; passes.len()];
        self.each(passes, &mut counts, |path, pass, count| match path.fixed_count(pass.cut()) {
            Some(fixed) => *count = fixed + if pass.turns() { TURN_POINTS } else { 0 },
            None => self.lay(path, pass, &mut |_, _| *count += 1),
        });
        counts
    }

    /// Calls `write` with each control point of a pass and its source.
    pub(super) fn lay(&self, path: &ThreadPath<'_>, pass: Pass, write: &mut impl FnMut(ControlPoint, u32)) {
        let Measured { warp, weft, .. } = self.measured;
        let (drawdown, ends) = (self.cloth.drawdown(), warp.at.len());
        let cut = pass.cut();
        match pass {
            Pass::End(end) => {
                let (x, halves) = (warp.at[end], self.cloth.warp()[end].halves());
                let above = |pick| drawdown.up(end, pick);
                path.walk(above, cut, |stop| {
                    let source = stop.crossing.map_or(NO_CROSSING, |pick| (pick * ends + end) as u32);
                    write(ControlPoint { x, y: stop.along, z: stop.z, halves }, source);
                });
            }
            Pass::Pick(pick, _) => {
                if pass.turns() {
                    self.turn(pick).into_iter().for_each(|point| write(point, NO_CROSSING));
                }
                let (y, halves) = (weft.at[pick], self.cloth.weft()[pick].halves());
                let above = |end| !drawdown.up(end, pick);
                path.walk(above, cut, |stop| {
                    let source = stop.crossing.map_or(NO_CROSSING, |end| (pick * ends + end) as u32);
                    write(ControlPoint { x: stop.along, y, z: stop.z, halves }, source);
                });
            }
        }
    }

    fn bend(&self, pass: Pass) -> Bend<'a> {
        let Measured { warp, weft, warp_share } = self.measured;
        let shape = self.cloth.shape();
        match pass {
            Pass::End(end) => {
                Bend { shape, crossed: weft, half_height: warp.half_height[end], share: *warp_share }
            }
            Pass::Pick(pick, _) => {
                Bend { shape, crossed: warp, half_height: weft.half_height[pick], share: 1.0 - warp_share }
            }
        }
    }

    fn runs_left(&self, pick: usize) -> bool {
        selvedge::runs_left(pick, self.cloth.selvedge())
    }

    /// The turn from the pick before to `pick`. It begins beyond the edge end by half the sum of
    /// the widths of end and pick, so that the two can't touch, whatever the end's height. If a
    /// quarter of the distance between the picks is more, the turn begins that far out. The turn's
    /// steps are then not much longer than the step that leads to the turn.
    fn turn(&self, pick: usize) -> [ControlPoint; TURN_POINTS] {
        let Measured { warp, weft, .. } = self.measured;
        let right = self.runs_left(pick);
        let (end, outwards) = if right { (warp.at.len() - 1, 1.0) } else { (0, -1.0) };
        let widest = weft.half_width[pick].max(weft.half_width[pick - 1]);
        let touching = warp.half_width[end] + widest;
        let apart = weft.at[pick] - weft.at[pick - 1];
        let x = warp.at[end] + outwards * touching.max(apart / 4.0);
        let [from, to] = [pick - 1, pick].map(|pick| {
            let bend = self.bend(Pass::Pick(pick, [true; 2]));
            let z = bend.leaving_z(end, (x - warp.at[end]).abs(), |end| !self.cloth.drawdown().up(end, pick));
            ControlPoint { x, y: weft.at[pick], z, halves: self.cloth.weft()[pick].halves() }
        });
        selvedge::turn(x, outwards, &from, &to)
    }
}

impl Pass {
    /// Whether the yarn is cut off at the pass's beginning, and at its end.
    pub(super) const fn cut(self) -> [bool; 2] {
        match self {
            Self::End(_) => [true; 2],
            Self::Pick(_, cut) => cut,
        }
    }

    /// Whether a turn leads to the pass.
    pub(super) const fn turns(self) -> bool {
        !self.cut()[0]
    }
}

/// Writes the control points and sources of one pass, one after another.
pub(super) struct Pen<'a> {
    points: std::slice::IterMut<'a, ControlPoint>,
    sources: std::slice::IterMut<'a, u32>,
}

impl<'a> Pen<'a> {
    /// A pen for each pass, with room for the pass's number of points.
    pub(super) fn all(
        mut points: &'a mut [ControlPoint],
        mut sources: &'a mut [u32],
        counts: Vec<usize>,
    ) -> Vec<Self> {
        let pen = |count| {
            let points = points.split_off_mut(..count).unwrap_or_default();
            let sources = sources.split_off_mut(..count).unwrap_or_default();
            Self { points: points.iter_mut(), sources: sources.iter_mut() }
        };
        counts.into_iter().map(pen).collect()
    }

    pub(super) fn write(&mut self, point: ControlPoint, source: u32) {
        if let (Some(to), Some(from)) = (self.points.next(), self.sources.next()) {
            (*to, *from) = (point, source);
        }
    }
}
