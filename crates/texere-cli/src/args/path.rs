//! Paths, with the endings that they must have.

use std::ffi::OsStr;
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

/// A path with one of these `endings`, in upper or lower case.
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
