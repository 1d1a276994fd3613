//! A knit settles, and what is measured of it then.

use std::ops::ControlFlow;

use texere_core::settling::Length;
use texere_core::{Backend, Origin, Yarns};

use super::{Knitted, Stitch};
use crate::own::Own;
use crate::settling::settle_repeat;
use crate::{FabricError, Finish, FinishError, Measures, Piece, Repeat, Settled, settle};

/// How many times its length a yarn may be given.
const GIVEN: [f64; 2] = [0.5, 2.0];

impl Knitted {
    /// Lets the yarns settle: one repeat, which is then copied, or the whole cloth where none
    /// repeats. See [`settle`].
    ///
    /// Where `finish` says nothing of lengths, the mean loop gets the length that the gauge asks
    /// for; where that asks for none, lengths are free. What [`Settled::clearance`] measures is the
    /// whole cloth, with its cut edges.
    ///
    /// `tension` is that of the splines of all yarns, from 0 to below 1.
    ///
    /// **Errors**: those of [`Knitted::yarns`], of [`Yarns::with_tension`] and of [`settle`].
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
        settle_repeat(&repeat, |yarns| self.laid(&repeat, yarns), &finish, backend, progress)
            .map(|settled| self.pressed(settled))
    }

    fn pressed(&self, settled: Settled) -> Settled {
        settled.pressed(|yarns| self.measured(yarns).thickness_mm)
    }

    /// `finish` with what becomes of the lengths of [`Knitted::repeat`], where it does not say.
    #[must_use]
    pub fn finish_of(&self, repeat: &Repeat, finish: &Finish) -> Finish {
        let length = finish.length.unwrap_or_else(|| self.length(&repeat.piece, repeat.copies));
        Finish { length: Some(length), ..*finish }
    }

    /// What becomes of lengths where nobody says: all loops together get what each of them asks
    /// for, or else the gauge.
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

    /// Loops of the whole cloth.
    #[must_use]
    pub fn loops(&self) -> u64 {
        let [across, along] = self.copies().map(u64::from);
        self.stitches().loops.len() as u64 * across * along
    }

    /// What of a yarn is the cloth's: one that goes on from repeat to repeat without what reaches
    /// beyond them, another one without the tails that hang out beyond its first and its last
    /// stitch.
    fn own(&self, yarns: &Yarns, yarn: usize) -> Own {
        let points = yarns.yarn_points(yarn).unwrap_or(&[]);
        if !matches!(yarns.layout().yarns()[yarn].origin, Origin::Course(_)) {
            return Own { points: 1..points.len().saturating_sub(1), onward: None };
        }
        let leftwards = matches!(points, [first, .., last] if last.x < first.x);
        let width = if leftwards { -self.size_mm()[0] } else { self.size_mm()[0] };
        Own::round(yarns, yarn, self.beyond(), [width, 0.0])
    }

    /// Yarn consumption, loops, weight and thickness. `yarns` are the cloth's own. However many
    /// copies of a repeat there are, they have the same numbers: what is cut off at the edges does
    /// not count, nor do the tails of other yarns.
    ///
    /// **Errors**: none so far.
    pub fn measures(&self, yarns: &Yarns) -> Result<Measures, FabricError> {
        Ok(self.measured(yarns))
    }

    fn measured(&self, yarns: &Yarns) -> Measures {
        let own = |yarn| self.own(yarns, yarn);
        Measures::of_knit(yarns, own, self.loops(), self.size(), self.size_mm())
    }
}
