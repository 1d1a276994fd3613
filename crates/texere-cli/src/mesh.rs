//! `texere mesh`

use std::io::IsTerminal;

use texere::{Limits, Output, Pipeline};

use crate::args::MeshArgs;
use crate::fail::Fail;
use crate::progress;
use crate::terminal::line;

/// Memory for chunks in flight: enough to keep any device busy, little beside the fabric itself.
const CHUNK_MEMORY: u64 = 256 << 20;

pub(crate) fn run(args: &MeshArgs) -> Result<(), Fail> {
    let mut design = texere::read(&args.design)?;
    if let Some(section) = &args.settings.section {
        design.set_section(section.clone())?;
    }
    let yarns = design.yarns()?;
    let device = texere::open(&args.device)?;
    let pipeline = Pipeline::new(&yarns).settings(args.settings.settings());
    let resident = pipeline.plan()?.resident_bytes();
    let limits = Limits { memory_bytes: resident + CHUNK_MEMORY, ..Limits::NONE };
    let bar = progress::bar(std::io::stderr().is_terminal());
    let pipeline = pipeline.limits(limits).progress(progress::teller(&bar));
    let output = Output::to(&args.output).sparing(design.files());
    let written = texere::stream(pipeline, &*device, output)?;
    bar.finish_and_clear();
    for warning in design.warnings() {
        crate::print(&format!("warning: {}\n", line(warning)))?;
    }
    crate::print(&format!(
        "{}: {} triangles, {} vertices, {} bytes, made by {}\n",
        line(args.output.display()),
        written.triangles,
        written.vertices,
        written.bytes,
        device.info().name
    ))
}
