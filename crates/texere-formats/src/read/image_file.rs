//! Image files: PNG, BMP and TIFF.

use std::io::{BufRead, BufReader, Cursor, Seek};
use std::path::Path;

use image::{ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use texere_core::backend::{filled, room};
use texere_core::counted;
use texere_fabric::THREADS_MAX;

use super::error::said;
use super::file::{Files, Opened};
use super::point_paper::{Image, Orientation};
use super::{ReadError, bmp_file, png_file, tiff_file};

/// The most pixels of an image: 16,384 hooks by as many picks, beyond any Jacquard loom.
const PIXELS_MAX: u64 = 1 << 28;

/// The most memory for an image's pixels, bytes: four for each.
const MEMORY_MAX: u64 = 4 * PIXELS_MAX;

/// The most memory for what a decoder needs beside the pixels, bytes: a line or a tile of them, and
/// what the file says of its picture. A colour profile has no more than a few MiB; compressed, one
/// of a gigabyte fits a small file.
pub(super) const ASIDE_MAX: u64 = 1 << 25;

/// The largest image file that is read: one that is not compressed.
const FILE_LIMIT: u64 = MEMORY_MAX + ASIDE_MAX;

/// What an image is decoded from.
pub(super) trait Bytes: BufRead + Seek {}

impl<T: BufRead + Seek> Bytes for T {}

pub(super) fn decode(path: &Path, files: &Files<'_>) -> Result<Image, ReadError> {
    let io = |source| ReadError::Io { file: path.into(), source };
    let failed = |error: ImageError| undecodable(path, &error.to_string());
    let (mut file, file_bytes): (Box<dyn Bytes>, u64) = match files(path, FILE_LIMIT)? {
        Opened::File(file) => {
            let count = file.metadata().map_err(io)?.len();
            (Box::new(BufReader::new(file)), count)
        }
        Opened::Bytes(bytes) => {
            let count = bytes.len() as u64;
            (Box::new(Cursor::new(bytes)), count)
        }
    };
    let is_bigtiff = tiff_file::is_big(file.fill_buf().map_err(io)?);
    let mut reader = ImageReader::new(file).with_guessed_format().map_err(io)?;
    let format = if is_bigtiff { Some(ImageFormat::Tiff) } else { reader.format() };
    if let Some(format) = format {
        let mut file = reader.into_inner();
        match format {
            ImageFormat::Bmp => bmp_file::check(path, &mut file)?,
            ImageFormat::Png => png_file::check(path, &mut file, file_bytes)?,
            ImageFormat::Tiff => {
                if let Some(header) = tiff_file::header(path, &mut file)? {
                    return tiff_file::decode(path, file, &header);
                }
            }
            _ => {}
        }
        file.rewind().map_err(io)?;
        reader = ImageReader::with_format(file, format);
    }
    // These are for what stands before the pixels; a PNG's text and colour profile are not asked
    // for their own.
    let mut limits = Limits::default();
    limits.max_alloc = Some(ASIDE_MAX);
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    check_size(path, width, height)?;
    let orientation = Orientation(decoder.orientation().map_err(failed)?.to_exif().into());
    let (channels, size) = (decoder.color_type().channel_count(), decoder.total_bytes());
    limits.max_alloc = Some(MEMORY_MAX);
    limits.reserve(size).map_err(failed)?;
    limits.max_alloc = Some(2 * size + ASIDE_MAX);
    decoder.set_limits(limits).map_err(failed)?;

    let mut bytes = filled("an image", size as usize, 0)?;
    // Decoders take up to as much again and do not ask whether it is there.
    drop(room::<u8>("decoding an image", (size + ASIDE_MAX) as usize)?);
    decoder.read_image(&mut bytes).map_err(failed)?;
    Ok(Image {
        width: width as usize,
        height: height as usize,
        channels: channels.into(),
        bytes,
        orientation,
    })
}

/// The refusal of an image. Decoders say much, and what a file says, too.
pub(super) fn undecodable(path: &Path, why: &str) -> ReadError {
    ReadError::Image { file: path.into(), source: said(why).into() }
}

/// Why an image is refused where a pixel has a number that its palette of `colors` has no colour
/// for.
pub(super) fn no_color(number: usize, colors: usize) -> String {
    format!("a pixel has number {number} of a palette of {}", counted(colors as u64, "colour"))
}

/// The first `count` numbers of so many bits, 1, 2, 4 or 8, that a row's bytes hold, the first in
/// the highest bits. What is left of the last byte is no pixel.
pub(super) fn packed_numbers(row: &[u8], bits: usize, count: usize) -> impl Iterator<Item = usize> {
    let digits = move |byte: u8| (0..8 / bits).rev().map(move |place| usize::from(byte) >> (place * bits));
    row.iter().flat_map(move |byte| digits(*byte)).map(move |number| number & ((1 << bits) - 1)).take(count)
}

/// Refuses an image that no cloth may be as large as.
pub(super) fn check_size(path: &Path, width: u32, height: u32) -> Result<(), ReadError> {
    let side_limit = THREADS_MAX as u32;
    if width.max(height) > side_limit || u64::from(width) * u64::from(height) > PIXELS_MAX {
        let file = path.into();
        return Err(ReadError::ImageTooLarge { file, width, height, side_limit, limit: PIXELS_MAX });
    }
    Ok(())
}
