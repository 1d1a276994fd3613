//! Lets yarns settle before they are measured, drawn or written, and reports how they did.

mod plot;

use std::ops::Deref;

use texere::check::SettlingReport;
use texere::rest::{Finished, RestBy, RestReport, stand_in};
use texere::write::Output;
use texere::{Backend, BackendError, Cloth, Design};

use crate::args::SettlingArgs;
use crate::fail::Fail;
use crate::{drivers, progress, terminal};
use plot::plot;

/// The line of a report about settling. Each clause of it is short enough for a terminal.
pub(crate) fn said(report: &SettlingReport) -> String {
    let clauses: Vec<_> = report.clauses().iter().map(terminal::line).collect();
    format!("settling: {}\n", clauses.join("; "))
}

/// The cloth of a design, with splines of `tension`. If its yarns settle, by the command line or
/// else by the design, there is a report. The device that `open` gives does the work. The CPU
/// stands in for a device that can't do it, see [`stand_in`].
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
    let is_plotted = design.structure.woven().is_none() && design.finish.by == RestBy::Contact;
    if args.settling_plot.is_some() && !is_plotted {
        return Err(Fail::no_course());
    }
    let output = args.settling_plot.as_ref().map(|path| Output::to(path).sparing(design.files()));
    output.iter().try_for_each(Output::check)?;
    let given = drivers::quietly(open)?;
    let cpu = stand_in(design.finish.by, &*given)?;
    let device: &dyn Backend = cpu.as_deref().unwrap_or(&*given);
    (design.settle, design.finish.record) = (true, output.is_some());
    let cloth = progress::during("settling", |bar| {
        design.rest(device).tension(tension).progress(progress::share(bar)).run()
    })?;
    if let (Some(output), RestReport::Finished(Finished::Knit(settled))) = (output, cloth.report()) {
        texere::write::file(plot(&settled.course).as_bytes(), output)?;
    }
    let report = SettlingReport::new(&cloth, &device.info().name);
    Ok((cloth, report))
}
