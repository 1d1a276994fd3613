//! A knit settles, and what is measured of it then.

use std::ops::ControlFlow;

use texere_core::settling::Length;
use texere_core::{Backend, Layout, Material, Settings, Yarns};

use super::{Knitted, Stitch};
use crate::{
    FabricError, Finish, FinishError, KnitMeasures, Measures, Piece, Repeat, Settled, YarnPlace,
    clearance_with_progress, lengths_by_material, lengths_mm, settle, thickness_mm, weight_g,
};

/// How many times its length a yarn may be given.
const GIVEN: [f64; 2] = [0.5, 2.0];

/// The share of the progress at which one repeat has settled, and its copies are measured.
const SETTLED: f64 = 0.8;

impl Knitted {
    /// Lets the yarns settle: one repeat, which is then copied, or the whole cloth where none repeats. See [`settle`].
    ///
    /// Where `finish` says nothing of lengths, the mean loop gets the length that the gauge asks for; where that asks for none,
    /// lengths are free. What [`Settled::clearance`] measures is the whole cloth, with its cut edges.
    ///
    /// **Errors**: those of [`Knitted::yarns`] and of [`settle`].
    pub fn settle(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Settled, FinishError> {
        let repeat = self.repeat()?;
        let finish = self.finish_of(&repeat, finish, tension);
        if self.stitches().repeat.is_none() {
            return settle(&repeat.piece, &finish, tension, backend, progress);
        }
        let mut settled = settle(&repeat.piece, &finish, tension, backend, |done| progress(SETTLED * done))?;
        let yarns = self.laid(&repeat, &settled.yarns)?;
        let settings = Settings { tension, ..Settings::default() };
        settled.clearance =
            clearance_with_progress(&yarns, &settings, |done| progress(SETTLED + (1.0 - SETTLED) * done))?;
        for passage in &mut settled.linking.worst {
            passage.places =
                passage.places.map(|place| laid_at(&place, settled.yarns.layout(), yarns.layout()));
        }
        Ok(Settled { yarns, ..settled })
    }

    /// `finish` with what becomes of the lengths of [`Knitted::repeat`], where it does not say.
    #[must_use]
    pub fn finish_of(&self, repeat: &Repeat, finish: &Finish, tension: f32) -> Finish {
        let length = finish.length.unwrap_or_else(|| self.length(&repeat.piece, repeat.copies, tension));
        Finish { length: Some(length), ..*finish }
    }

    /// What becomes of lengths where nobody says: all loops together get what each of them asks for, or else the gauge.
    fn length(&self, piece: &Piece, copies: [u32; 2], tension: f32) -> Length {
        let stitches = &self.stitches().loops;
        let each = |stitch: &Stitch| stitch.length_mm.map(f64::from).or(self.gauge().loop_length_mm);
        match stitches.iter().map(each).sum::<Option<f64>>() {
            Some(asked) => {
                let repeats = self.loops() as f64 / stitches.len() as f64;
                let pieces = f64::from(copies[0]) * f64::from(copies[1]);
                let factor = asked * repeats / pieces / piece.length_mm(tension);
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

    /// Yarn consumption, loops, weight and thickness. `yarns` are the cloth's own, their splines of `tension`.
    ///
    /// **Errors**: [`FabricError::OtherYarns`] where these are not the cloth's yarns.
    pub fn measures(&self, yarns: &Yarns, tension: f32) -> Result<Measures, FabricError> {
        let length_mm = lengths_by_material(yarns, &lengths_mm(yarns, tension));
        let [width, height] = self.size_mm();
        let (loops, area) = (self.loops(), width * height);
        let loop_length_mm = length_mm.iter().sum::<f64>() / loops as f64;
        Ok(Measures {
            crimp: None,
            cover: None,
            knit: Some(KnitMeasures {
                loops,
                size: self.size(),
                loop_length_mm,
                stitch_density: loops as f64 / (area * 0.01),
                tightness: tex(&length_mm, yarns.materials()).map(|tex| tex.sqrt() / (loop_length_mm * 0.1)),
            }),
            areal_weight: weight_g(&length_mm, yarns.materials()).map(|grams| grams / (area * 1e-6)),
            length_mm,
            thickness_mm: thickness_mm(yarns, tension),
        })
    }
}

/// The tex of all materials that are used, if it is one.
fn tex(length_mm: &[f64], materials: &[Material]) -> Option<f64> {
    let used = materials.iter().zip(length_mm).filter(|(_, length)| **length > 0.0);
    let mut tex = used.map(|(material, _)| material.tex.map(f64::from));
    let first = tex.next()??;
    tex.all(|other| other == Some(first)).then_some(first)
}

/// A place on a yarn of the repeat, on that yarn's first copy.
fn laid_at(place: &YarnPlace, repeat: &Layout, laid: &Layout) -> YarnPlace {
    let origin = repeat.yarns()[place.yarn].origin;
    let yarn = laid.yarns().iter().position(|yarn| yarn.origin == origin);
    YarnPlace { yarn: yarn.unwrap_or(place.yarn), ..*place }
}
