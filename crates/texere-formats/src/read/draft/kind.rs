//! The kinds of drafts.

use std::path::Path;

use texere_fabric::{Relief, Structure, WovenDesign};

use super::limits::FILE_MAX;
use super::loom_draft::LoomDraft;
use crate::read::file::{Files, bytes_of};
use crate::read::{Design, ReadError, dtx, wif, wpo};

/// A kind of draft, by the program that saves it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum DraftKind {
    /// WIF, of many programs.
    Wif,
    /// Fiberworks PCW.
    Dtx,
    /// WeavePoint.
    Wpo,
}

impl DraftKind {
    /// The endings of drafts, as errors list them.
    #[cfg(feature = "toml")]
    pub(crate) const ENDINGS: &str = ".dtx, .wpo, .wifw or .wif";

    /// The kind of the draft in `path` by its ending, or none if drafts do not end so.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_ascii_lowercase().to_str()? {
            // WeaveIt gives its WIF files the second ending.
            "wif" | "wifw" => Some(Self::Wif),
            "dtx" => Some(Self::Dtx),
            "wpo" => Some(Self::Wpo),
            _ => None,
        }
    }

    /// The design of a draft alone. A draft has no finish, so its yarns do not settle.
    pub(crate) fn design(self, path: &Path, files: &Files<'_>) -> Result<Design, ReadError> {
        let draft = self.read(path, files)?;
        let woven = WovenDesign::new(draft.woven, Some(draft.draft), Relief::Report);
        let woven = draft.keys.placed(woven.map_err(|source| ReadError::fabric(path, source)))?;
        Ok(Design::new(draft.name, Structure::Woven(woven), draft.warnings).left().keyed(draft.keys))
    }

    /// The draft in `path`.
    pub(crate) fn read(self, path: &Path, files: &Files<'_>) -> Result<LoomDraft, ReadError> {
        let bytes = bytes_of(files, path, FILE_MAX)?;
        match self {
            Self::Wif => wif::draft(path, &bytes),
            Self::Dtx => dtx::draft(path, &bytes),
            Self::Wpo => wpo::draft(path, &bytes),
        }
    }
}
