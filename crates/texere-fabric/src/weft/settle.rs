//! Settling of a weft knit, and its measures.

use std::ops::ControlFlow;

use texere_core::settling::Length;
use texere_core::{Backend, Origin, Yarns};

use super::{Knitted, Stitch};
use crate::own::Own;
use crate::relaxation::relax_repeat;
use crate::settling::{Look, settle_repeat};
use crate::{FabricError, Finish, FinishError, Measures, Piece, RelaxedKnit, Repeat, Settled, settle};

/// Range of the factor by which settling may change the length of a yarn: the range of
/// [`Length::Given`].
const GIVEN: [f64; 2] = [0.5, 2.0];

impl Knitted {
    /// Lets the yarns settle. A cloth that repeats settles as one repeat, which is then copied. A
    /// cloth that does not repeat settles as a whole. See [`settle`].
    ///
    /// If `finish` leaves the lengths open, loops get, in the mean, the length that the program or
    /// the gauge gives, but between half and twice the length that they have. If neither gives a
    /// length for some loop, all lengths are free. [`Settled::clearance`] is the clearance of the
    /// whole cloth, with its cut edges.
    ///
    /// `tension` is the tension of all yarns' splines, from 0 to below 1.
    ///
    /// **Errors**: the errors of [`Knitted::yarns`], of [`Yarns::with_tension`] and of [`settle`].
    pub fn settle(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Settled, FinishError> {
        let repeat = self.repeat()?.with_tension(tension).map_err(FabricError::from)?;
        let finish = self.finish_of(&repeat, finish);
        if self.stitches().repeat.is_none() {
            return settle(&repeat.piece, &finish, backend, progress).map(|settled| self.pressed(settled));
        }
        settle_repeat(&repeat, |yarns, look| self.placed(&repeat, yarns, look), &finish, backend, progress)
            .map(|settled| self.pressed(settled))
    }

    /// Lets the yarns of one repeat come to rest by their energy, and copies the repeat. Wales and
    /// courses follow from the length of the loops, unless [`Finish::hold`] holds them: see
    /// [`RelaxedKnit::gauge`].
    ///
    /// Loops get, in the mean, the length that the program or the gauge gives, or keep the length
    /// that the gauge's wales and courses give them. `finish` may say another length.
    ///
    /// **Errors**: [`FinishError::NoEnergy`] for a cloth that does not repeat,
    /// [`FinishError::Relaxation`] for yarns that can't be relaxed, [`FinishError::Backend`] for a
    /// backend that can't relax yarns, and the errors of [`Knitted::settle`].
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
        let mut relaxed = relax_repeat(&repeat, self.gauge(), &finish, placed, backend, progress)?;
        let measures = self.clone().with_gauge(relaxed.gauge).measured(&relaxed.yarns);
        relaxed.gauge.loop_length_mm = measures.knit.map(|knit| knit.loop_length_mm);
        Ok(relaxed)
    }

    /// The repeat that relaxes.
    pub(crate) fn repeat_of_energy(&self, tension: f32) -> Result<Repeat, FinishError> {
        let repeat = self
            .smallest_repeat()?
            .ok_or(FinishError::NoEnergy { cloth: "this one is whole, with edges" })?;
        Ok(repeat.with_tension(tension).map_err(FabricError::from)?)
    }

    fn pressed(&self, settled: Settled) -> Settled {
        settled.pressed(|yarns| self.measured(yarns).thickness_mm)
    }

    /// `finish`, with a rule for the lengths of [`Knitted::repeat`] if `finish` has no rule for
    /// lengths.
    #[must_use]
    pub fn finish_of(&self, repeat: &Repeat, finish: &Finish) -> Finish {
        let length = finish.length.unwrap_or_else(|| self.length(&repeat.piece, repeat.copies));
        Finish { length: Some(length), ..*finish }
    }

    /// The rule for lengths if the finish has none. Each loop asks for the length that the program
    /// gives, or else for the length of the gauge. All yarns together get the sum of these lengths.
    /// If neither gives a length for some loop, all lengths are free.
    fn length(&self, piece: &Piece, copies: [u32; 2]) -> Length {
        let stitches = &self.stitches().loops;
        let each = |stitch: &Stitch| stitch.length_mm.map(f64::from).or(self.gauge().loop_length_mm);
        match stitches.iter().map(each).sum::<Option<f64>>() {
            Some(asked) => {
                let repeats = self.loops() as f64 / stitches.len() as f64;
                let pieces = f64::from(copies[0]) * f64::from(copies[1]);
                let length_mm = if self.stitches().repeat.is_some() {
                    piece.length_mm()
                } else {
                    let own = |yarn| self.own(&piece.yarns, yarn).length_mm(&piece.yarns, yarn);
                    (0..piece.yarns.layout().yarns().len()).map(own).sum()
                };
                let factor = asked * repeats / pieces / length_mm;
                Length::Given(factor.clamp(GIVEN[0], GIVEN[1]) as f32)
            }
            None => Length::Free { tension: 0.0 },
        }
    }

    /// Number of loops in the whole cloth.
    #[must_use]
    pub fn loops(&self) -> u64 {
        let [across, along] = self.copies().map(u64::from);
        self.stitches().loops.len() as u64 * across * along
    }

    /// The part of a yarn that counts for the cloth. A yarn that goes on from repeat to repeat
    /// counts without its parts beyond the cloth. Any other yarn counts without its first and its
    /// last interval, the outer parts of its tails.
    fn own(&self, yarns: &Yarns, yarn: usize) -> Own {
        let points = yarns.yarn_points(yarn).unwrap_or(&[]);
        if !matches!(yarns.layout().yarns()[yarn].origin, Origin::Course(_)) {
            return Own { points: 1..points.len().saturating_sub(1), onward: None };
        }
        let leftwards = matches!(points, [first, .., last] if last.x < first.x);
        let width = if leftwards { -self.size_mm()[0] } else { self.size_mm()[0] };
        Own::round(yarns, yarn, self.beyond(), [width, 0.0])
    }

    /// Yarn consumption, loops, weight and thickness. `yarns` are the yarns of this cloth. Cut ends
    /// at the edges and tails of yarns do not count, so that every copy of a repeat has the same
    /// numbers.
    ///
    /// **Errors**: none.
    pub fn measures(&self, yarns: &Yarns) -> Result<Measures, FabricError> {
        Ok(self.measured(yarns))
    }

    fn measured(&self, yarns: &Yarns) -> Measures {
        let own = |yarn| self.own(yarns, yarn);
        Measures::of_knit(yarns, own, self.loops(), self.size(), self.size_mm())
    }
}
