//! The report of a cloth's yarn, weight and thickness.

use std::collections::BTreeMap;

use serde::Serialize;
use texere_core::Material;
use texere_fabric::{BySet, JamReport, KnitMeasures, Measures, Tightness};

/// A value for the warp, and one for the weft.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Sets<T> {
    pub(crate) warp: T,
    pub(crate) weft: T,
}

impl<T> From<BySet<T>> for Sets<T> {
    fn from(BySet { warp, weft }: BySet<T>) -> Self {
        Self { warp, weft }
    }
}

/// [`Measures`] with the names and colours of yarns.
#[derive(Debug, Serialize)]
pub(crate) struct MeasuresReport {
    /// Length of all yarn, mm.
    pub(crate) length_mm: f64,
    pub(crate) yarns: Vec<YarnReport>,
    /// Length of yarn of each colour, mm.
    colors: BTreeMap<String, f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) crimp: Option<Sets<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) cover: Option<CoverReport>,
    /// Only for knits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) knit: Option<LoopsReport>,
    pub(crate) areal_weight_g_per_m2: Option<f64>,
    pub(crate) thickness_mm: f64,
}

/// [`KnitMeasures`] for JSON.
#[derive(Debug, Serialize)]
pub(crate) struct LoopsReport {
    pub(crate) loop_length_mm: f64,
    pub(crate) loops_per_cm2: f64,
    pub(crate) tightness: Option<f64>,
}

impl From<KnitMeasures> for LoopsReport {
    fn from(found: KnitMeasures) -> Self {
        Self {
            loop_length_mm: found.loop_length_mm,
            loops_per_cm2: found.stitch_density,
            tightness: found.tightness,
        }
    }
}

/// The yarn of one material in the cloth.
#[derive(Debug, Serialize)]
pub(crate) struct YarnReport {
    pub(crate) yarn: String,
    color: String,
    pub(crate) tex: Option<f32>,
    pub(crate) length_mm: f64,
    pub(crate) weight_g: Option<f64>,
}

#[derive(Debug, Serialize)]
pub(crate) struct CoverReport {
    factor: Option<Sets<f64>>,
    cloth_factor: Option<f64>,
    pub(crate) fraction: Sets<f64>,
    pub(crate) cloth: f64,
}

impl MeasuresReport {
    pub(crate) fn new(measures: &Measures, materials: &[Material]) -> Self {
        let used = materials.iter().zip(&measures.length_mm).filter(|(_, length)| **length > 0.0);
        let yarns: Vec<_> = used.map(|(material, &length_mm)| YarnReport::new(material, length_mm)).collect();
        let mut colors = BTreeMap::new();
        for yarn in &yarns {
            *colors.entry(yarn.color.clone()).or_default() += yarn.length_mm;
        }
        Self {
            length_mm: measures.length_mm.iter().sum(),
            yarns,
            colors,
            crimp: measures.crimp.map(Sets::from),
            cover: measures.cover.map(|cover| CoverReport {
                factor: cover.factor.map(Sets::from),
                cloth_factor: cover.cloth_factor,
                fraction: cover.fraction.into(),
                cloth: cover.cloth,
            }),
            knit: measures.knit.map(LoopsReport::from),
            areal_weight_g_per_m2: measures.areal_weight,
            thickness_mm: measures.thickness_mm,
        }
    }
}

impl YarnReport {
    fn new(material: &Material, length_mm: f64) -> Self {
        let [red, green, blue] = material.srgb;
        Self {
            yarn: material.name.clone(),
            color: format!("#{red:02x}{green:02x}{blue:02x}"),
            tex: material.tex,
            length_mm,
            // tex is g/km.
            weight_g: material.tex.map(|tex| length_mm * 1e-6 * f64::from(tex)),
        }
    }
}

/// [`JamReport`] for JSON: jammed threads before and after relief, and the relief.
#[derive(Debug, Serialize)]
pub(crate) struct JamsReport {
    before: Sets<TightnessReport>,
    pub(crate) after: Sets<TightnessReport>,
    pub(crate) warp_crimp: f32,
    widened: Sets<f32>,
    scaled: f32,
}

/// How close the threads of one set lie, compared with the least pitch.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct TightnessReport {
    pub(crate) jammed: usize,
    pub(crate) tightest: Option<String>,
    pub(crate) pitch_min_mm: f64,
    pub(crate) pitch_mm: f64,
}

impl From<Tightness> for TightnessReport {
    fn from(found: Tightness) -> Self {
        Self {
            jammed: found.jammed,
            tightest: found.tightest.map(|thread| thread.to_string()),
            pitch_min_mm: found.pitch_min_mm,
            pitch_mm: found.pitch_mm,
        }
    }
}

impl From<&JamReport> for JamsReport {
    fn from(found: &JamReport) -> Self {
        Self {
            before: found.before.map(TightnessReport::from).into(),
            after: found.after.map(TightnessReport::from).into(),
            warp_crimp: found.warp_share[1],
            widened: found.widened.into(),
            scaled: found.scaled,
        }
    }
}
