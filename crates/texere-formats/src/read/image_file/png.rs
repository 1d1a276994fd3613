//! Looks in a PNG image for faults that the decoder overlooks. One of them is a pixel whose number
//! the palette has no colour for; the decoder would show it black.

use std::io::{self, SeekFrom};
use std::path::Path;

use ::png::{ColorType, Decoder, DecodingError, Limits};
use texere_core::backend::filled;

use super::bytes::{Bytes, packed_numbers};
use super::limits::{ASIDE_MAX, check_size};
use super::refused::{no_color, undecodable};
use crate::read::ReadError;

/// The most pixels that a byte of a PNG stands for. DEFLATE makes at most 1,032 bytes of one byte,
/// and a byte has eight pixels of one bit. With this limit, no memory is reserved for pixels that a
/// short file can't have.
const PIXELS_PER_BYTE: u64 = 8 * 1032;

/// Refuses a PNG of `file_bytes` bytes that has a broken palette, fewer bytes than its pixels take,
/// or pixels beyond its palette.
///
/// **Source**: PNG 1.2, 4.1.2. A number that the palette has no colour for is an error.
pub(super) fn check(path: &Path, file: &mut impl Bytes, file_bytes: u64) -> Result<(), ReadError> {
    let io = |source| ReadError::Io { file: path.into(), source };
    let failed = |error: DecodingError| undecodable(path, &error.to_string());
    if let Some(bytes) = broken_palette(file).map_err(io)? {
        let why = format!("it has a palette of {bytes} bytes, not three for each of 1 to 256 colours");
        return Err(undecodable(path, &why));
    }
    file.rewind().map_err(io)?;
    let mut decoder = Decoder::new_with_limits(file, Limits { bytes: ASIDE_MAX as usize });
    // The decoder that reads the pixels checks these chunks.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(failed)?;
    let info = reader.info();
    let (width, height) = info.size();
    check_size(path, width, height)?;
    if u64::from(width) * u64::from(height) > PIXELS_PER_BYTE * file_bytes {
        let why = format!("its {file_bytes} bytes are too few for {width} × {height} pixels");
        return Err(undecodable(path, &why));
    }
    let bits = info.bit_depth as usize;
    let colors = info.palette.as_ref().map_or(0, |palette| palette.len() / 3);
    if info.color_type != ColorType::Indexed || colors >= 1 << bits {
        return Ok(());
    }
    let mut numbers =
        filled("the numbers of an image", reader.output_buffer_size().unwrap_or(usize::MAX), 0)?;
    let frame = reader.next_frame(&mut numbers).map_err(failed)?;
    let rows = numbers.chunks_exact(frame.line_size);
    let mut numbers = rows.flat_map(|row| packed_numbers(row, bits, frame.width as usize));
    match numbers.find(|number| *number >= colors) {
        Some(number) => Err(undecodable(path, &no_color(number, colors))),
        None => Ok(()),
    }
}

/// The length of a PNG's palette if it is broken: no multiple of three bytes, or not 1 to 256
/// colours. None for a valid palette, or for a file without one. The decoder does not check
/// palettes.
fn broken_palette(file: &mut impl Bytes) -> io::Result<Option<u32>> {
    // After the signature come chunks. Each has its length, its name, its data and a checksum.
    file.seek(SeekFrom::Start(8))?;
    let mut head = [0; 8];
    loop {
        match file.read_exact(&mut head) {
            // The decoder will refuse a file that is cut short.
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
            other => other?,
        }
        let [a, b, c, d, name @ ..] = head;
        let length = u32::from_be_bytes([a, b, c, d]);
        match &name {
            b"IDAT" | b"IEND" => return Ok(None),
            b"PLTE" if !length.is_multiple_of(3) || !(3..=768).contains(&length) => return Ok(Some(length)),
            _ => file.seek_relative(i64::from(length) + 4)?,
        }
    }
}
