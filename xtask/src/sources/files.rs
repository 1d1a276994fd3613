//! The repository's source files.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use crate::steps::root;

/// A file of Rust, OpenCL C or WGSL.
#[derive(Debug)]
pub(crate) struct Source {
    /// The file's path from the repository's root.
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

impl Source {
    pub(crate) fn is_rust(&self) -> bool {
        self.path.extension() == Some(OsStr::new("rs"))
    }

    /// Whether the whole file is a test.
    pub(crate) fn is_test(&self) -> bool {
        is_test(&self.path)
    }
}

/// Whether a path from the repository's root lies in a folder `tests`, or is a file `tests.rs`.
pub(crate) fn is_test(path: &Path) -> bool {
    path.with_extension("").iter().any(|name| name == "tests")
}

/// The path from the repository's root.
pub(crate) fn shown(path: &Path) -> &Path {
    path.strip_prefix(root()).unwrap_or(path)
}

/// Reads all source files, in the order of their paths.
///
/// **Errors**: a sentence that names the file or the folder that can't be read.
pub(crate) fn all() -> Result<Vec<Source>, String> {
    let mut sources = Vec::new();
    let mut folders = vec![root().to_owned()];
    while let Some(folder) = folders.pop() {
        let named = |error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(&folder).map_err(named)? {
            let entry = entry.map_err(named)?;
            let (path, name) = (entry.path(), entry.file_name());
            let name = name.to_string_lossy();
            if entry.file_type().map_err(named)?.is_dir() {
                // Hidden folders belong to tools. `target` and `out` hold builds and pictures.
                let apart = name.starts_with('.') || ["target", "out"].contains(&&*name);
                folders.extend((!apart).then_some(path));
            } else if ["rs", "cl", "wgsl"].iter().any(|kind| path.extension() == Some(OsStr::new(kind))) {
                let text = fs::read_to_string(&path).map_err(|error| format!("{name}: {error}"))?;
                sources.push(Source { path: shown(&path).to_owned(), text });
            }
        }
    }
    sources.sort_by(|one, other| one.path.cmp(&other.path));
    Ok(sources)
}
