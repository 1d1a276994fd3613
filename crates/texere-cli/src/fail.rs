//! How a command fails: what is said, and the exit code.

use std::error::Error;
use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use texere::{BackendError, FabricError, PipelineError, PlanError, ReadError, RenderError, WriteError};

/// A command that failed.
#[derive(Debug)]
pub(crate) struct Fail {
    code: u8,
    source: Box<dyn Error>,
}

/// A device, a file or memory failed.
const WORLD: u8 = 1;

/// The command line is wrong; clap uses the same code.
const USAGE: u8 = 2;

/// The design is wrong.
const DESIGN: u8 = 3;

/// The cloth pierces itself, folds or jams.
const CLOTH: u8 = 4;

impl Fail {
    pub(crate) fn output(source: std::io::Error) -> Self {
        Self { code: WORLD, source: source.into() }
    }

    /// A draft, or a check of a cloth, was asked of a design that is none.
    pub(crate) fn not_woven(design: &Path) -> Self {
        Self { code: DESIGN, source: format!("{} is not woven cloth", design.display()).into() }
    }

    /// What `check` has found wrong with the cloth.
    pub(crate) fn cloth(design: &Path, faults: &str) -> Self {
        Self { code: CLOTH, source: format!("{} {faults}", design.display()).into() }
    }

    /// A picture shows one design.
    pub(crate) fn too_many_designs(designs: usize) -> Self {
        Self { code: USAGE, source: format!("a picture shows one design, not {designs}").into() }
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(self.code)
    }
}

impl fmt::Display for Fail {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "texere: {}", self.source)?;
        let mut cause = self.source.source();
        while let Some(error) = cause {
            write!(f, "\n  because {error}")?;
            cause = error.source();
        }
        Ok(())
    }
}

impl From<ReadError> for Fail {
    fn from(error: ReadError) -> Self {
        let code = if matches!(error, ReadError::Io { .. }) { WORLD } else { DESIGN };
        Self { code, source: error.into() }
    }
}

impl From<FabricError> for Fail {
    fn from(error: FabricError) -> Self {
        Self { code: DESIGN, source: error.into() }
    }
}

impl From<PlanError> for Fail {
    fn from(error: PlanError) -> Self {
        Self { code: USAGE, source: error.into() }
    }
}

impl From<BackendError> for Fail {
    fn from(error: BackendError) -> Self {
        let code = if matches!(error, BackendError::NoDevice { .. }) { USAGE } else { WORLD };
        Self { code, source: error.into() }
    }
}

impl From<WriteError> for Fail {
    fn from(error: WriteError) -> Self {
        let code = match &error {
            WriteError::Pipeline(PipelineError::Plan(_)) => USAGE,
            _ => WORLD,
        };
        Self { code, source: error.into() }
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
