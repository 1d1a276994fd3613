//! The report of how yarns came to rest.

mod knit;
mod relaxed;
mod woven;

use std::{fmt, iter};

use serde::Serialize;
use texere_fabric::{ClothClearance, Finished};

use crate::{Cloth, RestReport};
use knit::KnitRestReport;
use relaxed::RelaxedReport;
use woven::WovenRestReport;

/// How the yarns of a cloth came to rest. `Display` writes it as one line, and `Serialize` as data.
#[derive(Debug, Serialize)]
#[serde(transparent)]
pub struct SettlingReport(Settling);

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Settling {
    Knit(KnitRestReport),
    Relaxed(RelaxedReport),
    Woven(WovenRestReport),
    /// Woven cloth whose crossings can't settle. Its threads are as the structure places them.
    Refused {
        refused: String,
    },
}

impl SettlingReport {
    /// The report of a cloth that came to rest on the device of this name. None for yarns that were
    /// only placed.
    #[must_use]
    pub fn new(cloth: &Cloth, device: &str) -> Option<Self> {
        Some(Self(match cloth.report() {
            RestReport::Finished(Finished::Knit(settled)) => {
                Settling::Knit(KnitRestReport::new(cloth.design(), settled, device))
            }
            RestReport::Finished(Finished::Relaxed(relaxed)) => {
                Settling::Relaxed(RelaxedReport::new(relaxed, device))
            }
            RestReport::Finished(Finished::Woven(rest)) => {
                Settling::Woven(WovenRestReport::new(rest, device))
            }
            RestReport::Refused { reason, .. } => Settling::Refused { refused: reason.why() },
            _ => return None,
        }))
    }

    /// Whether settling was carried out. If it was refused, the yarns are as the structure places
    /// them.
    pub(super) const fn has_moved(&self) -> bool {
        !matches!(self.0, Settling::Refused { .. })
    }

    /// Replaces the clearance that settling measured by that of the whole cloth, so that a report
    /// does not show two. Settling measures only one repeat of woven cloth, and there looks only
    /// for contacts below 0.99 of touching.
    pub(super) const fn measured(&mut self, clearance: &ClothClearance) {
        match &mut self.0 {
            Settling::Knit(report) => report.clearance = clearance.least(),
            Settling::Relaxed(report) => report.clearance = clearance.least(),
            Settling::Woven(report) => report.clearance = clearance.least(),
            Settling::Refused { .. } => {}
        }
    }

    /// The clauses of the line that `Display` writes. Semicolons separate them in that line. Each
    /// clause is short enough for a line of a terminal.
    #[must_use]
    pub fn clauses(&self) -> Vec<String> {
        self.to_string().split("; ").map(str::to_owned).collect()
    }

    /// The report for people: a line for each clause, with a label on the first line. The command
    /// `texere` shows only the start and the end of a long line.
    pub(super) fn lines(&self) -> Vec<(&'static str, String)> {
        iter::once("settling").chain(iter::repeat("")).zip(self.clauses()).collect()
    }

    /// A warning if the press was not reached.
    pub(super) fn press_missed(&self) -> Option<String> {
        match &self.0 {
            Settling::Knit(report) => report.press_missed.clone(),
            Settling::Relaxed(_) | Settling::Woven(_) | Settling::Refused { .. } => None,
        }
    }
}

impl fmt::Display for SettlingReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Settling::Knit(report) => report.fmt(f),
            Settling::Relaxed(report) => report.fmt(f),
            Settling::Woven(report) => report.fmt(f),
            Settling::Refused { refused } => write!(f, "none, the cloth is as it is woven: {refused}"),
        }
    }
}
