//! Cures for a cloth. Each cure is one change. To try a change, the cloth around the places that
//! were the worst is measured again.

use std::ops::{ControlFlow, Range};

use texere_core::{Origin, Section};

use super::faults::{ClothFault, Diagnosis, Faults};
use super::places::Crossing;
use crate::{BySet, Crimp, Drawdown, FabricError, JamReport, Relief, Shape, Thread, Woven, WovenDesign};

/// Number of threads to each side of a worst place that are measured with it. It is more than the
/// longest floats of common weaves.
const AROUND: usize = 12;

/// Factor from each spacing that is tried to the next one.
const WIDER: f64 = 1.05;
/// Number of spacings that are tried. They begin at the first power of [`WIDER`] at which nothing
/// jams, and end at 2.8 times that (1.05 to the power of 21).
const WIDER_TIMES: i32 = 22;

/// Flatnesses (width over height) that are tried for all yarns.
const FLATNESSES: [f32; 7] = [1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0];

/// The warp's shares of the crimp that are tried, in steps of [`SHARE_STEP`]: 0.2 to 0.8, the range
/// of [`Woven::relieve`].
const SHARES: Range<u8> = 4..17;
const SHARE_STEP: f32 = 0.05;

/// A change of the cloth that helps.
#[derive(Debug, Clone, PartialEq)]
pub struct Cure {
    /// The change.
    pub remedy: Remedy,
    /// The least clearance with the change, at the places that were the worst.
    pub clearance: f64,
    /// The tightest bend at these places: its radius over the distance by which the section reaches
    /// into the bend.
    pub curvature: f64,
    /// Faults that the change does not cure.
    pub leaves: Vec<ClothFault>,
}

/// A change of a cloth that may cure it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Remedy {
    /// Another shape, see [`Woven::set_shape`].
    Shape(Shape),
    /// Another share of the crimp for the warp, see [`Crimp::WarpShare`].
    WarpShare {
        /// The warp's share before the change.
        before: f32,
        /// The warp's share with the change.
        after: f32,
    },
    /// Relief, see [`Woven::relieve`].
    Relief {
        /// The kind of relief.
        relief: Relief,
        /// The changes that it makes.
        report: JamReport,
        /// Diameter of the thickest thread before and after, mm.
        thickest_mm: [f64; 2],
    },
    /// Circular sections for all threads, see [`Woven::set_section`].
    Circle,
    /// One flatness, width over height, for all threads: see [`Woven::set_flatness`].
    Flatness(f32),
    /// All threads further apart.
    Spacing {
        /// Mean spacing of ends and of picks with the change, mm.
        spacing_mm: BySet<f64>,
        /// Factor by which all spacings are wider.
        factor: f64,
    },
    /// All threads thinner.
    Diameter {
        /// Diameter of the thickest thread before and after, mm.
        thickest_mm: [f64; 2],
    },
}

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
        // No worst place lies at a crossing. All of them may lie in turns of the weft, for example.
        // Turns are alike, so the turns near the first crossing stand for all.
        places.push(Crossing { end: 1, pick: 1 });
    }
    places
}

/// A range of ends and a range of picks.
type Sample = [Range<usize>; 2];

/// The threads around each of `places`, without duplicates. In a small cloth all places have the
/// same threads.
fn samples(cloth: &Woven, places: &[Crossing]) -> Vec<Sample> {
    let around = |at: u32, count: usize| {
        let at = at as usize;
        // The first pick of the sample has an even number, so that picks turn back on the same
        // sides as in the cloth.
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

/// Diameter of the thickest thread of `cloth`, mm.
fn thickest_mm(cloth: &Woven) -> f64 {
    let threads = cloth.warp().iter().chain(cloth.weft());
    2.0 * threads.map(|thread| f64::from(thread.radius_mm)).fold(0.0, f64::max)
}

/// A cloth with which changes are tried.
struct Trial<'a> {
    cloth: &'a Woven,
    faults: &'a Faults,
    samples: Vec<Sample>,
    touching: f64,
}

/// The measures of a changed cloth.
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

    /// The share of the crimp that cures and is nearest to the present one.
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

    /// Circular sections for all threads, if the cloth has another section. If all sections are
    /// circles, the least flatness of all threads that cures.
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

    /// The least spacing that cures, and the largest diameters that cure. Both give the same cloth
    /// at different scales.
    fn room(&self) -> Vec<Cure> {
        // The pitches give the least spacing at which no thread jams. No closer spacing is tried.
        let jammed = self.faults.jams.iter().filter_map(|jams| jams.threads.first());
        let least = jammed.map(|jam| jam.passing_mm / jam.pitch_mm).fold(1.0, f64::max);
        let first = (least.ln() / WIDER.ln()).ceil().max(1.0) as i32;
        let found = (first..first + WIDER_TIMES)
            .map(|times| WIDER.powi(times))
            .find_map(|factor| Some((factor, self.clean(&self.cloth.spaced([factor; 2]).ok()?)?)));
        let Some((factor, Outcome { clearance, curvature, .. })) = found else { return Vec::new() };
        let mean =
            |set: &[Thread]| set.iter().map(|thread| thread.spacing_mm).sum::<f64>() / set.len() as f64;
        let spacing_mm =
            BySet { warp: self.cloth.warp(), weft: self.cloth.weft() }.map(|set| factor * mean(set));
        let thickest = thickest_mm(self.cloth);
        let thickest_mm = [thickest, thickest / factor];
        [Remedy::Spacing { spacing_mm, factor }, Remedy::Diameter { thickest_mm }]
            .map(|remedy| Cure { remedy, clearance, curvature, leaves: Vec::new() })
            .into()
    }

    /// The measures of `changed`, if no fault is left. A cloth that still jams is not measured.
    fn clean(&self, changed: &Woven) -> Option<Outcome> {
        if changed.jams().is_some() {
            return None;
        }
        self.better(changed).filter(|outcome| outcome.leaves.is_empty())
    }

    /// The measures of `changed`, if at least one kind of fault is gone. Jams are looked for in the
    /// whole cloth, other faults at the worst places. The pieces of the cloth count as unchanged.
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

/// Cuts a sample out of `cloth`.
fn piece(cloth: &Woven, [ends, picks]: &Sample) -> Result<Woven, FabricError> {
    let up = |end, pick| cloth.drawdown().up(ends.start + end, picks.start + pick);
    let drawdown = Drawdown::from_fn(ends.len(), picks.len(), up)?;
    let mut piece =
        cloth.like(drawdown, cloth.warp()[ends.clone()].to_vec(), cloth.weft()[picks.clone()].to_vec())?;
    // The threads of the sample alone might give the warp another share of the crimp.
    piece.set_crimp(Crimp::WarpShare(cloth.warp_share()))?;
    Ok(piece)
}
