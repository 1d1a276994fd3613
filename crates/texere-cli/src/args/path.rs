//! Paths with their required endings.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::builder::{PathBufValueParser, TypedValueParser};
use texere::write::{CurveFormat, Format};

/// Whether a path names a file of saved yarns.
pub(crate) fn is_yarns(path: &Path) -> bool {
    ends_in(path, &["yarns"])
}

/// Whether a path names a file of curves that texere can write.
pub(crate) fn is_curves(path: &Path) -> bool {
    CurveFormat::from_path(path).is_ok()
}

/// Whether texere reads a path as curves of another program.
pub(crate) fn is_read_as_curves(path: &Path) -> bool {
    ends_in(path, &["bcc", "obj"]) || says_thickness(path)
}

/// Whether a path names a file of USD or TexGen, whose curves have a thickness of their own.
pub(crate) fn says_thickness(path: &Path) -> bool {
    ends_in(path, &["tg3", "usd", "usda", "usdc", "usdz"])
}

fn ends_in(path: &Path, endings: &[&str]) -> bool {
    path.extension().is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// The parser of a path whose ending must be that of a mesh, of curves or of saved yarns.
pub(super) fn mesh_file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match Format::from_path(&path) {
        Err(error) if !is_yarns(&path) && !is_curves(&path) => {
            let curves = CurveFormat::ALL.map(CurveFormat::extension).join(", ");
            Err(format!("{error}; and without a mesh: {curves}, yarns"))
        }
        _ => Ok(path),
    })
}

/// The parser of a path that must have one of `endings`, in upper or lower case.
pub(super) fn file_of(endings: &'static [&'static str]) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        let is_one = |given: &OsStr| endings.iter().any(|ending| given.eq_ignore_ascii_case(ending));
        if path.extension().is_some_and(is_one) {
            Ok(path)
        } else {
            Err(format!("{} does not end in .{}", path.display(), endings.join(" or .")))
        }
    })
}
