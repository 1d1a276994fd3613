//! Lets yarns settle before they are measured, drawn or written, and reports how they did.

mod knit;
mod plot;
mod woven;

use std::fmt;
use std::ops::Deref;

use serde::Serialize;
use texere::check::ClothClearance;
use texere::rest::{Finished, RestReport};
use texere::write::Output;
use texere::{Backend, BackendError, Cloth, Design};

use crate::args::SettlingArgs;
use crate::clearance::least;
use crate::fail::Fail;
use crate::{drivers, progress};
use knit::KnitRestReport;
use plot::plot;
use woven::WovenRestReport;

/// How yarns have settled, or why they could not.
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

/// The cloth of a design, with splines of `tension`. If the design or the command line lets its
/// yarns come to rest, they do so on the device that `open` gives, and there is a report.
pub(crate) fn cloth<D: Deref<Target = dyn Backend>>(
    mut design: Design,
    args: &SettlingArgs,
    tension: f32,
    open: impl FnOnce() -> Result<D, BackendError>,
) -> Result<(Cloth, Option<SettlingReport>), Fail> {
    if !args.settles(&design) {
        return match args.settling_plot {
            Some(_) => Err(Fail::nothing_settles()),
            None => Ok((design.placed(tension)?, None)),
        };
    }
    if args.settling_plot.is_some() && design.structure.woven().is_some() {
        return Err(Fail::no_course());
    }
    let output = args.settling_plot.as_ref().map(|path| Output::to(path).sparing(design.files()));
    output.iter().try_for_each(Output::check)?;
    let device = drivers::quietly(open)?;
    (design.settle, design.finish.record) = (true, output.is_some());
    let cloth = progress::during("settling", |bar| {
        design.rest(&*device).tension(tension).progress(progress::share(bar)).run()
    })?;
    if let (Some(output), RestReport::Finished(Finished::Knit(settled))) = (output, cloth.report()) {
        texere::write::file(plot(&settled.course).as_bytes(), output)?;
    }
    let report = SettlingReport::new(&cloth, &device.info().name);
    Ok((cloth, report))
}

impl SettlingReport {
    /// None for yarns that were only placed.
    fn new(cloth: &Cloth, device: &str) -> Option<Self> {
        match cloth.report() {
            RestReport::Finished(Finished::Knit(settled)) => {
                Some(Self::Knit(KnitRestReport::new(cloth.design(), settled, device)))
            }
            RestReport::Finished(Finished::Woven(rest)) => {
                Some(Self::Woven(WovenRestReport::new(rest, device)))
            }
            RestReport::Refused { reason, .. } => Some(Self::Refused { refused: reason.why() }),
            _ => None,
        }
    }

    /// Whether yarns are no longer as the structure places them.
    pub(crate) const fn has_moved(&self) -> bool {
        !matches!(self, Self::Refused { .. })
    }

    /// Takes over the clearance of the whole cloth, measured afterwards, so that a report has one
    /// figure. Settling itself measures only one repeat of woven cloth, and only yarns that touch.
    pub(crate) const fn measured(&mut self, clearance: &ClothClearance) {
        match self {
            Self::Knit(report) => report.clearance = least(clearance),
            Self::Woven(report) => report.clearance = least(clearance),
            Self::Refused { .. } => {}
        }
    }

    /// A warning if the press was not reached.
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
