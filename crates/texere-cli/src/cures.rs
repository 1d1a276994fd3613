//! What would cure a cloth, tried out: each cure is one change of the design, with which its worst places are measured again.

use std::fmt;
use std::ops::{ControlFlow, Range, RangeInclusive};

use serde::Serialize;
use texere::{Crimp, Design, Drawdown, FabricError, Jam, Section, Shape, Thread, Woven};

use crate::check::{Faults, Jams};
use crate::places::Crossing;

/// Threads each way of a worst place that are measured with it: more than the longest floats of common weaves.
const AROUND: usize = 12;

/// Spacings are tried this much wider, again and again, from where nothing jams to three times that.
const WIDER: f64 = 1.05;
const WIDER_TIMES: i32 = 22;

/// Spacings and diameters that a design file may say, mm.
const LENGTHS_MM: RangeInclusive<f64> = 0.001..=1000.0;

/// Widths over heights that are tried: what real yarns are pressed to, and ribbons.
const ASPECTS: [f32; 7] = [1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0];

/// Shares of the crimp that are tried: [`texere::Woven::relieve`] goes no further either.
const SHARES: Range<u8> = 4..17;
const SHARE_STEP: f32 = 0.05;

/// One change of a design that cures it.
#[derive(Debug, Serialize)]
pub(crate) struct Cure {
    /// The key of the design file.
    key: &'static str,
    /// What to write there.
    value: String,
    /// What that comes to.
    effect: String,
    /// The least clearance and the tightest bend with it, at what were the worst places.
    clearance: f64,
    curvature: f64,
    /// What it does not cure.
    leaves: Option<String>,
}

impl fmt::Display for Cure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, value, effect, clearance, curvature, leaves } = self;
        write!(
            f,
            "{key} = {value}: {effect}; then {clearance:.4} of touching, bends of {curvature:.2} radii"
        )?;
        leaves.iter().try_for_each(|left| write!(f, ", but it still {left}"))
    }
}

/// The cures of `cloth`, the cloth of `design`, that were found; `progress` is told the share of them that was tried.
pub(crate) fn of(
    design: &Design,
    cloth: &Woven,
    faults: &Faults,
    touching: f64,
    mut progress: impl FnMut(f64) -> ControlFlow<()>,
) -> Vec<Cure> {
    let trial = Trial { cloth, faults, samples: samples(cloth, &places(faults)), touching };
    let relieved = design.jam.scaled != 1.0
        || design.jam.widened != [1.0; 2]
        || design.jam.warp_share[0] != design.jam.warp_share[1];
    let relief = |jam| if relieved { None } else { trial.relief(jam) };
    let kinds: [&dyn Fn() -> Vec<Cure>; 6] = [
        &|| trial.round().into_iter().collect(),
        &|| trial.share().into_iter().collect(),
        &|| relief(Jam::Flatten).into_iter().collect(),
        &|| trial.section().into_iter().collect(),
        &|| trial.room(),
        &|| relief(Jam::Shrink).into_iter().collect(),
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

/// One crossing of each of the worst places.
fn places(faults: &Faults) -> Vec<Crossing> {
    let pierced = faults.pierces.iter().flat_map(|pierces| &pierces.worst).take(1);
    let pierced = pierced.flat_map(|contact| contact.crossings.into_iter().flatten().take(1));
    let folded = faults.folds.iter().filter_map(|bend| bend.crossing);
    let crowded = faults.crowded.iter().filter_map(|crowd| crowd.crossing);
    let jammed = faults.jams.iter().filter_map(|jams| jams.threads.first()).map(|jam| jam.crossing);
    let mut places: Vec<_> = crowded.chain(pierced).chain(folded).chain(jammed).collect();
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
    let around = |at: usize, count: usize| {
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

impl Trial<'_> {
    fn round(&self) -> Option<Cure> {
        if self.cloth.shape() == Shape::Round {
            return None;
        }
        let mut changed = self.cloth.clone();
        changed.set_shape(Shape::Round);
        let effect = "three control points more where a thread changes sides".into();
        self.tried("cloth.shape", "\"round\"".into(), effect, &changed)
    }

    /// The nearest share of the crimp that cures.
    fn share(&self) -> Option<Cure> {
        let now = self.cloth.warp_share();
        let mut shares: Vec<_> = SHARES.map(|step| f32::from(step) * SHARE_STEP).collect();
        shares.sort_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs()));
        shares.into_iter().find_map(|share| {
            let mut changed = self.cloth.clone();
            changed.set_crimp(Crimp::WarpShare(share)).ok()?;
            let effect = format!("the warp's share of the crimp is {now:.2}");
            self.cure("cloth.warp_crimp", format!("{share:.2}"), effect, &changed)
        })
    }

    fn relief(&self, jam: Jam) -> Option<Cure> {
        let mut changed = self.cloth.clone();
        let done = changed.relieve(jam).ok()?;
        let [share, new_share] = done.warp_share;
        let mut effects = Vec::new();
        if share != new_share {
            effects.push(format!("the warp takes {new_share:.2} of the crimp instead of {share:.2}"));
        }
        for (set, wider) in ["ends", "picks"].into_iter().zip(done.widened) {
            if wider != 1.0 {
                effects.push(format!("{set} {wider:.2} times as wide and as much flatter"));
            }
        }
        if done.scaled != 1.0 {
            let [before, now] = [self.cloth, &changed].map(thickest_mm);
            effects.push(format!("yarns {now:.4} mm thick at most instead of {before:.4} mm"));
        }
        if effects.is_empty() {
            return None;
        }
        let value = if jam == Jam::Shrink { "\"shrink\"" } else { "\"flatten\"" };
        self.tried("cloth.jam", value.into(), effects.join(", "), &changed)
    }

    /// The roundest section for all yarns that cures: flatter ones where all are round, else round ones.
    fn section(&self) -> Option<Cure> {
        if self.cloth.sections().iter().any(|section| *section != Section::Circle) {
            let mut changed = self.cloth.clone();
            changed.set_section(Section::Circle).ok()?;
            let value = "{ shape = \"circle\" }".into();
            return self.cure(
                "section of every yarn",
                value,
                "round yarns of the same area".into(),
                &changed,
            );
        }
        ASPECTS.into_iter().find_map(|aspect| {
            let mut changed = self.cloth.clone();
            changed.set_section(Section::Ellipse { aspect }).ok()?;
            let value = format!("{{ shape = \"ellipse\", aspect = {aspect} }}");
            self.cure("section of every yarn", value, "flatter yarns of the same area".into(), &changed)
        })
    }

    /// The least spacing of all threads that cures; and the greatest diameters, which are the same cloth in small.
    fn room(&self) -> Vec<Cure> {
        // What jams is known from its numbers: nothing closer need be tried.
        let jammed = self.faults.jams.iter().filter_map(|jams| jams.threads.first());
        let least = jammed.map(|jam| jam.pitch_min_mm / jam.pitch_mm).fold(1.0, f64::max);
        let first = (least.ln() / WIDER.ln()).ceil().max(1.0) as i32;
        let found = (first..first + WIDER_TIMES).map(|times| WIDER.powi(times)).find_map(|wider| {
            let changed = self.spaced(wider)?;
            Some((wider, self.cure("", String::new(), String::new(), &changed)?))
        });
        let Some((wider, cure)) = found else { return Vec::new() };
        let mean =
            |set: &[Thread]| set.iter().map(|thread| thread.spacing_mm).sum::<f64>() / set.len() as f64;
        let spacing = [self.cloth.warp(), self.cloth.weft()].map(|set| wider * mean(set));
        let thickest = thickest_mm(self.cloth);
        let thinner = thickest / wider;
        let [warp, weft] = spacing;
        let Cure { clearance, curvature, .. } = cure;
        let cure = |key, value, effect| Cure { key, value, effect, clearance, curvature, leaves: None };
        let per_cm = [warp, weft].map(|mm| 10.0 / mm);
        let cures = [
            cure(
                "warp.spacing_mm, weft.spacing_mm",
                format!("{warp:.4}, {weft:.4}"),
                format!("{wider:.2} times as wide, {:.2} and {:.2} threads a cm", per_cm[0], per_cm[1]),
            ),
            cure(
                "diameter_mm of every yarn",
                format!("{thinner:.4}"),
                format!("at most that instead of {thickest:.4} mm"),
            ),
        ];
        // A cloth far too thick may have only one of them.
        let taken = [spacing.iter().all(|mm| LENGTHS_MM.contains(mm)), LENGTHS_MM.contains(&thinner)];
        cures.into_iter().zip(taken).filter(|(_, taken)| *taken).map(|(cure, _)| cure).collect()
    }

    fn spaced(&self, wider: f64) -> Option<Woven> {
        let [warp, weft] = [self.cloth.warp(), self.cloth.weft()].map(|set| {
            let apart = |thread: &Thread| Thread { spacing_mm: thread.spacing_mm * wider, ..*thread };
            set.iter().map(apart).collect()
        });
        self.like(self.cloth, self.cloth.drawdown().clone(), warp, weft).ok()
    }

    /// A cloth of other threads that lie as those of `cloth` do.
    fn like(
        &self,
        cloth: &Woven,
        drawdown: Drawdown,
        warp: Vec<Thread>,
        weft: Vec<Thread>,
    ) -> Result<Woven, FabricError> {
        let (materials, sections) = (cloth.materials().to_vec(), cloth.sections().to_vec());
        let mut like = Woven::new(drawdown, warp, weft, materials, sections)?;
        like.set_shape(cloth.shape());
        like.set_crimp(Crimp::WarpShare(cloth.warp_share()))?;
        like.set_selvedge(cloth.selvedge());
        Ok(like)
    }

    /// `changed` as a cure, if nothing is left of the faults. What still jams need not be measured.
    fn cure(&self, key: &'static str, value: String, effect: String, changed: &Woven) -> Option<Cure> {
        if Jams::of(changed).is_some() {
            return None;
        }
        self.tried(key, value, effect, changed).filter(|cure| cure.leaves.is_none())
    }

    /// `changed` as a cure, if one kind of fault is gone at least: jams everywhere, the others at the worst places.
    fn tried(&self, key: &'static str, value: String, effect: String, changed: &Woven) -> Option<Cure> {
        let mut left = Faults { crowded: None, pierces: None, folds: None, jams: Jams::of(changed) };
        let (mut clearance, mut curvature) = (f64::INFINITY, f64::INFINITY);
        for sample in &self.samples {
            let cut = self.cut(changed, sample).ok()?;
            let (faults, near, bend) =
                Faults::new(&cut, self.touching, |_| ControlFlow::Continue(())).ok()?;
            left.crowded = left.crowded.or(faults.crowded);
            left.pierces = left.pierces.or(faults.pierces);
            left.folds = left.folds.or(faults.folds);
            (clearance, curvature) = (clearance.min(near.min), curvature.min(bend.min));
        }
        let (before, after) = (self.faults.kinds(), left.kinds());
        let better = before != after && after.iter().all(|kind| before.contains(kind));
        better.then(|| Cure { key, value, effect, clearance, curvature, leaves: left.said() })
    }

    /// A sample of `cloth`.
    fn cut(&self, cloth: &Woven, [ends, picks]: &Sample) -> Result<Woven, FabricError> {
        let up = |end, pick| cloth.drawdown().up(ends.start + end, picks.start + pick);
        let drawdown = Drawdown::from_fn(ends.len(), picks.len(), up)?;
        self.like(cloth, drawdown, cloth.warp()[ends.clone()].to_vec(), cloth.weft()[picks.clone()].to_vec())
    }
}
