//! `texere bake`

use texere::picture::bake::{BakeOptions, bake};
use texere::rest::stand_in;

use crate::args::BakeArgs;
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print, progress, reading};

pub(crate) fn run(args: &BakeArgs) -> Result<(), Fail> {
    texere::write::vacant(&args.output)?;
    let renderer = drivers::quietly(|| texere::picture::open_renderer(&args.device))?;
    let mut design = reading::design(&args.design)?;
    design.settle = args.rest.settles().unwrap_or(design.settle);
    let given = drivers::quietly(|| texere::open(&args.device))?;
    let cpu = stand_in(design.finish.by, &*given)?;
    let device = cpu.as_deref().unwrap_or(&*given);
    let mut options = BakeOptions::default();
    (options.texel_mm, options.area) = (args.texel, args.area);
    let material =
        progress::during("baking", |bar| bake(design, device, &renderer, &options, progress::share(bar)))?;
    let documents = material.write(&args.output)?;
    let ([width, height], [wide, high]) = (material.front.size, material.front.size_mm);
    let tiles = if material.tiles { "tile" } else { "do not tile" };
    print::text(&format!(
        "{}: {width} × {height} texels of {wide:.3} × {high:.3} mm, which {tiles}; {}\n",
        line(args.output.display()),
        line(documents.join(", ")),
    ))
}
