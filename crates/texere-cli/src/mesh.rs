//! `texere mesh`

use std::io::IsTerminal;

use texere::check::counted;
use texere::write::Output;
use texere::{Backend, Pipeline, Yarns};

use crate::args::{MeshArgs, is_yarns, undersampled};
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print, progress, reading, settling};

pub(crate) fn run(args: &MeshArgs) -> Result<(), Fail> {
    if let Some(yarns) = reading::saved(&args.design, &args.settings, &args.settling)? {
        let output = Output::to(&args.output).sparing([&args.design]);
        let device = drivers::quietly(|| texere::open(&args.device))?;
        return print::text(&written(args, &yarns, &*device, output)?);
    }
    let mut design = reading::design(&args.design)?;
    if let Some(section) = &args.settings.section {
        design.structure.set_section(section.clone()).map_err(|error| design.refused(error))?;
    }
    let output = Output::to(&args.output).sparing(design.files());
    let device = drivers::quietly(|| texere::open(&args.device))?;
    output.check()?;
    let (cloth, settling) =
        settling::cloth(design, &args.settling, args.settings.tension(), || Ok(&*device))?;
    let warnings = reading::unsaid(&cloth.warnings(), cloth.design().remarks());
    let yarns = cloth.into_parts().1;
    let written = written(args, &yarns, &*device, output)?;
    for warning in warnings {
        print::text(&format!("warning: {}\n", line(warning)))?;
    }
    if let Some(settling) = settling {
        print::text(&format!("settling: {}\n", line(settling)))?;
    }
    print::text(&written)
}

/// Writes the yarns, or their mesh. Returns the lines to print about it.
fn written(args: &MeshArgs, yarns: &Yarns, device: &dyn Backend, output: Output) -> Result<String, Fail> {
    let path = line(args.output.display());
    if is_yarns(&args.output) {
        let bytes = texere::write::yarns(yarns, output)?;
        let (count, points) = (yarns.layout().yarns().len(), yarns.points().len());
        let (count, points) = (counted(count, "yarn"), counted(points, "control point"));
        return Ok(format!("{path}: {count}, {points}, {bytes} bytes\n"));
    }
    let settings = args.settings.of(yarns);
    let bar = progress::bar(std::io::stderr().is_terminal());
    let pipeline = Pipeline::new(yarns).settings(settings).progress(progress::reporter(&bar));
    let written = texere::write::stream(pipeline, device, output)?;
    bar.finish_and_clear();
    let warning = undersampled(yarns, &settings).map(|warning| format!("warning: {}\n", line(warning)));
    Ok(format!(
        "{}{path}: {} triangles, {} vertices, {} bytes, made by {}\n",
        warning.unwrap_or_default(),
        written.triangles,
        written.vertices,
        written.bytes,
        device.info().name
    ))
}
