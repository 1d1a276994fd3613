//! Trials of changes of a cloth: pieces of it are changed and measured again.

use std::collections::HashSet;
use std::ops::{ControlFlow, Range};

use texere_core::{Backend, Origin, Section, Settings};

use super::cures::{Cure, Remedy};
use super::faults::{ClothFault, Diagnosis, Faults, Jams};
use super::places::Crossing;
use crate::{BySet, Crimp, Drawdown, FabricError, Finish, FinishError, Relief, Shape, Thread, Woven};

/// Number of threads to each side of a worst place that are measured with it. It is more than the
/// longest floats of common weaves.
const AROUND: usize = 12;

/// Factor from each spacing that is tried to the next one.
pub(super) const WIDER: f64 = 1.05;
/// Number of spacings that are tried of cloth as it is woven. They begin at the first power of
/// [`WIDER`] at which nothing jams, and end at 2.8 times that (1.05 to the power of 21).
const WIDER_TIMES: i32 = 22;

/// The most crossings of a sample that holds two or three repeats of a cloth. In a cloth with
/// larger repeats, the threads around its worst places are the samples.
const REPEATS_MOST: usize = 4_096;

/// The fewest threads that a sample has besides two repeats.
const BESIDE: usize = 8;

/// Flatnesses (width over height) that are tried for all yarns.
const FLATNESSES: [f32; 7] = [1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0];

/// The warp's shares of the crimp that are tried, in steps of [`SHARE_STEP`]: 0.2 to 0.8, the range
/// of [`Woven::relieve`].
const SHARES: Range<u8> = 4..17;
/// The step of the warp's shares. With half the value, and with twice, no test is red.
const SHARE_STEP: f32 = 0.05;

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
pub(super) type Sample = [Range<usize>; 2];

/// The threads around each of the worst places.
pub(super) fn around_worst(cloth: &Woven, faults: &Faults) -> Vec<Sample> {
    samples(cloth, &worst_crossings(faults))
}

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

/// Two or three repeats of the cloth and some threads more, with both edges as the cloth has them.
/// None if this sample has more than [`REPEATS_MOST`] crossings.
pub(super) fn repeats(cloth: &Woven) -> Option<Vec<Sample>> {
    let repeat = cloth.repeat();
    let sample = cloth.cropped(repeat, repeat.map(|threads| 2 * threads + BESIDE)).map(|count| 0..count);
    (sample[0].len() * sample[1].len() <= REPEATS_MOST).then(|| vec![sample])
}

/// Diameter of the thickest thread of `cloth`, mm.
fn thickest_mm(cloth: &Woven) -> f64 {
    let threads = cloth.warp().iter().chain(cloth.weft());
    2.0 * threads.map(|thread| f64::from(thread.radius_mm)).fold(0.0, f64::max)
}

/// A cloth with which changes are tried.
pub(super) struct Trial<'a> {
    pub(super) cloth: &'a Woven,
    pub(super) faults: &'a Faults,
    pub(super) samples: Vec<Sample>,
    pub(super) touching: f64,
    /// How pieces come to rest; none if they are measured as they are woven.
    pub(super) rest: Option<Rest<'a>>,
}

/// A function that gets the share that is done, from 0 to 1, and may end the work.
pub(super) type On<'a> = dyn FnMut(f64) -> ControlFlow<()> + Send + 'a;

/// The share of a trial's progress at which a piece has come to rest. The piece is then measured.
const RESTED: f64 = 0.7;

fn go_on(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// How pieces of the cloth come to rest before they are measured.
pub(super) struct Rest<'a> {
    pub(super) finish: &'a Finish,
    pub(super) tension: f32,
    pub(super) backend: &'a dyn Backend,
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
    pub(super) fn round(&self) -> Option<Cure> {
        if self.cloth.shape() == Shape::Round {
            return None;
        }
        let mut changed = self.cloth.clone();
        changed.set_shape(Shape::Round);
        Some(self.better(&changed, &mut go_on)?.by(Remedy::Shape(Shape::Round)))
    }

    /// The share of the crimp that cures and is nearest to the present one.
    pub(super) fn share(&self) -> Option<Cure> {
        let before = self.cloth.warp_share();
        let mut shares: Vec<_> = SHARES.map(|step| f32::from(step) * SHARE_STEP).collect();
        shares.sort_by(|a, b| (a - before).abs().total_cmp(&(b - before).abs()));
        shares.into_iter().find_map(|after| {
            let mut changed = self.cloth.clone();
            changed.set_crimp(Crimp::WarpShare(after)).ok()?;
            Some(self.clean(&changed, &mut go_on)?.by(Remedy::WarpShare { before, after }))
        })
    }

    pub(super) fn relief(&self, relief: Relief) -> Option<Cure> {
        let mut changed = self.cloth.clone();
        let report = changed.relieve(relief).ok()?;
        if changed == *self.cloth {
            return None;
        }
        let thickest_mm = [self.cloth, &changed].map(thickest_mm);
        Some(self.better(&changed, &mut go_on)?.by(Remedy::Relief { relief, report, thickest_mm }))
    }

    /// Circular sections for all threads, if the cloth has another section. If all sections are
    /// circles, the least flatness of all threads that cures.
    pub(super) fn flatter(&self) -> Option<Cure> {
        let mut changed = self.cloth.clone();
        if self.cloth.sections().iter().any(|section| *section != Section::Circle) {
            changed.set_section(Section::Circle).ok()?;
            return Some(self.clean(&changed, &mut go_on)?.by(Remedy::Circle));
        }
        FLATNESSES.into_iter().find_map(|flatness| {
            changed.set_flatness(flatness).ok()?;
            Some(self.clean(&changed, &mut go_on)?.by(Remedy::Flatness(flatness)))
        })
    }

    /// The least spacing that cures, and the largest diameters that cure. Both give the same cloth
    /// at different scales.
    pub(super) fn room(&self) -> Vec<Cure> {
        // The pitches give the least spacing at which no thread jams. No closer spacing is tried.
        let jammed = self.faults.jams.iter().filter_map(|jams| jams.threads.first());
        let least = jammed.map(|jam| jam.passing_mm / jam.pitch_mm).fold(1.0, f64::max);
        let first = (least.ln() / WIDER.ln()).ceil().max(1.0) as i32;
        let found = (first..first + WIDER_TIMES).find_map(|times| self.wider(WIDER.powi(times), &mut go_on));
        found.map_or_else(Vec::new, Into::into)
    }

    /// The two cures by room, if threads that lie further apart by `factor` have no fault left.
    /// Thinner yarns give the same cloth at another scale.
    pub(super) fn wider(&self, factor: f64, on: &mut On<'_>) -> Option<[Cure; 2]> {
        let Outcome { clearance, curvature, leaves } =
            self.clean(&self.cloth.spaced([factor; 2]).ok()?, on)?;
        let mean =
            |set: &[Thread]| set.iter().map(|thread| thread.spacing_mm).sum::<f64>() / set.len() as f64;
        let spacing_mm =
            BySet { warp: self.cloth.warp(), weft: self.cloth.weft() }.map(|set| factor * mean(set));
        let thickest = thickest_mm(self.cloth);
        let thickest_mm = [thickest, thickest / factor];
        let remedies = [Remedy::Spacing { spacing_mm, factor }, Remedy::Diameter { thickest_mm }];
        Some(remedies.map(|remedy| Cure { remedy, clearance, curvature, leaves: leaves.clone() }))
    }

    /// The measures of `changed`, if no fault of its threads is left. A cloth that falls apart does
    /// so whatever its yarns. A cloth that still jams is not measured.
    fn clean(&self, changed: &Woven, on: &mut On<'_>) -> Option<Outcome> {
        if self.jams(changed).is_some() {
            return None;
        }
        let clean = |outcome: &Outcome| outcome.leaves.iter().all(|left| *left == ClothFault::FallsApart);
        self.better(changed, on).filter(clean)
    }

    /// The measures of `changed`, if at least one kind of fault is gone.
    fn better(&self, changed: &Woven, on: &mut On<'_>) -> Option<Outcome> {
        let (before, outcome) = (self.faults.kinds(), self.outcome(changed, on)?);
        let leaves = &outcome.leaves;
        let better = before != *leaves && leaves.iter().all(|kind| before.contains(kind));
        better.then_some(outcome)
    }

    /// Whether the samples have the faults of the cloth before it is changed. If they have not,
    /// they can't show whether a change cures. Where threads lack room, a small piece may fold
    /// while a large one is pierced. Crowding, piercing, folds and triangles that face inwards
    /// therefore count as one fault.
    pub(super) fn shows(&self, on: &mut On<'_>) -> bool {
        use ClothFault::{Crowded, Folds, InsideOut, Pierces};
        let as_one = |fault: ClothFault| match fault {
            Crowded | Folds | InsideOut => Pierces,
            other => other,
        };
        let kinds = |all: Vec<ClothFault>| all.into_iter().map(as_one).collect::<HashSet<_>>();
        let known = kinds(self.faults.kinds());
        self.outcome(self.cloth, on).is_some_and(|outcome| kinds(outcome.leaves) == known)
    }

    /// The measures of `changed`. Jams are looked for in the whole cloth, other faults in the
    /// samples. The pieces of the cloth count as unchanged.
    fn outcome(&self, changed: &Woven, on: &mut On<'_>) -> Option<Outcome> {
        let mut left =
            Faults { jams: self.jams(changed), apart: self.faults.apart.clone(), ..Faults::default() };
        let (mut clearance, mut curvature) = (f64::INFINITY, f64::INFINITY);
        for (number, sample) in self.samples.iter().enumerate() {
            let mut on = |share| on((number as f64 + share) / self.samples.len() as f64);
            let found = self.diagnose(changed, sample, &mut on).ok()?;
            left.crowded = left.crowded.or(found.faults.crowded);
            left.pierces.extend(found.faults.pierces);
            left.folds = left.folds.or(found.faults.folds);
            left.wrung = left.wrung.or(found.faults.wrung);
            left.inside_out = left.inside_out.or(found.faults.inside_out);
            clearance = clearance.min(found.clearance.min);
            curvature = curvature.min(found.clearance.bend.radii);
        }
        Some(Outcome { clearance, curvature, leaves: left.kinds() })
    }

    /// Threads that lie too close together, in cloth as it is woven. None for cloth at rest, whose
    /// clearance shows where threads lack room.
    fn jams(&self, changed: &Woven) -> Option<Jams> {
        if self.rest.is_some() { None } else { changed.jams() }
    }

    /// The faults of a sample, as it is woven or at rest.
    fn diagnose(&self, changed: &Woven, sample: &Sample, on: &mut On<'_>) -> Result<Diagnosis, FinishError> {
        let piece = piece(changed, sample)?;
        let Some(Rest { finish, tension, backend }) = self.rest else {
            return Ok(piece.diagnose(self.touching, go_on)?);
        };
        let yarns = piece.at_rest(finish, tension, backend, |share| on(RESTED * share))?.yarns;
        let settings = Settings::default().following(&yarns);
        let measuring = |share| on(RESTED + (1.0 - RESTED) * share);
        let clearance = piece.clearance(&yarns, &settings, measuring)?;
        Ok(Diagnosis::new(self.touching, clearance, None, piece.pieces()))
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
