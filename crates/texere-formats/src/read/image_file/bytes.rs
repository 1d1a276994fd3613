//! The bytes of an image file.

use std::io::{BufRead, Seek};

/// The source that an image is decoded from: bytes to read and seek in.
pub(super) trait Bytes: BufRead + Seek {}

impl<T: BufRead + Seek> Bytes for T {}

/// The first `count` numbers of `bits` bits each (1, 2, 4 or 8) that a row's bytes hold. The first
/// number is in the highest bits of its byte.
pub(super) fn packed_numbers(row: &[u8], bits: usize, count: usize) -> impl Iterator<Item = usize> {
    let digits = move |byte: u8| (0..8 / bits).rev().map(move |place| usize::from(byte) >> (place * bits));
    row.iter().flat_map(move |byte| digits(*byte)).map(move |number| number & ((1 << bits) - 1)).take(count)
}
