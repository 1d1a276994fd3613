//! The report of cures: the key of a design file, its new value, and the effect.

use std::fmt;
use std::ops::RangeInclusive;

use serde::Serialize;
use texere_fabric::{BySet, ClothFault, Cure, Diagnosis, JamReport, Relief, Remedy, Shape};

use super::clearance::as_near_as_looked;

/// Spacings and diameters that a design file may have, mm.
const LENGTHS_MM: RangeInclusive<f64> = 0.001..=1000.0;

/// One change of a design that helps.
#[derive(Debug, Serialize)]
pub(crate) struct CureReport {
    /// The key of the design file.
    key: &'static str,
    /// The key's new value.
    value: String,
    /// The effect of the new value.
    effect: String,
    /// The least clearance with the change, at the places that were the worst without it.
    #[serde(serialize_with = "as_near_as_looked")]
    clearance: f64,
    /// The tightest bend with the change, at the same places.
    curvature: f64,
    /// The faults that the change does not cure.
    leaves: Option<String>,
}

impl CureReport {
    /// None for a cure beyond the limits of a design file, such as the spacing that yarns far too
    /// thick would need.
    pub(crate) fn new(cure: &Cure) -> Option<Self> {
        let (key, value, effect) = change(&cure.remedy)?;
        Some(Self {
            key,
            value,
            effect,
            clearance: cure.clearance,
            curvature: cure.curvature,
            leaves: phrase(&cure.leaves),
        })
    }
}

impl CureReport {
    /// The report of the cure for a mesh that is wrung or inside out. The cure is more rings. Its
    /// `key` is an option of the commands that draw, not a key of a design file.
    pub(crate) fn finer(subdivisions: u32, diagnosis: &Diagnosis) -> Self {
        let drawn = [ClothFault::Wrung, ClothFault::InsideOut];
        let mut leaves = diagnosis.faults.kinds();
        leaves.retain(|kind| !drawn.contains(kind));
        Self {
            key: "--subdivisions",
            value: subdivisions.to_string(),
            effect: "rings closer together in meshes and pictures".into(),
            clearance: diagnosis.clearance.least(),
            curvature: diagnosis.clearance.bend.radii,
            leaves: phrase(&leaves),
        }
    }
}

/// Key, value and effect of a remedy. None for a value beyond [`LENGTHS_MM`], and for a remedy
/// without a key.
fn change(remedy: &Remedy) -> Option<(&'static str, String, String)> {
    Some(match remedy {
        Remedy::Shape(Shape::Round) => (
            "cloth.shape",
            "\"round\"".into(),
            "three control points more where a thread changes sides".into(),
        ),
        Remedy::WarpShare { before, after } => (
            "cloth.warp_crimp",
            format!("{after:.2}"),
            format!("the warp's share of the crimp is {before:.2}"),
        ),
        Remedy::Relief { relief, report, thickest_mm } => {
            let value = if *relief == Relief::Shrink { "\"shrink\"" } else { "\"flatten\"" };
            ("cloth.jam", value.into(), relieved(report, *thickest_mm))
        }
        Remedy::Circle => (
            "section of every yarn",
            "{ shape = \"circle\" }".into(),
            "round yarns of the same area, without flatness or plies".into(),
        ),
        Remedy::Flatness(flatness) => {
            ("flatness of every yarn", flatness.to_string(), "flatter yarns of the same area".into())
        }
        Remedy::Spacing { spacing_mm, factor }
            if spacing_mm.into_array().iter().all(|mm| LENGTHS_MM.contains(mm)) =>
        {
            let (BySet { warp, weft }, per_cm) = (*spacing_mm, spacing_mm.map(|mm| 10.0 / mm));
            (
                "warp.spacing_mm, weft.spacing_mm",
                format!("{warp:.4}, {weft:.4}"),
                format!("{factor:.2} times as wide, {:.2} and {:.2} threads a cm", per_cm.warp, per_cm.weft),
            )
        }
        Remedy::Diameter { thickest_mm: [before, after] } if LENGTHS_MM.contains(after) => (
            "diameter_mm of every yarn",
            format!("{after:.4}"),
            // Thinner yarns make the cloth of the wider spacing at another scale, so that a yarn's
            // tex changes with the square of its diameter.
            format!(
                "for the thickest instead of {before:.4} mm, every yarn {:.4} times as thick, with {:.4} times its tex",
                after / before,
                (after / before).powi(2)
            ),
        ),
        _ => return None,
    })
}

/// The changes that relief has made.
fn relieved(report: &JamReport, [before, after]: [f64; 2]) -> String {
    let [share, new_share] = report.warp_share;
    let mut effects = Vec::new();
    if share != new_share {
        effects.push(format!("the warp takes {new_share:.2} of the crimp instead of {share:.2}"));
    }
    for (set, wider) in [("ends", report.widened.warp), ("picks", report.widened.weft)] {
        if wider != 1.0 {
            effects.push(format!("{set} {wider:.2} times as wide and as much flatter"));
        }
    }
    if report.scaled != 1.0 {
        effects.push(format!("yarns {after:.4} mm thick at most instead of {before:.4} mm"));
    }
    effects.join(", ")
}

impl fmt::Display for CureReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, value, effect, clearance, curvature, leaves } = self;
        write!(f, "{key} = {value}: {effect}; then ")?;
        if clearance.is_finite() {
            write!(f, "{clearance:.4} of touching, ")?;
        }
        write!(f, "bends of {curvature:.2} radii")?;
        leaves.iter().try_for_each(|left| write!(f, ", but it still {left}"))
    }
}

/// The faults of a cloth in one phrase, if it has any: "pierces itself, folds".
pub(crate) fn phrase(faults: &[ClothFault]) -> Option<String> {
    let kinds: Vec<_> = faults.iter().map(ToString::to_string).collect();
    (!kinds.is_empty()).then(|| kinds.join(", "))
}
