//! `texere mesh`

use std::io::IsTerminal;
use std::ops::Deref;
use std::path::Path;

use texere::check::{SettlingReport, counted};
use texere::write::{Format, Output};
use texere::{Backend, BackendError, Pipeline, Yarns};

use crate::args::{MeshArgs, Meshopt, is_curves, is_yarns, undersampled};
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print, progress, reading, settling};

pub(crate) fn run(args: &MeshArgs) -> Result<(), Fail> {
    let open = || drivers::quietly(|| texere::open(&args.device));
    if is_yarns(&args.output) || holds_curves(args) {
        let own = [
            ("--triangles", args.triangles),
            ("--packed", args.packed),
            ("--compressed", args.compressed.is_some()),
            ("--instanced", args.instanced),
            ("--attributes", !args.attributes.is_empty()),
        ];
        let own = own.into_iter().find_map(|(option, is_given)| is_given.then_some(option));
        if let Some(option) = args.settings.of_a_mesh().or(own) {
            return Err(Fail::needs_mesh(option, &args.output));
        }
        // Only settling needs a device here.
        return Cloth::new(args, open)?.print(|yarns, output| saved(args, &yarns, output));
    }
    let device = open()?;
    Cloth::new(args, || Ok(&*device))?.print(|yarns, output| meshed(args, yarns, &*device, output))
}

/// The yarns of a cloth, the warnings and the report about it, and the file that it goes to.
struct Cloth {
    yarns: Yarns,
    output: Output,
    warnings: Vec<String>,
    settling: Option<SettlingReport>,
}

impl Cloth {
    /// The cloth that `args` name: saved cloth, curves, or the cloth of a design.
    fn new<D: Deref<Target = dyn Backend>>(
        args: &MeshArgs,
        open: impl FnOnce() -> Result<D, BackendError>,
    ) -> Result<Self, Fail> {
        let design = reading::cloth(&args.design, args.curves, &args.settings)?;
        let output = output(args, design.files());
        output.check()?;
        let tension = args.settings.tension(design.structure.tension());
        let (cloth, settling) = settling::cloth(design, &args.settling, tension, open)?;
        let mut warnings = cloth.warnings();
        warnings.retain(|warning| !cloth.design().remarks().contains(warning));
        Ok(Self { yarns: cloth.into_parts().1, output, warnings, settling })
    }

    /// Writes the file with `write`. Prints the warnings, then the report of settling, and last the
    /// lines about the file, which `write` returns.
    fn print(self, write: impl FnOnce(Yarns, Output) -> Result<String, Fail>) -> Result<(), Fail> {
        let written = write(self.yarns, self.output)?;
        for warning in self.warnings {
            print::text(&format!("warning: {}\n", line(warning)))?;
        }
        if let Some(settling) = self.settling {
            print::text(&settling::said(&settling))?;
        }
        print::text(&written)
    }
}

/// Whether the file to write holds curves.
fn holds_curves(args: &MeshArgs) -> bool {
    is_curves(&args.output) && !(args.triangles && Format::from_path(&args.output).is_ok())
}

/// The file to write, which replaces none of `files`.
fn output(args: &MeshArgs, files: impl IntoIterator<Item = impl AsRef<Path>>) -> Output {
    let output = Output::to(&args.output).sparing(files).attributes(args.attributes.iter().copied());
    match args {
        MeshArgs { packed: true, .. } => output.packed(),
        MeshArgs { compressed: Some(Meshopt::Ext), .. } => output.compressed(),
        MeshArgs { compressed: Some(Meshopt::Khr), .. } => output.khr_compressed(),
        MeshArgs { instanced: true, .. } => output.instanced(),
        MeshArgs { linear: true, .. } => output.linear(),
        _ => output,
    }
}

/// Writes the yarns themselves, or their centrelines. Returns the line to print about the file.
fn saved(args: &MeshArgs, yarns: &Yarns, output: Output) -> Result<String, Fail> {
    let bytes = match holds_curves(args) {
        true => texere::write::curves(yarns, output)?,
        false => texere::write::yarns(yarns, output)?,
    };
    let (count, points) = (yarns.layout().yarns().len(), yarns.points().len());
    let (count, points) = (counted(count, "yarn"), counted(points, "control point"));
    Ok(format!("{}: {count}, {points}, {bytes} bytes\n", line(args.output.display())))
}

/// Writes the mesh of the yarns, which are freed on the way. Returns the lines to print about the
/// mesh and the file.
fn meshed(args: &MeshArgs, yarns: Yarns, device: &dyn Backend, output: Output) -> Result<String, Fail> {
    let settings = args.settings.of(&yarns);
    let warning = undersampled(&yarns, &settings).map(|warning| format!("warning: {}\n", line(warning)));
    let bar = progress::bar(std::io::stderr().is_terminal());
    let pipeline = Pipeline::new(yarns).settings(settings).progress(progress::reporter(&bar));
    let written = texere::write::stream(pipeline, device, output)?;
    bar.finish_and_clear();
    Ok(format!(
        "{}{}: {} triangles, {} vertices, {} bytes, made by {}\n",
        warning.unwrap_or_default(),
        line(args.output.display()),
        written.triangles,
        written.vertices,
        written.bytes,
        device.info().name
    ))
}
