//! A warp knit settles, and what is measured of it then.

use std::ops::ControlFlow;

use texere_core::settling::Length;
use texere_core::{Backend, Origin, Yarns};

use super::bar::RACK;
use super::{Bar, WarpKnitted};
use crate::own::Own;
use crate::settling::settle_repeat;
use crate::{FabricError, Finish, FinishError, Measures, Piece, Repeat, Settled};

/// How many times its length a yarn may be given.
const GIVEN: [f64; 2] = [0.5, 2.0];

/// How far lengths may be off where nothing more is given.
const REACHED: f64 = 0.001;

/// Length of yarn that a bar takes for a rack of 480 courses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunIn {
    /// What the bar asks for, mm.
    pub asked_mm: Option<f64>,
    /// What it is, the mean of its yarns, mm; 0 of a bar without yarn.
    pub reached_mm: f64,
}

impl RunIn {
    /// By what share it is off what was asked for: 0.01 where it is one per cent too long.
    #[must_use]
    pub fn miss(&self) -> Option<f64> {
        Some(self.reached_mm / self.asked_mm? - 1.0)
    }
}

impl WarpKnitted {
    /// Lets the yarns settle: one repeat, which is then copied. See [`settle`](crate::settle()).
    ///
    /// Loops are as high as the run-in of their bar asks for, from 1.45 to 1.75 courses. Where that
    /// is not enough and every bar has a run-in, yarns are given what lacks in all, if `finish`
    /// says nothing of lengths; else they keep the length that they have. How far a bar is off its
    /// run-in then, [`WarpKnitted::run_ins`] says. What [`Settled::clearance`] measures is the
    /// whole cloth, with its cut edges.
    ///
    /// `tension` is that of the splines of all yarns, from 0 to below 1.
    ///
    /// **Errors**: those of [`WarpKnitted::yarns`], of [`Yarns::with_tension`] and of
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
        let settled = settle_repeat(&repeat, |yarns| self.laid(&repeat, yarns), &finish, backend, progress)?;
        Ok(settled.pressed(|yarns| self.measures(yarns).thickness_mm))
    }

    /// `finish` with what becomes of the lengths of [`WarpKnitted::repeat`], where it does not say.
    #[must_use]
    pub fn finish_of(&self, repeat: &Repeat, finish: &Finish) -> Finish {
        let length = finish.length.unwrap_or_else(|| self.length(&repeat.piece));
        Finish { length: Some(length), ..*finish }
    }

    /// What becomes of lengths where nobody says.
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

    /// What each bar takes for a rack of 480 courses, and what it asks for. `yarns` are the cloth's
    /// own; yarns of no guide count for nothing.
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

    /// What of a yarn is the cloth's. All copies are alike: after the last point comes the first
    /// one, the cloth's height further.
    fn own(&self, yarns: &Yarns, yarn: usize) -> Own {
        Own::round(yarns, yarn, self.beyond(), [0.0, self.size_mm()[1]])
    }

    /// Yarn consumption, loops, weight and thickness. `yarns` are the cloth's own. However many
    /// copies of the repeat there are, they have the same numbers: what yarns reach beyond the
    /// cloth does not count.
    #[must_use]
    pub fn measures(&self, yarns: &Yarns) -> Measures {
        let own = |yarn| self.own(yarns, yarn);
        Measures::of_knit(yarns, own, self.loops(), self.size(), self.size_mm())
    }
}
