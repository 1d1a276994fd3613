//! Looks in a BMP image for pixels whose number the palette has no colour for. The decoder would
//! show them black.

use std::io::{self, Read, SeekFrom};
use std::path::Path;

use super::bytes::{Bytes, packed_numbers};
use super::limits::check_size;
use super::refused::{no_color, undecodable};
use crate::read::ReadError;

/// Values of biCompression (MS-WMF, Compression enumeration).
const PLAIN: u32 = 0;
const RUNS_OF_8_BITS: u32 = 1;
const RUNS_OF_4_BITS: u32 = 2;

/// The byte behind a zero in runs (MS-WMF, bitmap compression). 0 ends a row, 1 ends the picture, 2
/// leaves pixels out. A greater number is the length of a list of numbers.
const ROW_END: u8 = 0;
const END: u8 = 1;
const LEAVE_OUT: u8 = 2;

/// The header of a BMP whose pixels may have numbers beyond its palette.
struct Numbers {
    bits: usize,
    colors: usize,
    size: [u32; 2],
    compression: u32,
}

/// Refuses a BMP with a pixel whose number its palette has no colour for.
pub(super) fn check(path: &Path, file: &mut impl Bytes) -> Result<(), ReadError> {
    let found = match header(file) {
        Ok(Some(numbers)) => {
            check_size(path, numbers.size[0], numbers.size[1])?;
            let beyond =
                if numbers.compression == PLAIN { in_rows(file, &numbers) } else { in_runs(file, &numbers) };
            beyond.map(|beyond| beyond.map(|number| no_color(number, numbers.colors)))
        }
        Ok(None) => return Ok(()),
        Err(error) => Err(error),
    };
    match found {
        Ok(Some(why)) => Err(undecodable(path, &why)),
        Ok(None) => Ok(()),
        // The decoder will refuse a file that is cut short.
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(()),
        Err(source) => Err(ReadError::Io { file: path.into(), source }),
    }
}

/// Reads the headers, and goes to the first pixel. `None` if every number has a colour, or if the
/// decoder will refuse the file.
fn header(file: &mut impl Bytes) -> io::Result<Option<Numbers>> {
    let mut head = [0; 54];
    file.rewind()?;
    file.read_exact(&mut head)?;
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    let (header_bytes, bits, compression, colors) = (word(14), head[28].into(), word(30), word(46) as usize);
    let has_numbers = match compression {
        PLAIN => [1, 2, 4, 8].contains(&bits),
        RUNS_OF_8_BITS => bits == 8,
        RUNS_OF_4_BITS => bits == 4,
        _ => false,
    };
    // A core header, of 12 bytes, has no number of colours. A count of 0 stands for a full palette.
    if header_bytes < 40 || !has_numbers || colors == 0 || colors >= 1 << bits || word(18) > i32::MAX as u32 {
        return Ok(None);
    }
    file.seek(SeekFrom::Start(word(10).into()))?;
    // A height below zero means that rows come from the top down.
    let size = [word(18), (word(22) as i32).unsigned_abs()];
    Ok(Some(Numbers { bits, colors, size, compression }))
}

/// The first number beyond the palette in plain rows. Each row is padded to a multiple of four
/// bytes.
fn in_rows(file: &mut impl Read, numbers: &Numbers) -> io::Result<Option<usize>> {
    let &Numbers { bits, colors, size: [width, height], .. } = numbers;
    let width = width as usize;
    let mut row = vec![0; (bits * width).div_ceil(32) * 4];
    for _ in 0..height {
        file.read_exact(&mut row)?;
        if let Some(number) = packed_numbers(&row, bits, width).find(|number| *number >= colors) {
            return Ok(Some(number));
        }
    }
    Ok(None)
}

/// The first number beyond the palette in runs and lists.
fn in_runs(file: &mut impl Read, &Numbers { bits, colors, .. }: &Numbers) -> io::Result<Option<usize>> {
    let mut list = [0; 256];
    loop {
        let mut pair = [0; 2];
        file.read_exact(&mut pair)?;
        let (bytes, count) = match pair {
            [0, ROW_END] => continue,
            [0, END] => return Ok(None),
            [0, LEAVE_OUT] => {
                file.read_exact(&mut pair)?;
                continue;
            }
            [0, count] => {
                // A list is padded to a multiple of two bytes.
                let bytes = &mut list[..(usize::from(count) * bits).div_ceil(16) * 2];
                file.read_exact(bytes)?;
                (&*bytes, count.into())
            }
            // A run repeats the numbers in its byte in turn.
            [run, _] => (&pair[1..], usize::from(run).min(8 / bits)),
        };
        if let Some(number) = packed_numbers(bytes, bits, count).find(|number| *number >= colors) {
            return Ok(Some(number));
        }
    }
}
