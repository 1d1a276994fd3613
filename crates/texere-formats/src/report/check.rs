//! The report of what is wrong with a cloth, and of what would cure it.

use std::ops::ControlFlow;

use serde::Serialize;
use texere_contact::finer;
use texere_core::{Backend, Settings, Undersampled, counted};
use texere_fabric::{ClothClearance, Diagnosis, Faults, Pieces, Pitch};

use super::SettlingReport;
use super::clearance::ClearanceReport;
use super::clearance::{ContactReport, CrowdReport, CurvatureReport, DrawnReport, place};
use super::cures::{CureReport, phrase};
use super::measures::Sets;
use super::setts::{SettReport, setts};
use crate::{Cloth, Design, Refusal};

/// What is wrong with a cloth, where, and what would cure it. `texere check` prints its
/// [lines](Self::lines). With `--json` it prints the serialized report, whose keys are these
/// fields.
#[derive(Debug, Serialize)]
pub struct CheckReport {
    name: String,
    clean: bool,
    /// Two yarns pierce one another at a contact whose ratio is below this number.
    touching: f64,
    #[serde(flatten)]
    faults: FaultsReport,
    drawn: DrawnReport,
    /// A warning of twist that the measured mesh does not show.
    #[serde(skip_serializing_if = "Option::is_none")]
    undersampled: Option<String>,
    /// Only for woven cloth.
    #[serde(skip_serializing_if = "Option::is_none")]
    setts: Option<Sets<SettReport>>,
    /// Only for weft knits: the faults of the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    machine: Option<MachineReport>,
    /// Only for knits: needles that never have a loop.
    #[serde(skip_serializing_if = "Option::is_none")]
    empty_needles: Option<EmptyNeedles>,
    #[serde(skip_serializing_if = "Option::is_none")]
    settling: Option<SettlingReport>,
    cures: Vec<CureReport>,
    #[serde(skip)]
    stretched: bool,
    #[serde(skip)]
    diagnosis: Diagnosis,
    /// The faults in one phrase, if there are any.
    #[serde(skip)]
    verdict: Option<String>,
    /// The settings of the mesh that was measured.
    #[serde(skip)]
    settings: Settings,
}

/// Needles that never have a loop.
#[derive(Debug, Serialize)]
struct EmptyNeedles {
    count: u64,
    /// The first empty needles, counted from 0 at the left.
    first: Vec<u64>,
}

impl EmptyNeedles {
    fn new(pieces: &Pieces) -> Option<Self> {
        let count = pieces.empty_needles;
        (count > 0).then(|| Self { count, first: pieces.empty_listed.clone() })
    }
}

/// The faults of a cloth's yarns. A field is none if the cloth does not have the fault. A clean
/// cloth has no such fault, and no error of the knitting machine.
#[derive(Debug, Serialize)]
struct FaultsReport {
    crowded: Option<CrowdReport>,
    pierces: Option<Pierces>,
    folds: Option<CurvatureReport>,
    jams: Option<Jams>,
    apart: Option<Apart>,
    wrung: Option<DrawnReport>,
    inside_out: Option<DrawnReport>,
}

/// A cloth that does not hang together.
#[derive(Debug, Serialize)]
struct Apart {
    /// Number of pieces: layers of woven cloth, or groups of yarns of a knit whose loops are drawn
    /// through one another.
    pieces: u64,
    /// Number of yarns that nothing holds.
    loose: u64,
    /// The first of the yarns that nothing holds.
    loose_yarns: Vec<String>,
    /// `pieces` and `loose` in a sentence.
    said: String,
}

/// Faults of a knitting program: steps that a machine can't do, and steps that may be mistakes.
#[derive(Debug, Serialize)]
struct MachineReport {
    errors: Vec<String>,
    warnings: Vec<String>,
}

impl MachineReport {
    /// None if the cloth is not a weft knit.
    fn new(design: &Design) -> Option<Self> {
        design.structure.knitted()?;
        let said = |errors| {
            let faults = design.faults().iter().filter(|fault| fault.is_error == errors);
            faults.map(|fault| fault.message.clone()).collect()
        };
        Some(Self { errors: said(true), warnings: said(false) })
    }
}

/// Yarns that pierce one another, or themselves.
#[derive(Debug, Serialize)]
struct Pierces {
    min: f64,
    /// The contacts that pierce, the worst first, at most as many as `inspect` lists.
    worst: Vec<ContactReport>,
}

/// Threads that lie too close for crossing threads to pass.
#[derive(Debug, Serialize)]
struct Jams {
    ends: usize,
    picks: usize,
    /// The worst jammed threads, the worst one first.
    threads: Vec<Jammed>,
}

/// A thread that lies too close to the one before for crossing threads to pass.
#[derive(Debug, Serialize)]
struct Jammed {
    thread: String,
    pitch_mm: f64,
    pitch_min_mm: f64,
}

impl CheckReport {
    /// The report of a cloth, and of how it came to rest. `clearance` is that of the cloth,
    /// measured with `settings`. Two yarns pierce one another at a contact whose ratio is below 1 -
    /// `accuracy`. The usual accuracy is 0.015: then contacts below
    /// [`CLEAR`](texere_contact::CLEAR) pierce. The report has no cures before
    /// [`CheckReport::find_cures`].
    #[must_use]
    pub fn new(
        cloth: &Cloth,
        mut settling: Option<SettlingReport>,
        accuracy: f64,
        settings: &Settings,
        clearance: ClothClearance,
    ) -> Self {
        let (design, yarns) = (cloth.design(), cloth.yarns());
        settling.iter_mut().for_each(|settling| settling.measured(&clearance));
        // For threads that have settled, only their clearance shows whether they have room. The
        // pitches of the structure no longer do.
        let settled = settling.as_ref().is_some_and(SettlingReport::has_moved);
        let jams = if settled { None } else { design.structure.jams() };
        let pieces = design.structure.pieces();
        let empty_needles = EmptyNeedles::new(&pieces);
        let diagnosis = Diagnosis::new(1.0 - accuracy, clearance, jams, pieces);
        let machine = MachineReport::new(design);
        let pierced = phrase(&diagnosis.faults.kinds());
        let unknittable = machine.as_ref().is_some_and(|machine| !machine.errors.is_empty());
        let said: Vec<_> =
            pierced.into_iter().chain(unknittable.then(|| "can't be knitted".into())).collect();
        let verdict = (!said.is_empty()).then(|| said.join(", "));
        Self {
            name: design.name.clone(),
            clean: verdict.is_none(),
            touching: diagnosis.touching,
            faults: FaultsReport::from(&diagnosis.faults),
            drawn: DrawnReport::from(&diagnosis.clearance.drawn),
            undersampled: Undersampled::of(yarns, settings).map(|found| found.to_string()),
            setts: design.structure.woven().map(|woven| setts(woven.cloth())),
            machine,
            empty_needles,
            settling,
            cures: Vec::new(),
            stretched: cloth.stretched,
            diagnosis,
            verdict,
            settings: *settings,
        }
    }

    /// The faults in one phrase with the cloth as its subject, such as "pierces itself, folds".
    /// None for a clean cloth.
    #[must_use]
    pub fn verdict(&self) -> Option<&str> {
        self.verdict.as_deref()
    }

    /// The faults with their places, and the clearance.
    #[must_use]
    pub const fn diagnosis(&self) -> &Diagnosis {
        &self.diagnosis
    }

    /// Looks for single changes of the design that cure the faults of `cloth`, the cloth of this
    /// report. For woven cloth that has not settled, changes are tried on the cloth as its
    /// structure places it. For woven cloth that has settled, wider spacings and thinner yarns are
    /// tried, and the changed cloth settles on `device`. No changes are tried for knits, nor for
    /// cloth that has settled after its design stretched it. More rings are tried for any cloth
    /// whose mesh is wrung or inside out. `progress` gets the share that is done, from 0 to 1. If
    /// it asks to stop, only the cures found so far are reported.
    ///
    /// **Errors**: a [`Refusal`] if the cloth can't be measured.
    pub fn find_cures(
        &mut self,
        cloth: &Cloth,
        device: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<(), Refusal> {
        let (design, diagnosis) = (cloth.design(), &self.diagnosis);
        let cures = match design.structure.woven() {
            Some(woven) if self.has_settled() && !cloth.stretched => {
                let (finish, tension) = (&design.finish, cloth.yarns().tension());
                woven.cures_at_rest(diagnosis, finish, tension, device, progress)
            }
            _ if self.has_settled() => Vec::new(),
            _ => design.structure.cures(diagnosis, progress),
        };
        self.cures = cures.iter().filter_map(CureReport::new).collect();
        if diagnosis.faults.wrung.is_some() || diagnosis.faults.inside_out.is_some() {
            let finer = finer(cloth.yarns(), &self.settings).map_err(|error| design.refused(error))?;
            self.cures.extend(finer.map(|(subdivisions, _)| CureReport::finer(subdivisions, diagnosis)));
        }
        Ok(())
    }

    fn has_settled(&self) -> bool {
        self.settling.as_ref().is_some_and(SettlingReport::has_moved)
    }

    /// The report for people: a label and what is said of it, line by line.
    #[must_use]
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let clearance = ClearanceReport::from(&self.diagnosis.clearance);
        let curvature = CurvatureReport::from(&self.diagnosis.clearance.bend);
        let mut lines: Vec<_> = self.settling.iter().flat_map(SettlingReport::lines).collect();
        let mut line = |what: &'static str, said: String| lines.push((what, said));
        line("clearance", clearance.to_string());
        line("bends", curvature.to_string());
        line("drawn", self.drawn.narrowest());
        self.say_faults(&clearance, &mut line);
        if let Some(undersampled) = &self.undersampled {
            line("warning", undersampled.clone());
        }
        for missed in self.settling.iter().filter_map(SettlingReport::press_missed) {
            line("warning", missed);
        }
        // Warnings were printed when the design was read.
        for error in self.machine.iter().flat_map(|machine| &machine.errors) {
            line("machine", error.clone());
        }
        self.say_cures(&mut line);
        lines
    }

    /// Passes to `line` the faults of the yarns as they are drawn, and how close threads lie.
    fn say_faults(&self, clearance: &ClearanceReport, line: &mut impl FnMut(&'static str, String)) {
        let faults = &self.faults;
        if let Some(crowded) = &faults.crowded {
            line("crowded", crowded.to_string());
        }
        if let Some(pierces) = &faults.pierces {
            let (count, listed) = (pierces.worst.len(), clearance.worst.len());
            let more = if count == listed && count > 1 { " or more" } else { "" };
            let contacts = counted(count, "contact");
            line("pierces", format!("{contacts}{more} nearer than {} of touching", self.touching));
            for contact in pierces.worst.iter().take(3) {
                let [one, other] = &contact.yarns;
                line("", format!("{one} and {other}, {:.4}, at {}", contact.ratio, place(contact.place_mm)));
            }
        }
        if let Some(folds) = &faults.folds {
            line("folds", format!("a bend of {:.3} yarn radii is tighter than the tube is thick", folds.min));
        }
        if let Some(wrung) = &faults.wrung {
            line("wrung", format!("neighbouring rings turn against one another: {}", wrung.narrowest()));
        }
        if let Some(turned) = &faults.inside_out {
            line("inside out", turned.turned());
        }
        for (sett, said) in self.setts.iter().flat_map(Sets::lines) {
            line(sett, said);
        }
        if let Some(jams) = &faults.jams {
            line("jams", format!("{} and {}", counted(jams.ends, "end"), counted(jams.picks, "pick")));
            for jam in jams.threads.iter().take(3) {
                let Jammed { thread, pitch_mm, pitch_min_mm, .. } = jam;
                let from = format!("{thread} is {pitch_mm:.4} mm from the one before");
                line("", format!("{from} and needs {pitch_min_mm:.4} mm"));
            }
        }
        if let Some(apart) = &faults.apart {
            line("apart", apart.said.clone());
        }
    }

    /// Passes to `line` the cures, or why there are none, or that the cloth is clean.
    fn say_cures(&self, line: &mut impl FnMut(&'static str, String)) {
        if self.clean {
            let jam = if self.has_settled() || self.setts.is_none() { "" } else { ", no jam" };
            let touching = self.touching;
            line("clean", format!("nothing nearer than {touching} of touching, no fold{jam}, nothing wrung"));
        } else if self.faults.is_none() {
            // No other spacing or yarn makes a program knittable, or binds cloth that falls apart.
        } else if self.setts.is_none() {
            if self.cures.is_empty() {
                line("cure", "none was looked for: cures are known for woven cloth alone".into());
            }
        } else if self.cures.is_empty() && self.stretched {
            line("cure", "none was looked for: the design stretches the cloth".into());
        } else if self.cures.is_empty() {
            line(
                "cure",
                "none was found in one change; wider spacings and thinner yarns help together".into(),
            );
        }
        for cure in &self.cures {
            line("cure", cure.to_string());
        }
    }
}

impl From<&Faults> for FaultsReport {
    fn from(faults: &Faults) -> Self {
        let jams = faults.jams.as_ref().map(|jams| {
            let jammed = |jam: &Pitch| Jammed {
                thread: jam.thread.to_string(),
                pitch_mm: jam.pitch_mm,
                pitch_min_mm: jam.passing_mm,
            };
            Jams { ends: jams.ends, picks: jams.picks, threads: jams.threads.iter().map(jammed).collect() }
        });
        let worst: Vec<_> = faults.pierces.iter().map(ContactReport::from).collect();
        Self {
            crowded: faults.crowded.as_ref().map(CrowdReport::from),
            pierces: worst.first().map(|contact| contact.ratio).map(|min| Pierces { min, worst }),
            folds: faults.folds.as_ref().map(CurvatureReport::from),
            jams,
            apart: faults.apart.as_ref().map(|pieces| Apart {
                pieces: pieces.count,
                loose: pieces.loose,
                loose_yarns: pieces.loose_listed.iter().map(ToString::to_string).collect(),
                said: pieces.to_string(),
            }),
            wrung: faults.wrung.as_ref().map(DrawnReport::from),
            inside_out: faults.inside_out.as_ref().map(DrawnReport::from),
        }
    }
}

impl FaultsReport {
    /// Whether there is no fault that a change of the cloth or of its mesh could cure.
    fn is_none(&self) -> bool {
        let Self { crowded, pierces, folds, jams, apart: _, wrung, inside_out } = self;
        let drawn = wrung.is_none() && inside_out.is_none();
        crowded.is_none() && pierces.is_none() && folds.is_none() && jams.is_none() && drawn
    }
}
