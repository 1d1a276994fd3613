//! Readers: from a design file to a [`Design`].

mod design;
mod design_file;
mod error;
mod file;
#[cfg(feature = "images")]
mod image_file;
mod knit;
mod knitout;
mod memory;
mod point_paper;
mod threads;
mod wif;

#[cfg(not(feature = "images"))]
mod image_file {
    //! A build without images refuses them by name.

    use std::path::Path;

    use super::ReadError;
    use super::point_paper::Image;

    pub(super) fn decode(path: &Path) -> Result<Image, ReadError> {
        Err(ReadError::Feature { file: path.into(), what: "images", feature: "images" })
    }
}

use std::path::Path;

use file::file_name;
use knitout::LoopLengths;
use texere_fabric::{Relief, WovenDesign};

pub use design::{Design, MachineFault, NamedPlace, Told};
pub use error::{Place, ReadError};
pub use texere_fabric::Structure;

pub(crate) use design_file::limits;
pub(crate) use wif::{
    FILE_LIMIT as WIF_BYTES_MAX, LENGTH_MM as WIF_LENGTH_MM, LOOM_LIMIT, PROGRAM as WIF_PROGRAM,
    UNITS_MM as WIF_UNITS_MM,
};

/// Reads the design in `path`: a WIF draft (`.wif`), a program of a knitting machine (knitout, `.k`), or texere's own design file
/// (`.toml`).
///
/// **Errors**: [`ReadError`], which names file, line, field, value and limit as far as they apply.
pub fn read(path: impl AsRef<Path>) -> Result<Design, ReadError> {
    let path = path.as_ref();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("wif") => {
            let wif = wif::read(path)?;
            let woven = WovenDesign::new(wif.woven, Some(wif.draft), Relief::Report);
            let woven = woven.map_err(|source| ReadError::fabric(path, source))?;
            // A draft says nothing of a finish.
            Ok(Design::new(wif.name, Structure::Woven(woven), wif.warnings).left())
        }
        Some("toml") => design_file::read(path),
        Some("k" | "knitout") => {
            let knitout = knitout::read(path, &LoopLengths::new())?;
            knit::from_knitout(path, file_name(path), knitout)
        }
        _ => Err(ReadError::UnknownKind { file: path.into(), known: ".wif, .toml, .k, .knitout" }),
    }
    .map(|design| design.noting(path))
}
