//! Reads a binary file from its first byte to its last. Missing bytes and values out of range are
//! refused with their place.

use std::fmt::Display;
use std::path::Path;

use texere_core::OutOfMemory;

use super::ReadError;
use super::error::{said, shown};

/// A binary file, and its bytes that are still to be read.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bytes<'a> {
    file: &'a Path,
    whole: &'a [u8],
    left: &'a [u8],
}

impl<'a> Bytes<'a> {
    pub(super) const fn new(file: &'a Path, bytes: &'a [u8]) -> Self {
        Self { file, whole: bytes, left: bytes }
    }

    /// The place of the next byte in the file, counted from 0.
    pub(super) const fn at(&self) -> u64 {
        (self.whole.len() - self.left.len()) as u64
    }

    /// The refusal of the `value` of a `field` at byte `at`.
    pub(super) fn refused(
        &self,
        at: u64,
        field: &'static str,
        value: impl Display,
        expected: impl Display,
    ) -> ReadError {
        ReadError::Bytes {
            file: self.file.into(),
            at,
            field,
            value: shown(&value.to_string()),
            expected: said(&expected.to_string()),
        }
    }

    /// The next `N` bytes.
    pub(super) fn take<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], ReadError> {
        let Some((bytes, left)) = self.left.split_first_chunk() else {
            return Err(self.cut_short(field, N));
        };
        self.left = left;
        Ok(*bytes)
    }

    /// The next `count` bytes.
    pub(super) fn slice(&mut self, field: &'static str, count: usize) -> Result<&'a [u8], ReadError> {
        let Some((bytes, left)) = self.left.split_at_checked(count) else {
            return Err(self.cut_short(field, count));
        };
        self.left = left;
        Ok(bytes)
    }

    fn cut_short(&self, field: &'static str, bytes: usize) -> ReadError {
        let value = format_args!("cut off after {} bytes", self.left.len());
        self.refused(self.at(), field, value, format_args!("{bytes} bytes"))
    }

    pub(super) fn word(&mut self, field: &'static str) -> Result<u32, ReadError> {
        self.take(field).map(u32::from_le_bytes)
    }

    pub(super) fn long(&mut self, field: &'static str) -> Result<u64, ReadError> {
        self.take(field).map(u64::from_le_bytes)
    }

    pub(super) fn float(&mut self, field: &'static str) -> Result<f32, ReadError> {
        self.take(field).map(f32::from_le_bytes)
    }

    /// Skips four unused bytes, which must be 0.
    pub(super) fn unused(&mut self, field: &'static str) -> Result<(), ReadError> {
        let at = self.at();
        match self.word(field)? {
            0 => Ok(()),
            other => Err(self.refused(at, field, other, 0)),
        }
    }

    /// A UTF-8 text of `bytes` bytes.
    pub(super) fn text(&mut self, field: &'static str, bytes: usize) -> Result<String, ReadError> {
        let at = self.at();
        let text = self.slice(field, bytes)?;
        let Ok(text) = str::from_utf8(text) else {
            let start = &text[..text.len().min(64)];
            return Err(self.refused(at, field, start.escape_ascii(), "UTF-8"));
        };
        let mut name = String::new();
        name.try_reserve_exact(bytes).map_err(|_| OutOfMemory { what: field, bytes: bytes as u64 })?;
        name.push_str(text);
        Ok(name)
    }

    /// Reads the number of items of a list, whose items have at least `each` bytes each. The number
    /// is refused if the bytes left are too few for them.
    pub(super) fn count(&mut self, field: &'static str, each: u64) -> Result<usize, ReadError> {
        let at = self.at();
        let count = self.long(field)?;
        self.room_for(at, field, count, each)
    }

    /// Checks that the bytes left have room for `count` items of at least `each` bytes, and returns
    /// the count. The count stands at byte `at` of the file.
    pub(super) fn room_for(
        &self,
        at: u64,
        field: &'static str,
        count: u64,
        each: u64,
    ) -> Result<usize, ReadError> {
        let most = self.left.len() as u64 / each;
        if count > most {
            let expected = format_args!("{most} at most, because the file has bytes for no more");
            return Err(self.refused(at, field, count, expected));
        }
        // The count fits into `usize`, because it is at most the number of bytes in memory.
        Ok(count as usize)
    }

    /// Reads the length that the file states, and checks it.
    pub(super) fn check_length(&mut self, field: &'static str) -> Result<(), ReadError> {
        let at = self.at();
        let (length, is) = (self.long(field)?, self.whole.len() as u64);
        if length == is {
            Ok(())
        } else {
            Err(self.refused(at, field, length, format_args!("{is}, the file's own")))
        }
    }

    /// Checks the last four bytes, which must be the CRC-32 of all bytes before them. The four
    /// bytes then no longer belong to the file, so [`Self::check_length`] has to come first.
    pub(super) fn check_sum(&mut self, field: &'static str) -> Result<(), ReadError> {
        let Some((left, stated)) = self.left.split_last_chunk() else {
            return Err(self.cut_short(field, 4));
        };
        let end = self.whole.len() - stated.len();
        let (stated, is) = (u32::from_le_bytes(*stated), crc32fast::hash(&self.whole[..end]));
        if stated != is {
            let expected = format_args!("{is:#010x}, that of the bytes before it: the file is damaged");
            return Err(self.refused(end as u64, field, format_args!("{stated:#010x}"), expected));
        }
        (self.left, self.whole) = (left, &self.whole[..end]);
        Ok(())
    }

    /// Checks that no bytes are left.
    pub(super) fn end(&self) -> Result<(), ReadError> {
        match self.left.len() {
            0 => Ok(()),
            more => {
                Err(self.refused(self.at(), "what follows the last list", format_args!("{more} bytes"), "0"))
            }
        }
    }
}

/// The text of a file.
///
/// **Errors**: [`ReadError::Bytes`] for bytes that are not UTF-8.
pub(super) fn utf_8<'a>(file: &Path, bytes: &'a [u8]) -> Result<&'a str, ReadError> {
    str::from_utf8(bytes).map_err(|error| ReadError::Bytes {
        file: file.into(),
        at: error.valid_up_to() as u64,
        field: "the text",
        value: bytes[error.valid_up_to()..].iter().take(4).map(|byte| format!("{byte:02x}")).collect(),
        expected: "UTF-8".into(),
    })
}
