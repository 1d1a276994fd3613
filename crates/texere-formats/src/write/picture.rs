//! Pixels to a PNG file.

use std::io::{self, ErrorKind};

use super::target::Target;
use super::{Output, WriteError};

/// Writes a picture of `size` pixels (width, height) to a PNG file: `rgb` is three bytes a pixel, sRGB, rows from the
/// top.
///
/// **Errors**: [`WriteError::NotPng`] where `output` does not end in `.png`, [`WriteError::Spared`], [`WriteError::Io`],
/// also for pixels that are not as many as `size` says.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("red.png");
/// texere_formats::write::picture([2, 1], &[255, 0, 0, 128, 0, 0], &path)?;
/// assert_eq!(std::fs::read(&path)?[..4], *b"\x89PNG");
/// assert!(texere_formats::write::picture([2, 2], &[0; 6], &path).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn picture([width, height]: [u32; 2], rgb: &[u8], output: impl Into<Output>) -> Result<(), WriteError> {
    let mut target = Target::create(png(output.into())?)?;
    encoder_room().map_err(|source| target.failed(source))?;
    let mut encoder = png::Encoder::new(&mut target, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    // Cloth is full of detail: stronger compression takes longer and gains little.
    encoder.set_compression(png::Compression::Fast);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(rgb)?;
        writer.finish()
    });
    written.map_err(|error| target.failed(error.into()))?;
    target.commit()?;
    Ok(())
}

/// Fails where there is no memory for an encoder, which would end the program itself.
pub(super) fn encoder_room() -> io::Result<()> {
    // The encoder's buffers and tables take a third of this.
    let mut room = Vec::<u8>::new();
    room.try_reserve_exact(1 << 20).map_err(|_| ErrorKind::OutOfMemory)?;
    // Without this the compiler may leave out the unused allocation.
    std::hint::black_box(&room);
    Ok(())
}

/// Gives `output` back if it ends in `.png`.
///
/// **Errors**: [`WriteError::NotPng`].
pub(super) fn png(output: Output) -> Result<Output, WriteError> {
    if output.path().extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        Ok(output)
    } else {
        Err(WriteError::NotPng { path: output.path().to_owned() })
    }
}
