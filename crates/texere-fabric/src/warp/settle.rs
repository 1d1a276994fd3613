//! Settling of a warp knit, and its measures.

use std::ops::ControlFlow;

use texere_core::settling::Length;
use texere_core::{Backend, Origin, Yarns};

use super::bar::RACK;
use super::{Bar, WarpKnitted};
use crate::own::Own;
use crate::relaxation::relax_repeat;
use crate::settling::{Look, settle_repeat};
use crate::{FabricError, Finish, FinishError, Measures, Piece, RelaxedKnit, Repeat, Settled};

/// Range of the factor by which settling may change the length of a yarn: the range of
/// [`Length::Given`].
const GIVEN: [f64; 2] = [0.5, 2.0];

/// Share by which the length of all yarns may differ from that of the run-ins without being
/// changed. With half the value, and with twice, no test is red.
const REACHED: f64 = 0.001;

/// The run-in of a bar: the length of yarn that it takes for a rack of 480 courses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunIn {
    /// The run-in that the bar asks for, mm.
    pub asked_mm: Option<f64>,
    /// The run-in that the bar has, mm: the mean of its yarns. 0 for a bar without yarn.
    pub reached_mm: f64,
}

impl RunIn {
    /// The share by which the run-in differs from the one asked for: 0.01 if it is one per cent too
    /// long. None if the bar asks for no run-in.
    #[must_use]
    pub fn miss(&self) -> Option<f64> {
        Some(self.reached_mm / self.asked_mm? - 1.0)
    }
}

impl WarpKnitted {
    /// Lets the yarns of one repeat settle, and copies the repeat. See [`settle`](crate::settle()).
    ///
    /// The run-in of a bar gives the height of its loops, from 1.45 to 1.75 courses. A run-in may
    /// ask for more or less yarn than these heights give. If every bar with yarns has a run-in and
    /// `finish` leaves the lengths open, all yarns together then get the length that the run-ins
    /// ask for, but between half and twice the length that they have. If a bar with yarns has no
    /// run-in, yarns keep their lengths. [`WarpKnitted::run_ins`] says by how much the run-in of
    /// each bar differs in the end from the one asked for. [`Settled::clearance`] is the clearance
    /// of the whole cloth, with its cut edges.
    ///
    /// `tension` is the tension of all yarns' splines, from 0 to below 1.
    ///
    /// **Errors**: the errors of [`WarpKnitted::yarns`], of [`Yarns::with_tension`] and of
    /// [`settle`](crate::settle()).
    pub fn settle(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Settled, FinishError> {
        let repeat = self.repeat()?.with_tension(tension).map_err(FabricError::from)?;
        let finish = self.finish_of(&repeat, finish);
        let settled = settle_repeat(
            &repeat,
            |yarns, look| self.placed(&repeat, yarns, look),
            &finish,
            backend,
            progress,
        )?;
        Ok(settled.pressed(|yarns| self.measures(yarns).thickness_mm))
    }

    /// Lets the yarns of one repeat come to rest by their energy, and copies the repeat. Wales and
    /// courses follow from the run-ins, unless [`Finish::hold`] holds them: see
    /// [`RelaxedKnit::gauge`]. Without run-ins yarns keep the lengths that the gauge's wales and
    /// courses give them.
    ///
    /// **Errors**: [`FinishError::Relaxation`] for yarns that can't be relaxed,
    /// [`FinishError::Backend`] for a backend that can't relax yarns, and the errors of
    /// [`WarpKnitted::settle`].
    pub fn relax(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<RelaxedKnit, FinishError> {
        let repeat = self.repeat_of_energy(tension)?;
        let finish = self.finish_of(&repeat, finish);
        let placed = |repeat: &Repeat, yarns: &Yarns, look: Look<'_>| self.placed(repeat, yarns, look);
        relax_repeat(&repeat, self.gauge(), &finish, placed, backend, progress)
    }

    /// The repeat that relaxes.
    pub(crate) fn repeat_of_energy(&self, tension: f32) -> Result<Repeat, FinishError> {
        Ok(self.smallest_repeat()?.with_tension(tension).map_err(FabricError::from)?)
    }

    /// `finish` with a rule for the lengths of [`WarpKnitted::repeat`], if it has none.
    #[must_use]
    pub fn finish_of(&self, repeat: &Repeat, finish: &Finish) -> Finish {
        let length = finish.length.unwrap_or_else(|| self.length(&repeat.piece));
        Finish { length: Some(length), ..*finish }
    }

    /// The rule for lengths if the finish has none.
    fn length(&self, piece: &Piece) -> Length {
        let courses = f64::from(piece.boundary.repeat()[1]) / self.gauge().course_mm;
        let yarns = piece.yarns.layout().yarns();
        let asked: Option<f64> = yarns.iter().map(|yarn| self.bar_of(yarn.origin)?.run_in_mm).sum();
        match asked {
            Some(asked) => {
                let factor = asked * courses / RACK / piece.length_mm();
                if (factor - 1.0).abs() < REACHED {
                    return Length::Held;
                }
                Length::Given(factor.clamp(GIVEN[0], GIVEN[1]) as f32)
            }
            None => Length::Held,
        }
    }

    fn bar_of(&self, origin: Origin) -> Option<&Bar> {
        let Origin::Guide { bar, .. } = origin else { return None };
        self.bars().get((bar as usize).wrapping_sub(1))
    }

    /// The run-in of each bar, in the order of the bars. `yarns` are the yarns of this cloth. Yarns
    /// that belong to no guide do not count.
    #[must_use]
    pub fn run_ins(&self, yarns: &Yarns) -> Vec<RunIn> {
        let mut sums = vec![(0.0, 0.0); self.bars().len()];
        for (yarn, each) in yarns.layout().yarns().iter().enumerate() {
            let Origin::Guide { bar, .. } = each.origin else { continue };
            let sum = sums.get_mut((bar as usize).wrapping_sub(1));
            if let Some((sum, count)) = sum {
                *sum += self.own(yarns, yarn).length_mm(yarns, yarn);
                *count += 1.0;
            }
        }
        let racks = f64::from(self.size()[1]) / RACK;
        let run_in = |(bar, (sum, count)): (&Bar, (f64, f64))| RunIn {
            asked_mm: bar.run_in_mm,
            reached_mm: if count > 0.0 { sum / count / racks } else { 0.0 },
        };
        self.bars().iter().zip(sums).map(run_in).collect()
    }

    /// The part of a yarn that counts for the cloth. All copies are alike: after the last point the
    /// first one follows, higher by the height of the cloth.
    fn own(&self, yarns: &Yarns, yarn: usize) -> Own {
        Own::round(yarns, yarn, self.beyond(), [0.0, self.size_mm()[1]])
    }

    /// Yarn consumption, loops, weight and thickness. `yarns` are the yarns of this cloth. Their
    /// parts beyond the cloth do not count, so that every copy of the repeat has the same numbers.
    #[must_use]
    pub fn measures(&self, yarns: &Yarns) -> Measures {
        let own = |yarn| self.own(yarns, yarn);
        Measures::of_knit(yarns, own, self.loops(), self.size(), self.size_mm())
    }
}
