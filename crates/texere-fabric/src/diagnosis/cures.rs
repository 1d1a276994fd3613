//! What would cure a cloth: each cure is one change, with which its worst places are measured
//! again.

use std::ops::{ControlFlow, Range};

use texere_core::{Origin, Section};

use super::faults::{ClothFault, Diagnosis, Faults};
use super::places::Crossing;
use crate::{Crimp, Drawdown, FabricError, JamReport, Relief, Shape, Thread, Woven, WovenDesign};

/// Threads each way of a worst place that are measured with it: more than the longest floats of
/// common weaves.
const AROUND: usize = 12;

/// Spacings are tried this much wider, again and again, from where nothing jams to three times
/// that.
const WIDER: f64 = 1.05;
const WIDER_TIMES: i32 = 22;

/// Flatnesses of all yarns that are tried.
const FLATNESSES: [f32; 7] = [1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0];

/// Shares of the crimp that are tried: [`Woven::relieve`] goes no further either.
const SHARES: Range<u8> = 4..17;
const SHARE_STEP: f32 = 0.05;

/// One change that was tried and helps.
#[derive(Debug, Clone, PartialEq)]
pub struct Cure {
    /// What is changed.
    pub remedy: Remedy,
    /// The least clearance with it, at what were the worst places.
    pub clearance: f64,
    /// The tightest bend there, in yarn radii.
    pub curvature: f64,
    /// What it does not cure.
    pub leaves: Vec<ClothFault>,
}

/// A change of a cloth.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Remedy {
    /// Another shape, as by [`Woven::set_shape`].
    Shape(Shape),
    /// Another share of the crimp for the warp, as by [`Crimp::WarpShare`].
    WarpShare {
        /// The share now.
        before: f32,
        /// The share that cures.
        after: f32,
    },
    /// Relief, as by [`Woven::relieve`].
    Relief {
        /// Which.
        relief: Relief,
        /// What it changes.
        report: JamReport,
        /// Diameter of the thickest thread before and after, mm.
        thickest_mm: [f64; 2],
    },
    /// Circular sections for all threads, as by [`Woven::set_section`].
    Circle,
    /// All threads flattened alike, as by [`Woven::set_flatness`]: width over height.
    Flatness(f32),
    /// All threads further apart.
    Spacing {
        /// Mean spacing of ends and of picks, mm.
        spacing_mm: [f64; 2],
        /// By how much wider all spacings are.
        factor: f64,
    },
    /// All threads thinner.
    Diameter {
        /// Diameter of the thickest thread before and after, mm.
        thickest_mm: [f64; 2],
    },
}

impl WovenDesign {
    /// Looks for single changes that help against the faults of `diagnosis`, which is that of the
    /// design's cloth. Each is tried on pieces of the cloth round its worst places. A cure ends one
    /// kind of fault at least and adds none.
    ///
    /// `progress` gets the share of the changes that were tried; `Break` ends the search with what
    /// was found so far.
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
        let trial = Trial { cloth, faults, samples: samples(cloth, &worst_crossings(faults)), touching };
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
}

/// One crossing of each of the worst places.
fn worst_crossings(faults: &Faults) -> Vec<Crossing> {
    let pierced = faults.pierces.first().and_then(|contact| {
        let [one, other] = contact.places;
        one.crossing.or(other.crossing)
    });
    let folded = faults.folds.and_then(|bend| bend.place?.crossing);
    let crowded = faults.crowded.and_then(|crowd| crowd.place.crossing);
    let jammed = faults.jams.as_ref().and_then(|jams| match jams.threads.first()?.thread {
        Origin::End(end) => Some(Crossing { end, pick: 1 }),
        Origin::Pick(pick) => Some(Crossing { end: 1, pick }),
        _ => None,
    });
    let wrung = faults.wrung.and_then(|drawn| drawn.width_at?.crossing);
    let turned = faults.inside_out.and_then(|drawn| drawn.inwards_at?.crossing);
    let mut places: Vec<_> =
        [crowded, pierced, folded, jammed, wrung, turned].into_iter().flatten().collect();
    if places.is_empty() {
        // In a turn of the weft: they are all alike.
        places.push(Crossing { end: 1, pick: 1 });
    }
    places
}

/// A few of the ends, and of the picks, of a cloth.
type Sample = [Range<usize>; 2];

/// The threads round each of `places`: of a small cloth they are all the same.
fn samples(cloth: &Woven, places: &[Crossing]) -> Vec<Sample> {
    let around = |at: u32, count: usize| {
        let at = at as usize;
        // From an odd thread on, so that picks turn back at the sides at which they did.
        let first = at.saturating_sub(AROUND) / 2 * 2;
        first..(at + AROUND).min(count)
    };
    let (ends, picks) = (cloth.drawdown().ends(), cloth.drawdown().picks());
    let mut samples: Vec<Sample> = Vec::new();
    for place in places {
        let sample = [around(place.end, ends), around(place.pick, picks)];
        if !samples.contains(&sample) {
            samples.push(sample);
        }
    }
    samples
}

/// How thick the thickest thread of `cloth` is, mm.
fn thickest_mm(cloth: &Woven) -> f64 {
    let threads = cloth.warp().iter().chain(cloth.weft());
    2.0 * threads.map(|thread| f64::from(thread.radius_mm)).fold(0.0, f64::max)
}

/// A cloth that is tried with changes.
struct Trial<'a> {
    cloth: &'a Woven,
    faults: &'a Faults,
    samples: Vec<Sample>,
    touching: f64,
}

/// What a changed cloth comes to.
struct Outcome {
    clearance: f64,
    curvature: f64,
    leaves: Vec<ClothFault>,
}

impl Outcome {
    fn by(self, remedy: Remedy) -> Cure {
        let Self { clearance, curvature, leaves } = self;
        Cure { remedy, clearance, curvature, leaves }
    }
}

impl Trial<'_> {
    fn round(&self) -> Option<Cure> {
        if self.cloth.shape() == Shape::Round {
            return None;
        }
        let mut changed = self.cloth.clone();
        changed.set_shape(Shape::Round);
        Some(self.better(&changed)?.by(Remedy::Shape(Shape::Round)))
    }

    /// The nearest share of the crimp that cures.
    fn share(&self) -> Option<Cure> {
        let before = self.cloth.warp_share();
        let mut shares: Vec<_> = SHARES.map(|step| f32::from(step) * SHARE_STEP).collect();
        shares.sort_by(|a, b| (a - before).abs().total_cmp(&(b - before).abs()));
        shares.into_iter().find_map(|after| {
            let mut changed = self.cloth.clone();
            changed.set_crimp(Crimp::WarpShare(after)).ok()?;
            Some(self.clean(&changed)?.by(Remedy::WarpShare { before, after }))
        })
    }

    fn relief(&self, relief: Relief) -> Option<Cure> {
        let mut changed = self.cloth.clone();
        let report = changed.relieve(relief).ok()?;
        if changed == *self.cloth {
            return None;
        }
        let thickest_mm = [self.cloth, &changed].map(thickest_mm);
        Some(self.better(&changed)?.by(Remedy::Relief { relief, report, thickest_mm }))
    }

    /// Circular sections where there are others, else the least flatness of all yarns that cures.
    fn flatter(&self) -> Option<Cure> {
        let mut changed = self.cloth.clone();
        if self.cloth.sections().iter().any(|section| *section != Section::Circle) {
            changed.set_section(Section::Circle).ok()?;
            return Some(self.clean(&changed)?.by(Remedy::Circle));
        }
        FLATNESSES.into_iter().find_map(|flatness| {
            changed.set_flatness(flatness).ok()?;
            Some(self.clean(&changed)?.by(Remedy::Flatness(flatness)))
        })
    }

    /// The least spacing of all threads that cures; and the greatest diameters, which are the same
    /// cloth in small.
    fn room(&self) -> Vec<Cure> {
        // What jams is known from its numbers: nothing closer need be tried.
        let jammed = self.faults.jams.iter().filter_map(|jams| jams.threads.first());
        let least = jammed.map(|jam| jam.passing_mm / jam.pitch_mm).fold(1.0, f64::max);
        let first = (least.ln() / WIDER.ln()).ceil().max(1.0) as i32;
        let found = (first..first + WIDER_TIMES)
            .map(|times| WIDER.powi(times))
            .find_map(|factor| Some((factor, self.clean(&self.cloth.spaced([factor; 2]).ok()?)?)));
        let Some((factor, Outcome { clearance, curvature, .. })) = found else { return Vec::new() };
        let mean =
            |set: &[Thread]| set.iter().map(|thread| thread.spacing_mm).sum::<f64>() / set.len() as f64;
        let spacing_mm = [self.cloth.warp(), self.cloth.weft()].map(|set| factor * mean(set));
        let thickest = thickest_mm(self.cloth);
        let thickest_mm = [thickest, thickest / factor];
        [Remedy::Spacing { spacing_mm, factor }, Remedy::Diameter { thickest_mm }]
            .map(|remedy| Cure { remedy, clearance, curvature, leaves: Vec::new() })
            .into()
    }

    /// What `changed` comes to, if nothing is left of the faults. What still jams need not be
    /// measured.
    fn clean(&self, changed: &Woven) -> Option<Outcome> {
        if changed.jams().is_some() {
            return None;
        }
        self.better(changed).filter(|outcome| outcome.leaves.is_empty())
    }

    /// What `changed` comes to, if one kind of fault is gone at least: jams everywhere, the others
    /// at the worst places.
    fn better(&self, changed: &Woven) -> Option<Outcome> {
        let mut left = Faults { jams: changed.jams(), apart: self.faults.apart.clone(), ..Faults::default() };
        let (mut clearance, mut curvature) = (f64::INFINITY, f64::INFINITY);
        for sample in &self.samples {
            let piece = piece(changed, sample).ok()?;
            let found = piece.diagnose(self.touching, |_| ControlFlow::Continue(())).ok()?;
            left.crowded = left.crowded.or(found.faults.crowded);
            left.pierces.extend(found.faults.pierces);
            left.folds = left.folds.or(found.faults.folds);
            left.wrung = left.wrung.or(found.faults.wrung);
            left.inside_out = left.inside_out.or(found.faults.inside_out);
            clearance = clearance.min(found.clearance.min);
            curvature = curvature.min(found.clearance.bend.radii);
        }
        let (before, leaves) = (self.faults.kinds(), left.kinds());
        let better = before != leaves && leaves.iter().all(|kind| before.contains(kind));
        better.then_some(Outcome { clearance, curvature, leaves })
    }
}

/// A sample of `cloth`.
fn piece(cloth: &Woven, [ends, picks]: &Sample) -> Result<Woven, FabricError> {
    let up = |end, pick| cloth.drawdown().up(ends.start + end, picks.start + pick);
    let drawdown = Drawdown::from_fn(ends.len(), picks.len(), up)?;
    let mut piece =
        cloth.like(drawdown, cloth.warp()[ends.clone()].to_vec(), cloth.weft()[picks.clone()].to_vec())?;
    // By the stiffness of its own threads alone it might have another one.
    piece.set_crimp(Crimp::WarpShare(cloth.warp_share()))?;
    Ok(piece)
}
