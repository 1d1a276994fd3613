//! Text of drafts, as weaving programs really write it.

use std::borrow::Cow;

/// The text of a file. It is decoded as UTF-16 if it begins like UTF-16, else as UTF-8 if it is
/// valid UTF-8, else as Latin-1.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    // UTF-16 without a byte order mark is recognised by the zeros in its first two letters: a WIF
    // file begins with "[W", a file of Fiberworks with "@@".
    match *bytes {
        [0xff, 0xfe, ..] => return utf16(&bytes[2..], u16::from_le_bytes),
        [0xfe, 0xff, ..] => return utf16(&bytes[2..], u16::from_be_bytes),
        [1..=255, 0, 1..=255, 0, ..] => return utf16(bytes, u16::from_le_bytes),
        [0, 1..=255, 0, 1..=255, ..] => return utf16(bytes, u16::from_be_bytes),
        _ => {}
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// Decodes UTF-16. Invalid code units become the replacement character, and half a unit at the end
/// of a file is left out.
fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Cow<'_, str> {
    let units = bytes.as_chunks().0.iter().map(|&bytes| unit(bytes));
    char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

/// Lines that end in LF, CRLF or a lone CR.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'))
}
