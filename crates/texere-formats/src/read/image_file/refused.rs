//! Refusals that decoders of all kinds of images share.

use std::path::Path;

use texere_core::counted;

use crate::read::ReadError;
use crate::read::error::said;

/// The refusal of an image that can't be decoded. The decoder's reason is cut if it is long,
/// because it may repeat text of the file.
pub(super) fn undecodable(path: &Path, why: &str) -> ReadError {
    ReadError::Image { file: path.into(), source: said(why).into() }
}

/// The reason for the refusal of a pixel whose `number` is beyond its palette of `colors`.
pub(super) fn no_color(number: usize, colors: usize) -> String {
    format!("a pixel has number {number} of a palette of {}", counted(colors as u64, "colour"))
}
