//! What would cure a cloth, tried out: each cure is one change of the design, with which its worst places are measured again.

use std::fmt;
use std::ops::Range;

use serde::Serialize;
use texere::{Crimp, Design, Drawdown, FabricError, Jam, Section, Shape, Thread, Woven};

use crate::check::{Faults, Jams};
use crate::places::Crossing;

/// Threads each way of a worst place that are measured with it: more than the longest floats of common weaves.
const AROUND: usize = 12;

/// Spacings are tried this much wider, again and again, to three times as wide.
const WIDER: f64 = 1.05;
const WIDER_TIMES: i32 = 22;

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

/// The cures of `cloth`, the cloth of `design`, that were found.
pub(crate) fn of(design: &Design, cloth: &Woven, faults: &Faults, touching: f64) -> Vec<Cure> {
    let trial = Trial { cloth, faults, places: places(faults), touching };
    let relieved = design.jam.scaled != 1.0
        || design.jam.widened != [1.0; 2]
        || design.jam.warp_share[0] != design.jam.warp_share[1];
    let relief = |jam| if relieved { None } else { trial.relief(jam) };
    [
        trial.round(),
        trial.share(),
        relief(Jam::Flatten),
        trial.section(),
        trial.spacing(),
        relief(Jam::Shrink),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// One crossing of each of the worst places.
fn places(faults: &Faults) -> Vec<Crossing> {
    let pierced = faults.pierces.iter().flat_map(|pierces| &pierces.worst).take(1);
    let pierced = pierced.flat_map(|contact| contact.crossings.into_iter().flatten().take(1));
    let folded = faults.folds.iter().filter_map(|bend| bend.crossing);
    let jammed = faults.jams.iter().filter_map(|jams| jams.threads.first()).map(|jam| jam.crossing);
    let mut places: Vec<_> = pierced.chain(folded).chain(jammed).collect();
    if places.is_empty() {
        // In a turn of the weft: they are all alike.
        places.push(Crossing { end: 1, pick: 1 });
    }
    places.dedup();
    places
}

/// A cloth that is tried with changes.
struct Trial<'a> {
    cloth: &'a Woven,
    faults: &'a Faults,
    places: Vec<Crossing>,
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
            effects.push(format!("yarns {:.3} times as thick", done.scaled));
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

    /// The least spacing of all threads that cures.
    fn spacing(&self) -> Option<Cure> {
        (1..=WIDER_TIMES).map(|times| WIDER.powi(times)).find_map(|wider| {
            let changed = self.spaced(wider)?;
            let mean =
                |set: &[Thread]| set.iter().map(|thread| thread.spacing_mm).sum::<f64>() / set.len() as f64;
            let [warp, weft] = [changed.warp(), changed.weft()].map(mean);
            let effect =
                format!("{wider:.2} times as wide, {:.2} and {:.2} threads a cm", 10.0 / warp, 10.0 / weft);
            self.cure("warp.spacing_mm, weft.spacing_mm", format!("{warp:.4}, {weft:.4}"), effect, &changed)
        })
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

    /// `changed` as a cure, if nothing is left of the faults.
    fn cure(&self, key: &'static str, value: String, effect: String, changed: &Woven) -> Option<Cure> {
        self.tried(key, value, effect, changed).filter(|cure| cure.leaves.is_none())
    }

    /// `changed` as a cure, if one kind of fault is gone at least: jams everywhere, the others at the worst places.
    fn tried(&self, key: &'static str, value: String, effect: String, changed: &Woven) -> Option<Cure> {
        let mut left = Faults { pierces: None, folds: None, jams: Jams::of(changed) };
        let (mut clearance, mut curvature) = (f64::INFINITY, f64::INFINITY);
        for place in &self.places {
            let (faults, near, bend) = Faults::new(&self.cut(changed, *place).ok()?, self.touching).ok()?;
            left.pierces = left.pierces.or(faults.pierces);
            left.folds = left.folds.or(faults.folds);
            (clearance, curvature) = (clearance.min(near.min), curvature.min(bend.min));
        }
        let (before, after) = (self.faults.kinds(), left.kinds());
        let better = before != after && after.iter().all(|kind| before.contains(kind));
        better.then(|| Cure { key, value, effect, clearance, curvature, leaves: left.said() })
    }

    /// The threads of `cloth` round a crossing.
    fn cut(&self, cloth: &Woven, place: Crossing) -> Result<Woven, FabricError> {
        let range = |at: usize, count: usize| {
            // From an odd thread on, so that picks turn back at the sides at which they did.
            let first = at.saturating_sub(AROUND) / 2 * 2;
            first..(at + AROUND).min(count)
        };
        let (ends, picks) = (cloth.drawdown().ends(), cloth.drawdown().picks());
        let (ends, picks) = (range(place.end, ends), range(place.pick, picks));
        let up = |end, pick| cloth.drawdown().up(ends.start + end, picks.start + pick);
        let drawdown = Drawdown::from_fn(ends.len(), picks.len(), up)?;
        self.like(cloth, drawdown, cloth.warp()[ends.clone()].to_vec(), cloth.weft()[picks.clone()].to_vec())
    }
}
