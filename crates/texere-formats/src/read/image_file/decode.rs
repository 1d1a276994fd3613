//! Decodes an image file to an image in memory.

use std::io::{BufReader, Cursor};
use std::path::Path;

use ::image::{ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use texere_core::backend::{filled, room};

use super::bytes::Bytes;
use super::image::{Image, Orientation};
use super::limits::{ASIDE_MAX, FILE_MAX, MEMORY_MAX, check_size};
use super::refused::undecodable;
use super::{bmp, png, tiff};
use crate::read::ReadError;
use crate::read::file::{Files, Opened};

/// Decodes the image file in `path`, which `files` opens.
pub(crate) fn decode(path: &Path, files: &Files<'_>) -> Result<Image, ReadError> {
    let io = |source| ReadError::Io { file: path.into(), source };
    let failed = |error: ImageError| undecodable(path, &error.to_string());
    let (mut file, file_bytes): (Box<dyn Bytes>, u64) = match files(path, FILE_MAX)? {
        Opened::File(file) => {
            let count = file.metadata().map_err(io)?.len();
            (Box::new(BufReader::new(file)), count)
        }
        Opened::Bytes(bytes) => {
            let count = bytes.len() as u64;
            (Box::new(Cursor::new(bytes)), count)
        }
    };
    let is_bigtiff = tiff::is_big(file.fill_buf().map_err(io)?);
    let mut reader = ImageReader::new(file).with_guessed_format().map_err(io)?;
    let format = if is_bigtiff { Some(ImageFormat::Tiff) } else { reader.format() };
    if let Some(format) = format {
        let mut file = reader.into_inner();
        match format {
            ImageFormat::Bmp => bmp::check(path, &mut file)?,
            ImageFormat::Png => png::check(path, &mut file, file_bytes)?,
            ImageFormat::Tiff => {
                if let Some(header) = tiff::header(path, &mut file)? {
                    return tiff::decode(path, file, &header);
                }
            }
            _ => {}
        }
        file.rewind().map_err(io)?;
        reader = ImageReader::with_format(file, format);
    }
    // This limit is for what stands before the pixels. A PNG's text and colour profile have no
    // limit of their own.
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
    // Decoders need up to as much memory again, and abort if there is none. `room` fails with an
    // error instead.
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
