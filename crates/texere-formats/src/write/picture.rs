//! Writes pixels to a PNG file.

use std::io::{self, ErrorKind, Write};

use super::target::Target;
use super::{Output, WriteError};

/// Writes a picture of `size` pixels (width, height) to a PNG file. `pixels` has three bytes for
/// each pixel, red, green and blue in sRGB, or four, with alpha last. Rows come from the top.
///
/// **Errors**: [`WriteError::NotPng`] if `output` does not end in `.png`, [`WriteError::Spared`],
/// [`WriteError::Io`]. A wrong number of pixels and a lack of memory are [`WriteError::Io`] as
/// well.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("red.png");
/// texere_formats::write::picture([2, 1], &[255, 0, 0, 128, 0, 0], &path)?;
/// assert_eq!(std::fs::read(&path)?[..4], *b"\x89PNG");
/// assert!(texere_formats::write::picture([2, 2], &[0; 6], &path).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn picture(size: [u32; 2], pixels: &[u8], output: impl Into<Output>) -> Result<(), WriteError> {
    let mut target = Target::create(png(output.into())?)?;
    encode(size, pixels, &mut target)?;
    target.commit()?;
    Ok(())
}

/// Writes a picture to `out`: the bytes that [`picture`](fn@picture) writes to a file.
///
/// **Errors**: [`WriteError::Writer`] if `out` refuses bytes, for a wrong number of pixels, and for
/// a lack of memory.
///
/// ```
/// let mut png = Vec::new();
/// texere_formats::write::picture_to([2, 1], &[255, 0, 0, 128, 0, 0], &mut png)?;
/// assert!(png.starts_with(b"\x89PNG"));
/// assert_eq!(png[25], 2); // the kind of a PNG without alpha
///
/// let mut half_seen = Vec::new();
/// texere_formats::write::picture_to([1, 1], &[255, 0, 0, 128], &mut half_seen)?;
/// assert_eq!(half_seen[25], 6);
/// # Ok::<(), texere_formats::WriteError>(())
/// ```
pub fn picture_to(size: [u32; 2], pixels: &[u8], out: impl Write) -> Result<(), WriteError> {
    let mut target = Target::straight(out);
    encode(size, pixels, &mut target)?;
    target.done()?;
    Ok(())
}

fn encode<W: Write>(
    [width, height]: [u32; 2],
    pixels: &[u8],
    target: &mut Target<W>,
) -> Result<(), WriteError> {
    encoder_room().map_err(|source| target.failed(source))?;
    let mut encoder = png::Encoder::new(&mut *target, width, height);
    // Any other number of bytes is refused as a wrong number for pixels without alpha.
    let has_alpha = pixels.len() as u64 == 4 * u64::from(width) * u64::from(height);
    encoder.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    // Cloth is full of detail. Stronger compression takes longer and gains little.
    encoder.set_compression(png::Compression::Fast);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    written.map_err(|error| target.failed(refused(error)))
}

/// The writer's own error if the writer refused bytes, or else the encoder's error. The conversion
/// that the encoder's crate offers would keep only the text of the writer's error.
pub(super) fn refused(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => other.into(),
    }
}

/// Fails if there is too little memory for an encoder. The encoder itself would abort the program.
pub(super) fn encoder_room() -> io::Result<()> {
    // The encoder's buffers and tables take a third of this.
    let mut room = Vec::<u8>::new();
    room.try_reserve_exact(1 << 20).map_err(|_| ErrorKind::OutOfMemory)?;
    // Without this the compiler may leave out the unused allocation.
    std::hint::black_box(&room);
    Ok(())
}

/// Returns `output` if its path ends in `.png`.
///
/// **Errors**: [`WriteError::NotPng`].
pub(super) fn png(output: Output) -> Result<Output, WriteError> {
    if output.path().extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        Ok(output)
    } else {
        Err(WriteError::NotPng { path: output.path().to_owned() })
    }
}
