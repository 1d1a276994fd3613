//! The report of a knit that came to rest by its energy.

use std::fmt;

use serde::Serialize;
use texere_fabric::{RelaxedKnit, Verdict};

use crate::report::clearance::as_near_as_looked;

/// How a knit came to rest by its energy. The keys of the JSON are these fields.
#[derive(Debug, Serialize)]
pub(crate) struct RelaxedReport {
    device: String,
    at_rest: bool,
    #[serde(skip)]
    verdict: Verdict,
    /// Number of steps.
    steps: u32,
    /// Wales per cm at rest.
    wales_per_cm: f64,
    /// Courses per cm at rest.
    courses_per_cm: f64,
    /// The energy of bending in one repeat, N mm.
    bending_energy_n_mm: f64,
    /// The energy of contacts in one repeat, N mm.
    contact_energy_n_mm: f64,
    /// The largest force that balances no other, N.
    unbalanced_n: f64,
    /// The largest force with which yarns press on one another between two control points, N.
    pressed_n: f64,
    /// The least clearance of surfaces as drawn, 1 if they touch.
    #[serde(serialize_with = "as_near_as_looked")]
    pub(super) clearance: f64,
    /// Whether it is known that no yarn has passed through another. If not, all yarns are as the
    /// structure places them.
    linked: bool,
}

impl RelaxedReport {
    pub(super) fn new(relaxed: &RelaxedKnit, device: &str) -> Self {
        Self {
            device: device.to_owned(),
            at_rest: relaxed.verdict() == Verdict::AtRest,
            verdict: relaxed.verdict(),
            steps: relaxed.steps,
            wales_per_cm: 10.0 / relaxed.gauge.wale_mm,
            courses_per_cm: 10.0 / relaxed.gauge.course_mm,
            bending_energy_n_mm: relaxed.energy.bending,
            contact_energy_n_mm: relaxed.energy.contact,
            unbalanced_n: relaxed.unbalanced,
            pressed_n: relaxed.pressed,
            clearance: relaxed.clearance.min,
            linked: relaxed.is_linked(),
        }
    }
}

impl fmt::Display for RelaxedReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device, verdict, steps, wales_per_cm, courses_per_cm, clearance, .. } = self;
        let s = if *steps == 1 { "" } else { "s" };
        write!(f, "{verdict} by energy after {steps} step{s} on {device}; ")?;
        write!(f, "{wales_per_cm:.2} wales/cm, {courses_per_cm:.2} courses/cm; ")?;
        if self.pressed_n > 0.0 {
            let share = 100.0 * self.unbalanced_n / self.pressed_n;
            write!(f, "forces balance to {share:.2} % of the largest contact; ")?;
        }
        if clearance.is_finite() {
            write!(f, "clearance {clearance:.3}, ")?;
        }
        match self.linked {
            true => write!(f, "linking unchanged"),
            false => write!(f, "linking changed, so the yarns are as placed"),
        }
    }
}
