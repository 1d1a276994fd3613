//! The search for cures. To try a change, the cloth around the places that were the worst is
//! measured again.

use std::ops::ControlFlow;

use texere_core::Backend;

use super::cures::Cure;
use super::faults::{ClothFault, Diagnosis};
use super::trial::{Rest, Trial, WIDER, around_worst, repeats};
use crate::{Finish, Relief, WovenDesign};

/// The powers of [`WIDER`] that are tried first for cloth at rest. They are few, because each rest
/// takes time. The range between the last power that is not clean and the first clean one is then
/// halved again and again.
const WIDER_FIRST: [i32; 6] = [1, 2, 4, 8, 16, 32];

/// The most times that a cloth comes to rest: as it is, with all powers of [`WIDER_FIRST`], and
/// with those of four halvings.
const AT_REST_MOST: u32 = 11;

impl WovenDesign {
    /// Looks for single changes that help against the faults of `diagnosis`, the diagnosis of this
    /// design's cloth. Each change is tried on pieces of the cloth around its worst places. A cure
    /// ends at least one kind of fault, and adds none.
    ///
    /// `progress` gets the share of the kinds of change that have been tried. `Break` ends the
    /// search with the cures found so far.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{Relief, Remedy, Thread, Weave, Woven, WovenDesign};
    /// let twill = Weave::parse("3/1")?.drawdown(20, 16)?;
    /// let (warp, weft) = (vec![Thread::new(0.4, 0.15); 20], vec![Thread::new(0.66, 0.15); 16]);
    /// let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let design = WovenDesign::new(cloth, None, Relief::Report)?;
    /// let diagnosis = design.cloth().diagnose(0.985, |_| ControlFlow::Continue(()))?;
    /// let cures = design.cures(&diagnosis, |_| ControlFlow::Continue(()));
    /// let wider = cures.iter().find(|cure| matches!(cure.remedy, Remedy::Spacing { .. }));
    /// assert!(wider.is_some_and(|cure| cure.leaves.is_empty()));
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    pub fn cures(
        &self,
        diagnosis: &Diagnosis,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Vec<Cure> {
        let (cloth, faults, touching) = (self.cloth(), &diagnosis.faults, diagnosis.touching);
        let samples = around_worst(cloth, faults);
        let trial = Trial { cloth, faults, samples, touching, rest: None };
        let relief = |relief| if self.is_relieved() { None } else { trial.relief(relief) };
        let kinds: [&dyn Fn() -> Vec<Cure>; 6] = [
            &|| trial.round().into_iter().collect(),
            &|| trial.share().into_iter().collect(),
            &|| relief(Relief::Flatten).into_iter().collect(),
            &|| trial.flatter().into_iter().collect(),
            &|| trial.room(),
            &|| relief(Relief::Shrink).into_iter().collect(),
        ];
        let mut cures = Vec::new();
        for (number, kind) in (1..).zip(kinds) {
            cures.extend(kind());
            if progress(f64::from(number) / kinds.len() as f64).is_break() {
                break;
            }
        }
        cures
    }

    /// Looks for a wider spacing and for thinner yarns with which the cloth has no fault at rest,
    /// but for falling apart. `diagnosis` is that of the cloth at rest. Each change is tried with a
    /// piece of the cloth, which comes to rest on `backend` as `finish` says. The piece has two or
    /// three repeats or, if these are large, the threads around the worst places. There are no
    /// cures if the piece, before it is changed, does not have the same kinds of fault as the
    /// cloth. `tension` is the tension of the yarns' splines.
    ///
    /// There are no cures of a [relieved](Self::is_relieved) design, because relief would change
    /// with the spacing. `progress` gets the share that is done, from 0 to 1. `Break` ends the
    /// search without a cure.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Section};
    /// use texere_cpu::SerialBackend;
    /// use texere_fabric::{Finish, Relief, Structure, Thread, Weave, Woven, WovenDesign};
    /// // Plain weave at 0.7 diameters: more yarn than there is room for.
    /// let plain = Weave::parse("plain")?.drawdown(4, 4)?;
    /// let threads = vec![Thread::new(0.14, 0.1); 4];
    /// let cloth = Woven::new(plain, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
    /// let (finish, cpu, go_on) = (Finish::default(), SerialBackend::new(), |_| ControlFlow::Continue(()));
    /// let design = WovenDesign::new(cloth, None, Relief::Report)?;
    /// let structure = Structure::Woven(design.clone());
    /// let finished = structure.settle(&finish, 0.0, &cpu, go_on)?;
    /// let diagnosis = structure.diagnose_finished(&finished, 0.985, go_on)?;
    /// let cures = design.cures_at_rest(&diagnosis, &finish, 0.0, &cpu, go_on);
    /// assert!(cures.len() == 2 && cures.iter().all(|cure| cure.leaves.is_empty()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cures_at_rest(
        &self,
        diagnosis: &Diagnosis,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Vec<Cure> {
        let (cloth, faults, touching) = (self.cloth(), &diagnosis.faults, diagnosis.touching);
        if self.is_relieved() || faults.kinds().iter().all(|fault| *fault == ClothFault::FallsApart) {
            return Vec::new();
        }
        let samples = repeats(cloth).unwrap_or_else(|| around_worst(cloth, faults));
        let rest = Some(Rest { finish, tension, backend });
        let trial = Trial { cloth, faults, samples, touching, rest };
        let (mut tried, mut stopped) = (0, false);
        // Once `progress` has stopped the search, each further trial ends at once.
        let mut on = |number: u32, share: f64| {
            let done = (f64::from(number) + share) / f64::from(AT_REST_MOST);
            stopped |= stopped || progress(done).is_break();
            if stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        if !trial.shows(&mut |share| on(0, share)) {
            return Vec::new();
        }
        let mut clean = |times: i32| {
            tried += 1;
            trial.wider(WIDER.powi(times), &mut |share| on(tried, share))
        };
        let (mut failed, mut found) = (0, None);
        for times in WIDER_FIRST {
            found = clean(times).map(|cures| (times, cures));
            if found.is_some() {
                break;
            }
            failed = times;
        }
        while let Some((times, _)) = found.as_ref().filter(|(times, _)| times - failed > 1) {
            let middle = i32::midpoint(failed, *times);
            match clean(middle) {
                Some(cures) => found = Some((middle, cures)),
                None => failed = middle,
            }
        }
        found.filter(|_| !stopped).map_or_else(Vec::new, |(_, cures)| cures.into())
    }
}
