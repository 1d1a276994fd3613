//! `texere test`

use std::path::PathBuf;

use texere::check::StrainReport;
use texere::write::Output;

use crate::args::TestArgs;
use crate::fail::Fail;
use crate::{print, progress, reading, terminal};

pub(crate) fn run(args: &TestArgs) -> Result<(), Fail> {
    let design = reading::design(&args.design)?;
    let to = |path: &Option<PathBuf>| path.as_ref().map(|path| Output::to(path).sparing(design.files()));
    let (table, plot) = (to(&args.output), to(&args.plot));
    table.iter().chain(&plot).try_for_each(Output::check)?;
    let device = texere::open("cpu")?;
    let strains: Vec<f64> =
        (1..=args.states).map(|at| args.to * f64::from(at) / f64::from(args.states)).collect();
    let mut tests = Vec::new();
    for (number, along) in args.along.iter().enumerate() {
        if args.along[..number].contains(along) {
            continue;
        }
        tests.push(progress::during("straining", |bar| {
            design.strain_test(*along, &strains, &*device, progress::share(bar))
        })?);
    }
    let report = StrainReport::new(&design, &device.info().name, &tests);
    if let Some(table) = table {
        texere::write::file(report.csv().as_bytes(), table)?;
    }
    if let Some(plot) = plot {
        texere::write::file(report.svg().as_bytes(), plot)?;
    }
    if args.json {
        print::json(&report)
    } else {
        print::text(&format!("{}\n{}", terminal::line(&design.name), report.text()))
    }
}
