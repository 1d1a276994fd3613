//! The limits of images.

use std::path::Path;

use texere_core::counted;
use texere_fabric::THREADS_MAX;

use super::refused::undecodable;
use crate::read::ReadError;

/// The most pixels of an image: 16,384 hooks by as many picks, beyond any Jacquard loom.
const PIXELS_MAX: u64 = 1 << 28;

/// The most memory for an image's pixels, bytes: four for each of [`PIXELS_MAX`] pixels.
pub(super) const MEMORY_MAX: u64 = 4 * PIXELS_MAX;

/// The most memory for what a decoder needs beside the pixels, bytes: a line or a tile of pixels,
/// and what the file says of its picture. Colour profiles have a few MiB at most. The limit is
/// needed because a profile is compressed: one of a gigabyte fits a small file.
pub(super) const ASIDE_MAX: u64 = 1 << 25;

/// The largest image file that is read, bytes. An image of [`PIXELS_MAX`] pixels of four bytes fits
/// uncompressed.
pub(super) const FILE_MAX: u64 = MEMORY_MAX + ASIDE_MAX;

/// Refuses pixels of `samples` samples each that take more than [`MEMORY_MAX`] bytes. An image may
/// say that it has thousands of samples a pixel.
pub(super) fn check_memory(path: &Path, samples: usize, bytes: u64) -> Result<(), ReadError> {
    if bytes <= MEMORY_MAX {
        return Ok(());
    }
    let samples = counted(samples as u64, "sample");
    Err(undecodable(path, &format!("its {samples} a pixel take {bytes} bytes, more than {MEMORY_MAX}")))
}

/// Refuses an image with more than [`PIXELS_MAX`] pixels, or with a side of more pixels than a warp
/// or weft may have threads.
pub(super) fn check_size(path: &Path, width: u32, height: u32) -> Result<(), ReadError> {
    let side_limit = THREADS_MAX as u32;
    if width.max(height) > side_limit || u64::from(width) * u64::from(height) > PIXELS_MAX {
        let file = path.into();
        return Err(ReadError::ImageTooLarge { file, width, height, side_limit, limit: PIXELS_MAX });
    }
    Ok(())
}
