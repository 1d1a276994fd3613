//! A design, read and checked.

use std::path::{self, Path, PathBuf};

use texere_core::Yarns;
use texere_fabric::{FabricError, Finish, Structure};

/// A design, read and checked.
///
/// ```no_run
/// let design = texere_formats::read("designs/herringbone.wif")?;
/// println!("{}: {} yarns", design.name, design.yarns()?.layout().yarns().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Design {
    /// Its title, or else the name of its file.
    pub name: String,
    /// What it describes.
    pub structure: Structure,
    /// Whether its yarns are to settle before they are used ([`Structure::settle`]). [`Design::yarns`] are as they are before.
    pub settle: bool,
    /// How they settle.
    pub finish: Finish,
    remarks: Vec<String>,
    files: Vec<PathBuf>,
}

impl Design {
    /// A design whose yarns settle as those of its structure do.
    pub(super) fn new(name: String, structure: Structure, remarks: Vec<String>) -> Self {
        let (settle, finish) = (structure.settles(), Finish::default());
        Self { name, structure, settle, finish, remarks, files: Vec::new() }
    }

    /// The same design with what it says about how its yarns settle.
    pub(super) fn finished(self, settle: Option<bool>, finish: Finish) -> Self {
        Self { settle: settle.unwrap_or(self.settle), finish, ..self }
    }

    /// Notes a file that it was read from.
    pub(super) fn noting(mut self, file: &Path) -> Self {
        // A program may change its folder. Where the present one is not known, the path stays as it is.
        self.files.push(path::absolute(file).unwrap_or_else(|_| file.into()));
        self
    }

    /// The files that it was read from: the design's own, and the image or WIF draft that it names.
    /// [`Output::sparing`](crate::write::Output::sparing) keeps a writer from replacing them.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// What the reader had to assume or leave out.
    #[must_use]
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// What a designer should know: the reader's [`remarks`](Design::remarks), and what the fabric lacks as its structure puts
    /// its yarns ([`Structure::warnings`]).
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let warnings = self.structure.warnings();
        self.remarks.iter().cloned().chain(warnings.iter().map(ToString::to_string)).collect()
    }

    /// The yarns of the fabric: [`Structure::yarns`].
    ///
    /// **Errors**: [`FabricError`] where the structure can't be made.
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        self.structure.yarns()
    }
}
