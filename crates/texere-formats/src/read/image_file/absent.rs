//! The refusal of image files by a build without images.

use std::path::Path;

use super::image::Image;
use crate::read::ReadError;
use crate::read::file::Files;

/// Refuses an image file by name.
pub(crate) fn decode(path: &Path, _: &Files<'_>) -> Result<Image, ReadError> {
    Err(ReadError::Feature { file: path.into(), what: "images", feature: "images" })
}
