//! Files that are read: what they say, and how those that can't be read are refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod curves;
mod design_file;
mod design_finish;
mod design_yarns;
mod drafts;
mod from_memory;
mod images;
mod knit;
mod palettes;
mod plurals;
mod point_paper;
mod polylines;
mod refusals;
mod rest;
mod texgen;
mod usd;
mod warp_knit;
mod wif;

use std::error::Error;

use texere_formats::{Design, ReadError, read};

/// Reads a file of this name and these contents, alone in a folder.
fn read_file(name: &str, contents: impl AsRef<[u8]>) -> Result<Design, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, contents).unwrap();
    read(&path)
}

/// The message of an error and of all its causes.
fn chain(error: &dyn Error) -> String {
    let cause = error.source().map(|cause| format!(": {}", chain(cause)));
    format!("{error}{}", cause.unwrap_or_default())
}
