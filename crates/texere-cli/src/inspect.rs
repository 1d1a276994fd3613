//! `texere inspect`

use std::fmt::Write;

use serde::Serialize;
use texere::{Design, Pipeline};

use crate::args::InspectArgs;
use crate::fail::Fail;

/// What is said of a design. The keys of the JSON are these fields.
#[derive(Debug, Serialize)]
struct Report {
    name: String,
    yarns: u64,
    control_points: u64,
    rings: u64,
    vertices: u64,
    triangles: u64,
    /// Bytes of the mesh in memory: 24 a vertex, 4 an index.
    bytes: u64,
    /// Yarn in the fabric, mm.
    length_mm: f64,
    warnings: Vec<String>,
}

pub(crate) fn run(args: &InspectArgs) -> Result<(), Fail> {
    let mut design = texere::read(&args.design)?;
    if let Some(section) = &args.settings.section {
        design.set_section(section.clone())?;
    }
    let report = report(design, args)?;
    if args.json {
        let json = serde_json::to_string_pretty(&report).map_err(|error| Fail::output(error.into()))?;
        return crate::print(&(json + "\n"));
    }
    crate::print(&report.text())
}

fn report(design: Design, args: &InspectArgs) -> Result<Report, Fail> {
    let yarns = design.yarns()?;
    let settings = args.settings.settings();
    let counts = *Pipeline::new(&yarns).settings(settings).plan()?.counts();
    Ok(Report {
        warnings: design.warnings(),
        name: design.name,
        yarns: counts.yarns,
        control_points: counts.control_points,
        rings: counts.rings,
        vertices: counts.vertices,
        triangles: counts.triangles,
        bytes: counts.bytes(),
        length_mm: texere::length_mm(&yarns, settings.tension),
    })
}

impl Report {
    fn text(&self) -> String {
        let mut text = format!("{}\n", self.name);
        let lines: [(&str, String); 7] = [
            ("yarns", self.yarns.to_string()),
            ("control points", self.control_points.to_string()),
            ("rings", self.rings.to_string()),
            ("vertices", self.vertices.to_string()),
            ("triangles", self.triangles.to_string()),
            ("mesh, bytes", self.bytes.to_string()),
            ("yarn, m", format!("{:.3}", self.length_mm / 1000.0)),
        ];
        for (what, value) in lines {
            // Writing to a string can't fail.
            let _ = writeln!(text, "{what:>16}  {value}");
        }
        for warning in &self.warnings {
            let _ = writeln!(text, "{:>16}  {warning}", "warning");
        }
        text
    }
}
