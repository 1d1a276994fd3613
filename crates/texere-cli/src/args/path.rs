//! Paths, with the endings that they must have.

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use texere::Format;

/// A path with the ending of a mesh file.
pub(super) fn mesh_file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match Format::from_path(&path) {
        Ok(_) => Ok(path),
        Err(error) => Err(error.to_string()),
    })
}

/// A path with this `ending`, in upper or lower case.
pub(super) fn file_of(ending: &'static str) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        if path.extension().is_some_and(|given| given.eq_ignore_ascii_case(ending)) {
            Ok(path)
        } else {
            Err(format!("{} does not end in .{ending}", path.display()))
        }
    })
}
