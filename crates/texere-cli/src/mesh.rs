//! `texere mesh`

use std::io::IsTerminal;

use texere::{Limits, Pipeline};

use crate::args::MeshArgs;
use crate::fail::Fail;
use crate::progress;

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
    let written =
        texere::stream(pipeline.limits(limits).progress(progress::teller(&bar)), &*device, &args.output)?;
    bar.finish_and_clear();
    for warning in design.warnings() {
        crate::print(&format!("warning: {warning}\n"))?;
    }
    crate::print(&format!(
        "{}: {} triangles, {} vertices, {} bytes, made by {}\n",
        args.output.display(),
        written.triangles,
        written.vertices,
        written.bytes,
        device.info().name
    ))
}
