//! `texere check`

use std::fmt::Write;
use std::ops::ControlFlow;

use serde::Serialize;
use texere::{FabricError, Settings, Structure, Woven};

use crate::args::CheckArgs;
use crate::cures::{self, Cure};
use crate::fail::Fail;
use crate::places::{ClearanceReport, ContactReport, Crossing, CrowdReport, CurvatureReport, Names, place};
use crate::{progress, terminal};

/// The most jammed threads that are listed one by one.
const LISTED: usize = 100;

/// What is said of a cloth. The keys of the JSON are these fields.
#[derive(Debug, Serialize)]
struct Report {
    name: String,
    clean: bool,
    /// Contacts nearer than this pierce.
    touching: f64,
    #[serde(flatten)]
    faults: Faults,
    cures: Vec<Cure>,
}

/// What is wrong with a cloth; nothing where all are none.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Faults {
    pub(crate) crowded: Option<CrowdReport>,
    pub(crate) pierces: Option<Pierces>,
    pub(crate) folds: Option<CurvatureReport>,
    pub(crate) jams: Option<Jams>,
}

/// Yarns that pierce one another, or themselves.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Pierces {
    min: f64,
    /// The contacts that pierce, worst first, as far as `inspect` lists them.
    pub(crate) worst: Vec<ContactReport>,
}

/// Threads too close for those that cross them.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Jams {
    ends: usize,
    picks: usize,
    /// The worst one first.
    pub(crate) threads: Vec<Jammed>,
}

/// A thread that lies closer to the one before than those that cross can pass.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Jammed {
    thread: String,
    pub(crate) pitch_mm: f64,
    pub(crate) pitch_min_mm: f64,
    /// One of its crossings, to look at.
    #[serde(skip)]
    pub(crate) crossing: Crossing,
}

pub(crate) fn run(args: &CheckArgs) -> Result<(), Fail> {
    let design = texere::read(&args.design)?;
    let Structure::Woven(woven) = &design.structure else {
        return Err(Fail::not_woven(&args.design));
    };
    let touching = 1.0 - args.accuracy;
    let (faults, clearance, curvature) = progress::during("measuring how near yarns come", |bar| {
        Faults::new(woven, touching, progress::share(bar))
    })?;
    let faulty = faults.said();
    let cures = match &faulty {
        Some(_) => progress::during("looking for cures", |bar| {
            cures::of(&design, woven, &faults, touching, progress::share(bar))
        }),
        None => Vec::new(),
    };
    let report = Report { name: design.name, clean: faulty.is_none(), touching, faults, cures };
    if args.json {
        crate::print_json(&report)?;
    } else {
        crate::print(&report.text(&clearance, &curvature))?;
    }
    match faulty {
        Some(said) => Err(Fail::cloth(&args.design, &said)),
        None => Ok(()),
    }
}

impl Faults {
    /// What is wrong with `cloth`, whose yarns pierce where they come nearer than `touching`, and what was measured.
    pub(crate) fn new(
        cloth: &Woven,
        touching: f64,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<(Self, ClearanceReport, CurvatureReport), FabricError> {
        let yarns = cloth.yarns()?;
        let found = texere::clearance_with_progress(&yarns, Settings::default().tension, progress)?;
        let names = Names { cloth, yarns: &yarns };
        let (clearance, curvature) = (names.clearance(&found), names.curvature(&found));
        let worst: Vec<_> =
            clearance.worst.iter().take_while(|contact| contact.ratio < touching).cloned().collect();
        let faults = Self {
            crowded: clearance.crowd.clone(),
            pierces: worst.first().map(|contact| contact.ratio).map(|min| Pierces { min, worst }),
            folds: (curvature.min < 1.0).then(|| curvature.clone()),
            jams: Jams::of(cloth),
        };
        Ok((faults, clearance, curvature))
    }

    /// What the cloth does that it should not.
    pub(crate) fn kinds(&self) -> Vec<&'static str> {
        let kinds = [
            self.crowded.as_ref().map(|_| "is crowded"),
            self.pierces.as_ref().map(|_| "pierces itself"),
            self.folds.as_ref().map(|_| "folds"),
            self.jams.as_ref().map(|_| "jams"),
        ];
        kinds.into_iter().flatten().collect()
    }

    /// The same in one phrase, if there is anything.
    pub(crate) fn said(&self) -> Option<String> {
        let kinds = self.kinds();
        (!kinds.is_empty()).then(|| kinds.join(", "))
    }
}

impl Jams {
    pub(crate) fn of(cloth: &Woven) -> Option<Self> {
        let [ends, picks] = cloth.pitches();
        let jammed = |pitches: &[texere::Pitch], crossing: fn(usize) -> Crossing| -> Vec<Jammed> {
            let numbered = pitches.iter().zip(2..).filter(|(pitch, _)| pitch.is_jammed());
            let jam = |(pitch, number): (&texere::Pitch, usize)| Jammed {
                thread: pitch.thread.to_string(),
                pitch_mm: pitch.pitch_mm,
                pitch_min_mm: pitch.passing_mm,
                crossing: crossing(number),
            };
            numbered.map(jam).collect()
        };
        let mut threads = jammed(&ends, |end| Crossing { end, pick: 1 });
        let jammed_ends = threads.len();
        threads.extend(jammed(&picks, |pick| Crossing { end: 1, pick }));
        let jammed_picks = threads.len() - jammed_ends;
        let lack = |jam: &Jammed| jam.pitch_mm / jam.pitch_min_mm;
        threads.sort_by(|a, b| lack(a).total_cmp(&lack(b)));
        threads.truncate(LISTED);
        (!threads.is_empty()).then_some(Self { ends: jammed_ends, picks: jammed_picks, threads })
    }
}

impl Report {
    fn text(&self, clearance: &ClearanceReport, curvature: &CurvatureReport) -> String {
        let mut text = format!("{}\n", terminal::line(&self.name));
        let mut line = |what: &str, said: String| {
            // Writing to a string can't fail.
            let _ = writeln!(text, "{what:>10}  {}", terminal::line(said));
        };
        line("clearance", clearance.to_string());
        line("bends", curvature.to_string());
        if let Some(crowded) = &self.faults.crowded {
            line("crowded", crowded.to_string());
        }
        if let Some(pierces) = &self.faults.pierces {
            let (count, listed) = (pierces.worst.len(), clearance.worst.len());
            let more = if count == listed && count > 1 { " or more" } else { "" };
            line("pierces", format!("{count}{more} contacts nearer than {} of touching", self.touching));
            for contact in pierces.worst.iter().take(3) {
                let [one, other] = &contact.yarns;
                line("", format!("{one} and {other}, {:.4}, at {}", contact.ratio, place(contact.place_mm)));
            }
        }
        if let Some(folds) = &self.faults.folds {
            line("folds", format!("a bend of {:.3} yarn radii is tighter than the tube is thick", folds.min));
        }
        if let Some(jams) = &self.faults.jams {
            line("jams", format!("{} ends and {} picks", jams.ends, jams.picks));
            for jam in jams.threads.iter().take(3) {
                let Jammed { thread, pitch_mm, pitch_min_mm, .. } = jam;
                line(
                    "",
                    format!(
                        "{thread} is {pitch_mm:.4} mm from the one before and needs {pitch_min_mm:.4} mm"
                    ),
                );
            }
        }
        if self.clean {
            line("clean", format!("nothing nearer than {} of touching, no fold, no jam", self.touching));
        } else if self.cures.is_empty() {
            line(
                "cure",
                "none was found in one change; wider spacings and thinner yarns help together".into(),
            );
        }
        for cure in &self.cures {
            line("cure", cure.to_string());
        }
        text
    }
}
