//! The report of woven cloth that has come to rest by its crossings.

use std::fmt;

use serde::Serialize;
use texere_contact::CLEAR;
use texere_core::crossings::Set;
use texere_fabric::{BySet, Verdict, WovenRest};

use crate::report::clearance::as_near_as_looked;
use crate::report::measures::Sets;

/// How woven cloth has come to rest. The keys of the JSON are these fields.
#[derive(Debug, Serialize)]
pub(crate) struct WovenRestReport {
    device: String,
    at_rest: bool,
    #[serde(skip)]
    verdict: Verdict,
    passes: u32,
    /// Number of ends and picks of the repeat that has settled.
    repeat: Sets<usize>,
    /// The least clearance of the threads' surfaces as they are drawn, before threads that lacked
    /// clearance were made thinner.
    #[serde(serialize_with = "as_near_as_looked")]
    clearance_before: f64,
    /// The least clearance of the threads' surfaces as they are drawn, at rest.
    #[serde(serialize_with = "as_near_as_looked")]
    pub(super) clearance: f64,
    /// How many times threads were made thinner.
    rounds: u32,
    /// The least distance of a valley between two plies from the axis, as a share of a ply's reach.
    valley: Option<f32>,
    /// The area of the threads' cross-sections in each set, as a share of the area that the design
    /// gives them.
    area: Sets<AreaReport>,
}

/// The area of the cross-sections of a set's threads, as a share of the area that the design gives
/// them: the mean over all crossings, and the least.
#[derive(Debug, Serialize)]
struct AreaReport {
    mean: f64,
    least: f64,
    /// The mean share that was lost when threads were made thinner for clearance.
    lost: f64,
}

impl WovenRestReport {
    pub(super) fn new(rest: &WovenRest, device: &str) -> Self {
        let area = BySet { warp: Set::Warp, weft: Set::Weft }.map(|set| AreaReport {
            mean: rest.area[set],
            least: rest.area_least[set],
            lost: rest.area_lost[set],
        });
        Self {
            device: device.to_owned(),
            at_rest: rest.verdict() == Verdict::AtRest,
            verdict: rest.verdict(),
            passes: rest.crossings.passes,
            repeat: rest.repeat.into(),
            clearance_before: rest.clearance[0],
            clearance: rest.clearance[1],
            rounds: rest.rounds,
            valley: rest.valley,
            area: area.into(),
        }
    }
}

impl fmt::Display for WovenRestReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device, verdict, passes, repeat, clearance_before, clearance, rounds, .. } = self;
        let Sets { warp, weft } = repeat;
        let s = if *passes == 1 { "" } else { "es" };
        write!(f, "{verdict} after {passes} pass{s} on {device}, {warp} by {weft} threads; ")?;
        if clearance.is_finite() {
            write!(f, "clearance {clearance:.3}")?;
        } else {
            write!(f, "no threads near one another")?;
        }
        if *rounds > 0 {
            let s = if *rounds == 1 { "" } else { "s" };
            write!(f, ", {clearance_before:.3} before threads were made thinner, {rounds} time{s}")?;
        }
        let kept =
            |area: &AreaReport| format!("{:.1} % (least {:.1} %)", area.mean * 100.0, area.least * 100.0);
        write!(f, "; area left of ends {}, of picks {}", kept(&self.area.warp), kept(&self.area.weft))?;
        match self.valley {
            None => {}
            Some(1.0) => write!(f, "; plies pressed until no valley is left between them")?,
            Some(valley) => {
                write!(f, "; plies pressed, with valleys between them at {valley} of a ply's reach")?
            }
        }
        if *verdict == Verdict::Jammed {
            write!(f, "; threads are as dense as their fibres allow")?;
            let lacking = 100.0 * (1.0 - clearance / CLEAR);
            if lacking > 0.0 {
                write!(f, ", and lack {lacking:.1} % of the distance that they need")?;
            }
        }
        Ok(())
    }
}
