//! How a command fails: its message and its exit code.

use std::error::Error;
use std::fmt;
use std::iter::successors;
use std::path::Path;
use std::process::ExitCode;

use texere::check::ContactError;
use texere::mesh::PlanError;
use texere::picture::RenderError;
use texere::picture::bake::BakeError;
use texere::read::Refusal;
use texere::rest::{CrossingsError, FinishError, SettlingError};
use texere::yarn::YarnError;
use texere::{BackendError, FabricError, PipelineError, ReadError, WriteError};

use crate::terminal::line;

/// A command that failed.
#[derive(Debug)]
pub(crate) struct Fail {
    code: u8,
    source: Box<dyn Error>,
}

/// Exit code: a device, a file or memory failed.
pub(crate) const WORLD: u8 = 1;

/// Exit code: the command line or the variable `TEXERE_SIMD` is wrong. clap exits with this code
/// too.
pub(crate) const USAGE: u8 = 2;

/// Exit code: the design is wrong.
const DESIGN: u8 = 3;

/// Exit code: `check` found faults.
const CLOTH: u8 = 4;

impl Fail {
    pub(crate) fn output(source: std::io::Error) -> Self {
        Self { code: WORLD, source: source.into() }
    }

    /// Memory for `what` could not be had.
    pub(crate) fn out_of_memory(what: &str, bytes: usize) -> Self {
        Self { code: WORLD, source: format!("out of memory: {bytes} bytes for {what}").into() }
    }

    /// A draft was asked for, but the design has none.
    pub(crate) fn no_draft(design: &Path) -> Self {
        Self { code: DESIGN, source: format!("{} has no draft or chart", design.display()).into() }
    }

    /// The faults that `check` has found.
    pub(crate) fn cloth(design: &Path, faults: &str) -> Self {
        Self { code: CLOTH, source: format!("{} {faults}", design.display()).into() }
    }

    /// A plot of settling was asked for, but nothing settles.
    pub(crate) fn nothing_settles() -> Self {
        Self {
            code: USAGE,
            source: "--settling-plot needs --settle, for the design does not say that its yarns settle"
                .into(),
        }
    }

    /// A plot of settling was asked for, but the yarns do not settle by contact. Only settling
    /// by contact records the passes that a plot shows.
    pub(crate) fn no_course() -> Self {
        Self {
            code: USAGE,
            source:
                "--settling-plot is for knits that come to rest by contact: other cloth has no passes to plot"
                    .into(),
        }
    }

    /// An `option` of curves was given for another kind of file.
    pub(crate) fn needs_curves(option: &str, path: &Path) -> Self {
        let path = path.display();
        Self {
            code: USAGE,
            source: format!("{option} is for files of curves, such as .bcc, .obj, .usda and .tg3: {path} is another kind of file")
                .into(),
        }
    }

    /// The diameter of the curves in `path` was not given.
    pub(crate) fn needs_diameter(path: &Path) -> Self {
        let path = path.display();
        Self {
            code: USAGE,
            source: format!("{path} holds curves, which have no thickness: give it with --diameter MM")
                .into(),
        }
    }

    /// An `option` of meshes was given, but `path` takes yarns without a mesh.
    pub(crate) fn needs_mesh(option: &str, path: &Path) -> Self {
        let path = path.display();
        Self { code: USAGE, source: format!("{option} needs a mesh: {path} takes yarns without one").into() }
    }

    /// Two pictures of a turntable would be written to one file, because one path is a link to the
    /// other.
    pub(crate) fn written_twice(path: &Path) -> Self {
        Self {
            code: USAGE,
            source: format!("{} and another of the pictures are one file", path.display()).into(),
        }
    }

    /// The point of `--at` lies outside the cloth, which reaches from `low` to `high` (x, y), mm.
    pub(crate) fn off_the_cloth([x, y]: [f32; 2], low: [f32; 2], high: [f32; 2]) -> Self {
        let source = format!(
            "--at {x},{y} is off the cloth, which reaches from {:.3},{:.3} to {:.3},{:.3}",
            low[0], low[1], high[0], high[1]
        );
        Self { code: USAGE, source: source.into() }
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(self.code)
    }
}

impl fmt::Display for Fail {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "texere: {}", line(&self.source))?;
        let mut cause = self.source.source();
        while let Some(error) = cause {
            write!(f, "\n  because {}", line(error))?;
            cause = error.source();
        }
        Ok(())
    }
}

/// The exit code of an error. The innermost cause decides: memory that ran out while a design was
/// read is no fault of the design.
fn code_of(error: &(dyn Error + 'static)) -> u8 {
    let causes = successors(Some(error), |error: &&(dyn Error + 'static)| (*error).source());
    causes.filter_map(own_code).last().unwrap_or(WORLD)
}

/// The exit code that an error has by itself, whatever its causes are. None if errors of its kind
/// decide no code.
fn own_code(error: &(dyn Error + 'static)) -> Option<u8> {
    // The error of a file that the design names is boxed.
    let named = || error.downcast_ref::<Box<ReadError>>().map(|error| &**error);
    let read = error.downcast_ref().or_else(named).map(|error| match error {
        ReadError::Io { .. } | ReadError::NotAFile { .. } | ReadError::OutOfMemory(_) => WORLD,
        _ => DESIGN,
    });
    let fabric = error.downcast_ref().map(|error| match error {
        FabricError::OutOfMemory(_) => WORLD,
        _ => DESIGN,
    });
    let finish = error.downcast_ref().map(|error| match error {
        FinishError::Settling(SettlingError::OutOfMemory(_))
        | FinishError::Crossings(CrossingsError::OutOfMemory(_)) => WORLD,
        _ => DESIGN,
    });
    // The tension of splines is set on the command line.
    let tension = matches!(error.downcast_ref(), Some(YarnError::Tension { .. })).then_some(USAGE);
    let plan = error.downcast_ref().map(|_: &PlanError| USAGE);
    let backend = error.downcast_ref().map(|error| match error {
        // If there are other devices, the name is wrong; if there are none, the machine lacks them.
        BackendError::NoDevice { found, .. } if !found.is_empty() => USAGE,
        BackendError::NoInstructionSet { .. } | BackendError::NoFeature { .. } => USAGE,
        BackendError::Crowded { .. } => DESIGN,
        _ => WORLD,
    });
    let write = error.downcast_ref().map(|error| match error {
        WriteError::UnknownFormat { .. }
        | WriteError::NotPng { .. }
        | WriteError::NotEnding { .. }
        | WriteError::Unheld { .. }
        | WriteError::TextTooLarge { .. }
        | WriteError::Spared { .. }
        | WriteError::GlbTooLarge { .. }
        | WriteError::TooLongToPack { .. }
        | WriteError::TooManyVertices { .. }
        | WriteError::TooManyFacets { .. } => USAGE,
        WriteError::DraftTooLarge { .. }
        | WriteError::ChartTooLarge { .. }
        | WriteError::LappingTooLarge { .. }
        | WriteError::OutOfRange { .. } => DESIGN,
        _ => WORLD,
    });
    // A pipeline's error is shown as the error that it holds, so it has the exit code of that
    // error.
    let pipeline = error.downcast_ref().and_then(|error| match error {
        PipelineError::Plan(error) => own_code(error),
        PipelineError::Backend(error) => own_code(error),
        _ => None,
    });
    read.or(fabric).or(finish).or(tension).or(plan).or(backend).or(pipeline).or(write)
}

impl From<ReadError> for Fail {
    fn from(error: ReadError) -> Self {
        Self { code: code_of(&error), source: error.into() }
    }
}

impl From<FabricError> for Fail {
    fn from(error: FabricError) -> Self {
        Self { code: code_of(&error), source: error.into() }
    }
}

impl From<YarnError> for Fail {
    fn from(error: YarnError) -> Self {
        Self { code: code_of(&error), source: error.into() }
    }
}

impl From<PlanError> for Fail {
    fn from(error: PlanError) -> Self {
        Self { code: code_of(&error), source: error.into() }
    }
}

impl From<BackendError> for Fail {
    fn from(error: BackendError) -> Self {
        Self { code: code_of(&error), source: error.into() }
    }
}

impl From<WriteError> for Fail {
    fn from(error: WriteError) -> Self {
        Self { code: code_of(&error), source: error.into() }
    }
}

impl From<Refusal> for Fail {
    fn from(error: Refusal) -> Self {
        match error {
            // The tension of splines and the settings of meshes are set on the command line.
            Refusal::Other(FinishError::Fabric(FabricError::Yarns(error @ YarnError::Tension { .. }))) => {
                error.into()
            }
            Refusal::Other(FinishError::Fabric(FabricError::Contact(ContactError::Settings(error)))) => {
                error.into()
            }
            Refusal::Other(FinishError::Fabric(error)) => error.into(),
            Refusal::Other(FinishError::Backend(error)) => error.into(),
            Refusal::Other(error) => Self { code: code_of(&error), source: error.into() },
            _ => Self { code: DESIGN, source: error.into() },
        }
    }
}

impl From<RenderError> for Fail {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Backend(error) => error.into(),
            RenderError::Plan(error) => error.into(),
            _ => Self { code: USAGE, source: error.into() },
        }
    }
}

impl From<BakeError> for Fail {
    fn from(error: BakeError) -> Self {
        match error {
            BakeError::Design(error) => error.into(),
            BakeError::Render(error) => error.into(),
            BakeError::Write(error) => error.into(),
            BakeError::Area { .. }
            | BakeError::Texel { .. }
            | BakeError::TooLarge { .. }
            | BakeError::Empty => Self { code: USAGE, source: error.into() },
            _ => Self { code: WORLD, source: error.into() },
        }
    }
}

#[cfg(feature = "view")]
impl From<texere_view::ViewError> for Fail {
    fn from(error: texere_view::ViewError) -> Self {
        use texere_view::ViewError;
        match error {
            ViewError::Read(error) => error.into(),
            ViewError::Refused(error) => (*error).into(),
            ViewError::Backend(error) => error.into(),
            _ => Self { code: WORLD, source: error.into() },
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;

    use texere::backend::OutOfMemory;
    use texere::read::FilePlace;

    use super::*;

    /// A wrong value in a design file is the design's fault. A failure of memory or of a device is
    /// not, and neither is a wrong setting on the command line.
    #[test]
    fn refusals_have_the_code_of_their_cause() {
        let place = || FilePlace { file: "a.k".into(), line: 3, field: "knit + f1 1".into() };
        let crowded = || FinishError::Backend(BackendError::Crowded { chords: 2, limit: 1 });
        let short = || FabricError::OutOfMemory(OutOfMemory { what: "control points", bytes: 1 << 40 });
        let other = |error: FinishError| Refusal::Other(error);
        let settings =
            FabricError::Contact(ContactError::Settings(PlanError::Sides { sides: 2, low: 3, high: 256 }));
        let tension = || FabricError::Yarns(YarnError::Tension { tension: 2.0 });
        let none = BackendError::NoDevice { wanted: "abacus".into(), found: vec!["cpu".into()] };
        let cases = [
            (Refusal::Key { place: place(), source: crowded() }, DESIGN),
            (Refusal::File { file: "a.k".into(), source: crowded() }, DESIGN),
            (other(crowded()), DESIGN),
            (other(short().into()), WORLD),
            (
                other(FinishError::Settling(SettlingError::OutOfMemory(OutOfMemory {
                    what: "chords",
                    bytes: 1 << 40,
                }))),
                WORLD,
            ),
            (
                other(FinishError::Crossings(CrossingsError::OutOfMemory(OutOfMemory {
                    what: "chords",
                    bytes: 1 << 40,
                }))),
                WORLD,
            ),
            (other(settings.into()), USAGE),
            (other(tension().into()), USAGE),
            (other(none.into()), USAGE),
            (other(FinishError::Woven { asked: "a course" }), DESIGN),
        ];
        for (refusal, code) in cases {
            let said = refusal.to_string();
            assert_eq!(Fail::from(refusal).code, code, "{said}");
        }
        #[cfg(feature = "view")]
        {
            use texere_view::ViewError;
            let fail = Fail::from(ViewError::from(Refusal::Key { place: place(), source: crowded() }));
            assert_eq!(fail.code, DESIGN);
            assert!(fail.to_string().contains("a.k, line 3: knit + f1 1"), "{fail}");
            assert_eq!(Fail::from(ViewError::from(other(short().into()))).code, WORLD);
            assert_eq!(
                Fail::from(ViewError::Read(ReadError::Io {
                    file: "a.k".into(),
                    source: ErrorKind::NotFound.into()
                }))
                .code,
                WORLD
            );
            assert_eq!(Fail::from(ViewError::Window("no display".into())).code, WORLD);
        }
    }

    #[test]
    fn memory_devices_and_files_are_no_fault_of_the_design_or_the_command_line() {
        let short = || FabricError::OutOfMemory(OutOfMemory { what: "control points", bytes: 1 << 40 });
        let denied = || ErrorKind::PermissionDenied.into();
        let image = || ReadError::Io { file: "motif.png".into(), source: denied() };
        let place = FilePlace { file: "cloth.toml".into(), line: 3, field: "weave.image".into() };
        let world: [Fail; 10] = [
            short().into(),
            ReadError::OutOfMemory(OutOfMemory { what: "crossings", bytes: 1 << 40 }).into(),
            ReadError::Named { place, source: image().into() }.into(),
            ReadError::Fabric { file: "cloth.toml".into(), source: short() }.into(),
            ReadError::Io { file: "cloth.toml".into(), source: denied() }.into(),
            BackendError::OutOfMemory(OutOfMemory { what: "vertices", bytes: 1 << 40 }).into(),
            BackendError::NoDevice { wanted: "wgpu".into(), found: vec![] }.into(),
            RenderError::Backend(BackendError::OutOfMemory(OutOfMemory { what: "screen", bytes: 1 << 40 }))
                .into(),
            WriteError::Io { action: "write", path: "cloth.ply".into(), source: denied() }.into(),
            WriteError::Pipeline(PipelineError::Backend(BackendError::OutOfMemory(OutOfMemory {
                what: "rings",
                bytes: 1,
            })))
            .into(),
        ];
        assert_eq!(world.each_ref().map(|fail| fail.code), [WORLD; 10]);
        let sides = || PlanError::Sides { sides: 2, low: 3, high: 256 };
        let design: [Fail; 3] = [
            FabricError::Contact(ContactError::Settings(sides())).into(),
            ReadError::Fabric {
                file: "a.wif".into(),
                source: FabricError::Contact(ContactError::Settings(sides())),
            }
            .into(),
            WriteError::DraftTooLarge { ends: 1, picks: 1, width: 1, height: 1, limit: 0 }.into(),
        ];
        assert_eq!(design.each_ref().map(|fail| fail.code), [DESIGN; 3]);
        let usage: [Fail; 8] = [
            YarnError::Tension { tension: 2.0 }.into(),
            sides().into(),
            RenderError::Plan(sides()).into(),
            WriteError::Pipeline(PipelineError::Plan(sides())).into(),
            WriteError::GlbTooLarge { bytes: 2, limit: 1 }.into(),
            WriteError::NotPng { path: "x.jpg".into() }.into(),
            WriteError::Spared { path: "x.png".into(), spared: "x.png".into() }.into(),
            BackendError::NoDevice { wanted: "abacus".into(), found: vec!["cpu".into()] }.into(),
        ];
        assert_eq!(usage.each_ref().map(|fail| fail.code), [USAGE; 8]);
    }
}
