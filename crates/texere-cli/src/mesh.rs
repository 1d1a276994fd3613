//! `texere mesh`

use std::io::IsTerminal;

use texere::{Output, Pipeline};

use crate::args::MeshArgs;
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print, progress};

pub(crate) fn run(args: &MeshArgs) -> Result<(), Fail> {
    let mut design = texere::read(&args.design)?;
    if let Some(section) = &args.settings.section {
        design.structure.set_section(section.clone())?;
    }
    let yarns = design.yarns()?;
    let device = drivers::quietly(|| texere::open(&args.device))?;
    let bar = progress::bar(std::io::stderr().is_terminal());
    let settings = args.settings.settings();
    let pipeline = Pipeline::new(&yarns).settings(settings).progress(progress::reporter(&bar));
    let output = Output::to(&args.output).sparing(design.files());
    let written = texere::stream(pipeline, &*device, output)?;
    bar.finish_and_clear();
    for warning in design.warnings() {
        print::text(&format!("warning: {}\n", line(warning)))?;
    }
    print::text(&format!(
        "{}: {} triangles, {} vertices, {} bytes, made by {}\n",
        line(args.output.display()),
        written.triangles,
        written.vertices,
        written.bytes,
        device.info().name
    ))
}
