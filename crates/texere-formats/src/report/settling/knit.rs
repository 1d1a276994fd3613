//! The report of yarns that have settled by contact.

use std::fmt;

use serde::Serialize;
use texere_contact::Passage;
use texere_core::settling::Length;
use texere_fabric::{Press, Settled, Verdict};

use crate::Design;
use crate::report::clearance::{as_near_as_looked, place};

/// How yarns have settled. The keys of the JSON are these fields.
#[derive(Debug, Serialize)]
pub(crate) struct KnitRestReport {
    device: String,
    at_rest: bool,
    #[serde(skip)]
    verdict: Verdict,
    #[serde(skip)]
    pub(super) press_missed: Option<String>,
    /// Number of all passes.
    passes: u32,
    /// Number of the passes in the block form.
    block_passes: u32,
    /// The least clearance of surfaces as drawn, 1 if they touch.
    #[serde(serialize_with = "as_near_as_looked")]
    pub(super) clearance: f64,
    /// The least radius of curvature, in diameters of the yarn.
    radius_diameters: f32,
    /// The most by which the length of a part of a yarn differs from the length that it is to have,
    /// as a share. Null if lengths are free.
    length_off: Option<f32>,
    /// How thick the cloth was to be pressed, and how thick it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    press: Option<PressReport>,
    /// Whether it is known that no yarn has passed through another. If not, all yarns are as the
    /// structure places them.
    linked: bool,
    /// The worst place where a yarn has passed through another.
    passage: Option<PassageReport>,
}

/// A press: the distance of its plates, and the thickness of the cloth.
#[derive(Debug, Serialize)]
struct PressReport {
    asked_mm: f64,
    reached_mm: f64,
}

/// Two yarns that have passed through one another.
#[derive(Debug, Serialize)]
struct PassageReport {
    yarns: [String; 2],
    /// Half way between the two centrelines, mm.
    place_mm: [f64; 3],
    /// The change of the two yarns' linking integral.
    change: f64,
}

impl KnitRestReport {
    pub(super) fn new(design: &Design, settled: &Settled, device: &str) -> Self {
        let rest = &settled.rest;
        let passage = |passage: &Passage| {
            let [one, other] = passage.places.map(|place| design.structure.place(&settled.yarns, &place));
            let middle = |axis: usize| f64::midpoint(one.position_mm[axis], other.position_mm[axis]);
            PassageReport {
                yarns: [one, other].map(|place| place.thread_name()),
                place_mm: std::array::from_fn(middle),
                change: passage.change,
            }
        };
        Self {
            device: device.to_owned(),
            at_rest: settled.verdict() == Verdict::AtRest,
            verdict: settled.verdict(),
            press_missed: settled.press.and_then(|press| press.missed()).map(|missed| missed.to_string()),
            press: settled.press.map(|Press { asked_mm, reached_mm }| PressReport { asked_mm, reached_mm }),
            passes: rest.passes,
            block_passes: rest.block_passes,
            clearance: settled.clearance.min,
            radius_diameters: rest.end.radius,
            length_off: match settled.length {
                Length::Free { .. } => None,
                Length::Held | Length::Given(_) => Some(rest.end.length),
            },
            linked: settled.is_linked(),
            passage: settled.linking.worst.first().map(passage),
        }
    }
}

impl fmt::Display for KnitRestReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { device, verdict, passes, block_passes, clearance, radius_diameters, .. } = self;
        let s = if *passes == 1 { "" } else { "es" };
        write!(
            f,
            "{verdict} after {passes} pass{s} on {device}, {block_passes} of them in the block form; "
        )?;
        if clearance.is_finite() {
            write!(f, "clearance {clearance:.3}, ")?;
        }
        if radius_diameters.is_finite() {
            write!(f, "least radius of curvature {radius_diameters:.3} diameters, ")?;
        }
        match self.length_off {
            Some(off) => write!(f, "lengths off by {:.1} % at most; ", off * 100.0)?,
            None => write!(f, "lengths free; ")?,
        }
        match &self.passage {
            _ if self.linked => write!(f, "linking unchanged"),
            Some(PassageReport { yarns: [one, other], place_mm, .. }) => {
                let at = place(*place_mm);
                write!(f, "linking changed, so the yarns are as before: {one} and {other} met at {at}")
            }
            None => write!(f, "linking not known, so the yarns are as before"),
        }
    }
}
