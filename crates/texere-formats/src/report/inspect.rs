//! The report of a design: what cloth it makes, and the measures of the cloth.

use std::fmt;

use serde::Serialize;
use texere_core::backend::Plan;
use texere_core::{Counts, Undersampled, Yarns, counted};
use texere_fabric::ClothClearance;
use texere_fabric::warp::{Bar, WarpKnitted};
use texere_fabric::weft::Knitted;

use super::SettlingReport;
use super::clearance::{ClearanceReport, CurvatureReport};
use super::measures::{JamsReport, MeasuresReport, Sets};
use super::setts::{SettReport, setts};
use super::under::{YarnUnder, under};
use crate::{Cloth, Design, Refusal};

/// How far the run-in of a guide bar may differ from the design's without a warning, as a share.
const RUN_IN_MISS: f64 = 0.02;

/// What a design makes: counts, size, yarn, weight, clearance, bends, warnings. `texere inspect`
/// prints its [lines](Self::lines). With `--json` it prints the serialized report, whose keys are
/// these fields.
#[derive(Debug, Serialize)]
pub struct InspectReport {
    name: String,
    #[serde(flatten)]
    size: Size,
    #[serde(skip_serializing_if = "Option::is_none", flatten)]
    knit: Option<KnitReport>,
    #[serde(skip_serializing_if = "Option::is_none", flatten)]
    cloth: Option<ClothReport>,
    /// The yarns under the point that was asked for, the topmost first.
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<Vec<YarnUnder>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    settling: Option<SettlingReport>,
    warnings: Vec<String>,
}

/// The counts of the design's mesh.
#[derive(Debug, Serialize)]
struct Size {
    yarns: u64,
    control_points: u64,
    rings: u64,
    vertices: u64,
    triangles: u64,
    /// Bytes of the mesh in memory: 24 a vertex, 4 an index.
    bytes: u64,
}

/// Counts of a knit.
#[derive(Debug, Serialize)]
struct KnitReport {
    /// Number of loops. A knit, tuck or split operation makes a loop of each yarn that it carries.
    loops: u64,
    courses: u32,
    wales: u32,
    /// The guide bars of a warp knit, the front one first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    bars: Vec<BarReport>,
}

/// A guide bar.
#[derive(Debug, Serialize)]
struct BarReport {
    lapping: String,
    /// The length of yarn that the design asks for in a rack of 480 courses, mm. None if it asks
    /// for none.
    #[serde(skip_serializing_if = "Option::is_none")]
    run_in_asked_mm: Option<f64>,
    /// The length of yarn for a rack of 480 courses in the cloth, mm. None without measures.
    #[serde(skip_serializing_if = "Option::is_none")]
    run_in_mm: Option<f64>,
}

/// The report of the design's yarns as cloth.
#[derive(Debug, Serialize)]
struct ClothReport {
    #[serde(skip_serializing_if = "Option::is_none", flatten)]
    woven: Option<WovenReport>,
    size_mm: [f64; 2],
    measures: MeasuresReport,
    clearance: ClearanceReport,
    curvature: CurvatureReport,
}

/// The report of woven cloth.
#[derive(Debug, Serialize)]
struct WovenReport {
    ends: usize,
    picks: usize,
    /// Whether crossing threads have room to pass. It is left out for cloth at rest, whose threads
    /// have given way.
    #[serde(skip_serializing_if = "Option::is_none")]
    jam: Option<JamsReport>,
    setts: Sets<SettReport>,
    /// Numbers of levels on which ends and picks lie.
    levels: Sets<u32>,
}

impl InspectReport {
    /// The report of a cloth, of how it came to rest, and of the mesh of `plan`, which is a plan of
    /// the cloth's yarns. Without a [clearance](Cloth::clearance) the report has counts but no
    /// measures.
    ///
    /// **Errors**: a [`Refusal`] if the measures can't be taken.
    pub fn new(
        cloth: &Cloth,
        mut settling: Option<SettlingReport>,
        plan: &Plan,
        clearance: Option<&ClothClearance>,
    ) -> Result<Self, Refusal> {
        let (design, yarns) = (cloth.design(), cloth.yarns());
        let settled = settling.as_ref().is_some_and(SettlingReport::has_moved);
        if let (Some(settling), Some(clearance)) = (&mut settling, clearance) {
            settling.measured(clearance);
        }
        let measured =
            clearance.map(|clearance| ClothReport::new(design, yarns, settled, clearance)).transpose()?;
        let weft = design.structure.knitted().map(KnitReport::new);
        let warp = || {
            let measured = clearance.map(|_| yarns);
            design.structure.warp_knitted().map(|knit| KnitReport::of_warp(knit, measured))
        };
        let knit = weft.or_else(warp);
        let mut warnings = cloth.warnings();
        warnings.extend(knit.iter().flat_map(KnitReport::missed));
        warnings.extend(Undersampled::of(yarns, plan.settings()).map(|found| found.to_string()));
        let (name, size) = (design.name.clone(), Size::new(plan.counts()));
        Ok(Self { name, size, knit, cloth: measured, at: None, settling, warnings })
    }

    /// The report with the yarns of `cloth` that lie under a point (x, y), mm, the topmost first.
    #[must_use]
    pub fn with_yarns_under(self, cloth: &Cloth, point: [f32; 2]) -> Self {
        Self { at: Some(under(cloth.design(), cloth.yarns(), point)), ..self }
    }

    /// What a designer should know: the cloth's [warnings](Cloth::warnings), run-ins that were
    /// missed, and twist that the mesh does not show.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The report for people: a label and what is said of it, line by line. Warnings that were
    /// `said` already are left out.
    #[must_use]
    pub fn lines(&self, said: &[String]) -> Vec<(&'static str, String)> {
        let size = &self.size;
        let mut lines = vec![
            ("yarns", size.yarns.to_string()),
            ("control points", size.control_points.to_string()),
            ("rings", size.rings.to_string()),
            ("vertices", size.vertices.to_string()),
            ("triangles", size.triangles.to_string()),
            ("mesh, bytes", size.bytes.to_string()),
        ];
        if let Some(KnitReport { loops, courses, wales, bars }) = &self.knit {
            lines.push((
                "loops",
                format!("{loops} in {} of {}", counted(*courses, "course"), counted(*wales, "wale")),
            ));
            let named = (0..)
                .zip(bars)
                .map(|(number, bar)| (if number == 0 { "guide bars" } else { "" }, bar.to_string()));
            lines.extend(named);
        }
        lines.extend(self.settling.iter().flat_map(SettlingReport::lines));
        lines.extend(self.cloth.iter().flat_map(ClothReport::lines));
        if let Some(under) = &self.at {
            let none = under.is_empty().then(|| "no yarn".into());
            let said = under.iter().map(ToString::to_string).chain(none);
            lines.extend(
                said.enumerate().map(|(number, said)| (if number == 0 { "at the point" } else { "" }, said)),
            );
        }
        let unsaid = self.warnings.iter().filter(|warning| !said.contains(warning));
        lines.extend(unsaid.map(|warning| ("warning", warning.clone())));
        lines
    }
}

impl Size {
    fn new(counts: &Counts) -> Self {
        Self {
            yarns: counts.yarns,
            control_points: counts.control_points,
            rings: counts.rings,
            vertices: counts.vertices,
            triangles: counts.triangles,
            bytes: counts.bytes(),
        }
    }
}

impl KnitReport {
    fn new(knit: &Knitted) -> Self {
        let [wales, courses] = knit.size();
        Self { loops: knit.loops(), courses, wales, bars: Vec::new() }
    }

    /// The report of a warp knit. Run-ins are left out without `measured` yarns.
    fn of_warp(knit: &WarpKnitted, measured: Option<&Yarns>) -> Self {
        let [wales, courses] = knit.size();
        let run_ins = measured.map(|yarns| knit.run_ins(yarns)).unwrap_or_default();
        let mut run_ins = run_ins.into_iter();
        let bar = |bar: &Bar| {
            let run_in_mm = run_ins.next().map(|run_in| run_in.reached_mm);
            BarReport { lapping: bar.chain.to_string(), run_in_asked_mm: bar.run_in_mm, run_in_mm }
        };
        Self { loops: knit.loops(), courses, wales, bars: knit.bars().iter().map(bar).collect() }
    }

    /// Warnings of bars whose run-in differs from the design's by more than [`RUN_IN_MISS`].
    fn missed(&self) -> impl Iterator<Item = String> {
        (1..).zip(&self.bars).filter_map(|(number, bar)| {
            let (asked, reached) = (bar.run_in_asked_mm?, bar.run_in_mm?);
            let miss = reached / asked - 1.0;
            (miss.abs() > RUN_IN_MISS).then(|| {
                format!(
                    "bar {number} takes {reached:.0} mm a rack, {:+.1} % off the {asked:.0} mm asked for",
                    miss * 100.0
                )
            })
        })
    }
}

impl fmt::Display for BarReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.lapping)?;
        if let Some(reached) = self.run_in_mm {
            write!(f, ", run-in {reached:.0} mm")?;
        }
        if let Some(asked) = self.run_in_asked_mm {
            write!(f, ", asked for {asked:.0} mm")?;
        }
        Ok(())
    }
}

impl ClothReport {
    fn new(
        design: &Design,
        yarns: &Yarns,
        settled: bool,
        clearance: &ClothClearance,
    ) -> Result<Self, Refusal> {
        let structure = &design.structure;
        let measures = structure.measures(yarns).map_err(|error| design.refused(error))?;
        Ok(Self {
            woven: structure.woven().map(|woven| WovenReport {
                ends: woven.cloth().warp().len(),
                picks: woven.cloth().weft().len(),
                jam: (!settled).then(|| JamsReport::from(woven.jam_report())),
                setts: setts(woven.cloth()),
                levels: woven.cloth().level_counts().map(u32::from).into(),
            }),
            size_mm: structure.size_mm(),
            measures: MeasuresReport::new(&measures, yarns.materials()),
            clearance: ClearanceReport::from(clearance),
            curvature: CurvatureReport::from(&clearance.bend),
        })
    }

    fn lines(&self) -> Vec<(&'static str, String)> {
        let percent = |share: f64| format!("{:.1} %", share * 100.0);
        let measures = &self.measures;
        let [width, height] = self.size_mm;
        let mut lines = vec![
            (
                "cloth",
                format!(
                    "{width:.1} × {height:.1} mm, {:.3} mm thick{}",
                    measures.thickness_mm,
                    self.woven
                        .iter()
                        .map(|woven| {
                            format!(", {} by {}", counted(woven.ends, "end"), counted(woven.picks, "pick"))
                        })
                        .collect::<String>()
                ),
            ),
            ("yarn, m", format!("{:.3}", measures.length_mm / 1000.0)),
        ];
        for yarn in &measures.yarns {
            let weight = yarn.weight_g.map(|grams| format!(", {grams:.3} g")).unwrap_or_default();
            lines.push(("", format!("{} {:.3}{weight}", yarn.yarn, yarn.length_mm / 1000.0)));
        }
        // Yarns that no structure made have no area, so their own weights are all that is known.
        let weight = match measures.areal_weight_g_per_m2 {
            Some(grams) => Some(format!("{grams:.1} g/m²")),
            None if measures.yarns.iter().all(|yarn| yarn.tex.is_some()) => None,
            None => Some("not known: not every yarn has tex".into()),
        };
        lines.extend(weight.map(|weight| ("weight", weight)));
        if let Some(knit) = &measures.knit {
            let tightness =
                knit.tightness.map(|tightness| format!(", tightness {tightness:.1}")).unwrap_or_default();
            let said = format!(
                "{:.3} mm{tightness}; {:.1} loops to the cm²",
                knit.loop_length_mm, knit.loops_per_cm2
            );
            lines.push(("loop", said));
        }
        if let (Some(crimp), Some(woven)) = (measures.crimp, &self.woven) {
            let share = woven.jam.as_ref().map(|jam| format!("; the warp's share is {:.2}", jam.warp_crimp));
            let [warp, weft] = [crimp.warp, crimp.weft].map(percent);
            lines.push(("crimp", format!("warp {warp}, weft {weft}{}", share.unwrap_or_default())));
        }
        if let Some(cover) = &measures.cover {
            let [cloth, ends, picks] = [cover.cloth, cover.fraction.warp, cover.fraction.weft].map(percent);
            lines.push(("cover", format!("{cloth}: ends {ends}, picks {picks}")));
        }
        lines.extend(self.woven.iter().flat_map(|woven| woven.setts.lines()));
        if let Some(WovenReport { levels: Sets { warp, weft }, jam, .. }) = &self.woven
            && warp.max(weft) > &1
        {
            let drawn = if jam.is_some() { "; as woven all are drawn side by side" } else { "" };
            lines.push(("levels", format!("of ends {warp}, of picks {weft}{drawn}")));
        }
        let jams = self.woven.iter().filter_map(|woven| woven.jam.as_ref());
        let pitches =
            jams.flat_map(|jam| [("pitch of ends", &jam.after.warp), ("pitch of picks", &jam.after.weft)]);
        for (pitch, found) in pitches {
            if let Some(tightest) = &found.tightest {
                let text = format!(
                    "{:.3} mm at {tightest}; {:.3} mm is the least that round threads pass",
                    found.pitch_mm, found.pitch_min_mm
                );
                lines.push((pitch, text));
            }
        }
        lines.push(("clearance", self.clearance.to_string()));
        lines.extend(self.clearance.crowd.iter().map(|crowd| ("crowded", crowd.to_string())));
        lines.push(("bends", self.curvature.to_string()));
        lines
    }
}
