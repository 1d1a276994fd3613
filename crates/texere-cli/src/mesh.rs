//! `texere mesh`

use std::io::IsTerminal;

use texere::{Output, Pipeline};

use crate::args::{MeshArgs, undersampled};
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print, progress, reading, settling};

pub(crate) fn run(args: &MeshArgs) -> Result<(), Fail> {
    let mut design = reading::design(&args.design)?;
    if let Some(section) = &args.settings.section {
        design.structure.set_section(section.clone()).map_err(|error| design.refused(error))?;
    }
    let output = Output::to(&args.output).sparing(design.files());
    let device = drivers::quietly(|| texere::open(&args.device))?;
    output.check()?;
    let (cloth, settling) = settling::cloth(design, &args.settling, args.settings.tension, || Ok(&*device))?;
    let yarns = cloth.yarns();
    let settings = args.settings.of(yarns);
    let bar = progress::bar(std::io::stderr().is_terminal());
    let pipeline = Pipeline::new(yarns).settings(settings).progress(progress::reporter(&bar));
    let written = texere::stream(pipeline, &*device, output)?;
    bar.finish_and_clear();
    let warnings = reading::unsaid(&cloth.warnings(), cloth.design().remarks());
    for warning in warnings.into_iter().chain(undersampled(yarns, &settings)) {
        print::text(&format!("warning: {}\n", line(warning)))?;
    }
    if let Some(settling) = settling {
        print::text(&format!("settling: {}\n", line(settling)))?;
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
