//! Readers: from a design file to a [`Design`].

mod design;
#[cfg(feature = "toml")]
mod design_file;
mod error;
mod file;
#[cfg(all(feature = "images", feature = "toml"))]
mod image_file;
mod keys;
mod knit;
#[cfg(feature = "knitout")]
mod knitout;
mod memory;
#[cfg(feature = "toml")]
mod point_paper;
mod refusal;
mod threads;
#[cfg(all(feature = "images", feature = "toml"))]
mod tiff_file;
#[cfg(feature = "wif")]
mod wif;

#[cfg(all(feature = "toml", not(feature = "images")))]
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

pub use design::{Design, MachineFault, NamedPlace, Told};
pub use error::{Place, ReadError};
pub use refusal::Refusal;
pub use texere_fabric::Structure;

#[cfg(feature = "toml")]
pub(crate) use design_file::limits;
#[cfg(feature = "wif")]
pub(crate) use wif::{
    FILE_LIMIT as WIF_BYTES_MAX, LENGTH_MM as WIF_LENGTH_MM, LOOM_LIMIT, PROGRAM as WIF_PROGRAM,
    UNITS_MM as WIF_UNITS_MM,
};

/// Reads the design in `path`: a WIF draft (`.wif`, feature `wif`), a program of a knitting machine (knitout, `.k`, feature `knitout`),
/// or texere's own design file (`.toml`, feature `toml`).
///
/// **Errors**: [`ReadError`], which names file, line, field, value and limit as far as they apply; [`ReadError::Feature`] for a kind of
/// file that this build was made without.
pub fn read(path: impl AsRef<Path>) -> Result<Design, ReadError> {
    let path = path.as_ref();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        #[cfg(feature = "wif")]
        Some("wif") => wif::design(path),
        #[cfg(not(feature = "wif"))]
        Some("wif") => Err(ReadError::Feature { file: path.into(), what: "WIF drafts", feature: "wif" }),
        #[cfg(feature = "toml")]
        Some("toml") => design_file::read(path),
        #[cfg(not(feature = "toml"))]
        Some("toml") => Err(ReadError::Feature { file: path.into(), what: "design files", feature: "toml" }),
        #[cfg(feature = "knitout")]
        Some("k" | "knitout") => knitout::design(path),
        #[cfg(not(feature = "knitout"))]
        Some("k" | "knitout") => {
            Err(ReadError::Feature { file: path.into(), what: "knitout files", feature: "knitout" })
        }
        _ => Err(ReadError::UnknownKind { file: path.into(), known: ".wif, .toml, .k, .knitout" }),
    }
    .map(|design: Design| design.noting(path))
}
