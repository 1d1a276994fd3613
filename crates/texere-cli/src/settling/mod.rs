//! Yarns that settle before they are measured, drawn or written, and what is said of that.

mod knit;
mod plot;
mod woven;

use std::fmt;
use std::ops::Deref;

use serde::Serialize;
use texere::{
    Backend, BackendError, ClothClearance, Design, Finish, FinishError, Finished, Output, Refusal, Yarns,
};

use crate::args::SettlingArgs;
use crate::clearance::least;
use crate::fail::Fail;
use crate::{drivers, progress};
use knit::KnitRestReport;
use plot::plot;
use woven::WovenRestReport;

/// How yarns have come to rest.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum SettlingReport {
    Knit(KnitRestReport),
    Woven(WovenRestReport),
    /// Woven cloth that can't come to rest at all, and is as it is woven.
    Refused {
        refused: String,
    },
}

/// The yarns of a design, and how they have settled where it or the command line asks for that. They settle on the device that
/// `open` gives, with splines of `tension`. A design that is stretched is another cloth then.
pub(crate) fn yarns<D: Deref<Target = dyn Backend>>(
    design: &mut Design,
    args: &SettlingArgs,
    tension: f32,
    open: impl FnOnce() -> Result<D, BackendError>,
) -> Result<(Yarns, Option<SettlingReport>), Fail> {
    if !args.settles(design) {
        return match args.settling_plot {
            Some(_) => Err(Fail::nothing_settles()),
            None => Ok((design.yarns().map_err(|error| design.refused(error))?, None)),
        };
    }
    if args.settling_plot.is_some() && design.structure.woven().is_some() {
        return Err(Fail::no_course());
    }
    let output = args.settling_plot.as_ref().map(|path| Output::to(path).sparing(design.files()));
    output.iter().try_for_each(Output::check)?;
    let device = drivers::quietly(open)?;
    if let Some(stretch) = design.stretch {
        design.finish = progress::during("stretching", |bar| {
            design.structure.stretch(&design.finish, stretch, tension, &*device, progress::share(bar))
        })
        .map_err(|error| design.refused(error))?;
    }
    let finish = Finish { record: output.is_some(), ..design.finish };
    let finished = progress::during("settling", |bar| {
        design.structure.settle(&finish, tension, &*device, progress::share(bar))
    });
    let finished = match finished {
        Err(error @ FinishError::Crossings(_)) => {
            let yarns = design.yarns().map_err(|error| design.refused(error))?;
            let refused = match design.refused(error) {
                Refusal::Key { place, source } => format!("{place}: {source}"),
                refused => refused.to_string(),
            };
            return Ok((yarns, Some(SettlingReport::Refused { refused })));
        }
        finished => finished.map_err(|error| design.refused(error))?,
    };
    if let (Some(output), Finished::Knit(settled)) = (output, &finished) {
        texere::write_file(plot(&settled.course).as_bytes(), output)?;
    }
    let report = SettlingReport::new(design, &finished, &device.info().name);
    Ok((finished.into_yarns(), report))
}

/// What a designer should know of yarns that have settled so, if they have.
pub(crate) fn warnings(design: &Design, settling: Option<&SettlingReport>) -> Vec<String> {
    match settling {
        Some(
            SettlingReport::Knit(KnitRestReport { warnings, .. })
            | SettlingReport::Woven(WovenRestReport { warnings, .. }),
        ) => warnings.clone(),
        Some(SettlingReport::Refused { .. }) | None => design.warnings(),
    }
}

impl SettlingReport {
    /// None of a way to rest that is not known here.
    fn new(design: &Design, finished: &Finished, device: &str) -> Option<Self> {
        match finished {
            Finished::Knit(settled) => {
                let warnings = design.warnings_at_rest(finished);
                Some(Self::Knit(KnitRestReport::new(design, settled, warnings, device)))
            }
            Finished::Woven(rest) => {
                Some(Self::Woven(WovenRestReport::new(rest, design.warnings_at_rest(finished), device)))
            }
            _ => None,
        }
    }

    /// Whether yarns are no longer as the structure puts them.
    pub(crate) const fn has_moved(&self) -> bool {
        !matches!(self, Self::Refused { .. })
    }

    /// Takes over what was measured of all the cloth afterwards, so that one figure is said of it: settling looks at one repeat of woven
    /// cloth alone, and no further than yarns that touch.
    pub(crate) const fn measured(&mut self, clearance: &ClothClearance) {
        match self {
            Self::Knit(report) => report.clearance = least(clearance),
            Self::Woven(report) => report.clearance = least(clearance),
            Self::Refused { .. } => {}
        }
    }

    /// That a press was not reached, if so.
    pub(crate) fn press_missed(&self) -> Option<String> {
        match self {
            Self::Knit(report) => report.press_missed.clone(),
            Self::Woven(_) | Self::Refused { .. } => None,
        }
    }
}

impl fmt::Display for SettlingReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Knit(report) => report.fmt(f),
            Self::Woven(report) => report.fmt(f),
            Self::Refused { refused } => write!(f, "none, the cloth is as it is woven: {refused}"),
        }
    }
}
