//! The mode `ATTRIBUTES`: elements of some bytes each, as differences from the element before.

use std::io::{self, Write};

use super::zigzag;

/// The first byte of the stream.
const HEADER: u8 = 0xa0;

/// The number of elements of a group. The differences of a group have one number of bits.
const GROUP: usize = 16;

/// The most elements of a block.
const BLOCK_MOST: usize = 256;

/// The most bytes of a block's elements.
const BLOCK_BYTES_MOST: usize = 8192;

/// The fewest bytes of the tail, which holds the first element.
const TAIL_BYTES_LEAST: usize = 32;

/// An encoder of elements of a fixed number of bytes.
#[derive(Debug)]
pub(in crate::write::glb) struct AttributeEncoder {
    /// Bytes of an element.
    stride: usize,
    /// The first element. Empty before it comes.
    first: Vec<u8>,
    /// The element before those that wait.
    before: Vec<u8>,
    /// The elements of a block that is not full yet.
    waiting: Vec<u8>,
}

impl AttributeEncoder {
    /// An encoder of elements of `stride` bytes, a multiple of four up to 256.
    pub(in crate::write::glb) fn new(stride: usize) -> Self {
        Self { stride, first: Vec::new(), before: Vec::new(), waiting: Vec::new() }
    }

    /// Takes further `elements`. Writes every block that they fill to `out`.
    pub(in crate::write::glb) fn add(&mut self, elements: &[u8], out: &mut impl Write) -> io::Result<()> {
        if self.first.is_empty() && !elements.is_empty() {
            self.first = elements[..self.stride].to_vec();
            self.before.clone_from(&self.first);
            out.write_all(&[HEADER])?;
        }
        let full = BLOCK_MOST.min(BLOCK_BYTES_MOST / self.stride / GROUP * GROUP) * self.stride;
        let mut left = elements;
        while !left.is_empty() {
            let (own, others) = left.split_at(left.len().min(full - self.waiting.len()));
            self.waiting.extend_from_slice(own);
            left = others;
            if self.waiting.len() == full {
                self.write_block(out)?;
            }
        }
        Ok(())
    }

    /// Writes the rest of the stream to `out`.
    pub(in crate::write::glb) fn finish(mut self, out: &mut impl Write) -> io::Result<()> {
        if !self.waiting.is_empty() {
            self.write_block(out)?;
        }
        let padding = TAIL_BYTES_LEAST.saturating_sub(self.stride);
        out.write_all(&[0; TAIL_BYTES_LEAST][..padding])?;
        out.write_all(&self.first)
    }

    /// Writes the elements that wait as a block. The bytes of all elements with one place in their
    /// element follow one another.
    fn write_block(&mut self, out: &mut impl Write) -> io::Result<()> {
        let groups = (self.waiting.len() / self.stride).div_ceil(GROUP);
        for place in 0..self.stride {
            // Differences beyond the last element of the last group stay 0. Readers pass over them.
            let mut differences = [0; BLOCK_MOST];
            let mut before = self.before[place];
            for (difference, element) in differences.iter_mut().zip(self.waiting.chunks_exact(self.stride)) {
                *difference = zigzag(i32::from(element[place].wrapping_sub(before) as i8)) as u8;
                before = element[place];
            }
            self.before[place] = before;
            let (mut header, mut bytes) = ([0; BLOCK_MOST / GROUP / 4], Vec::with_capacity(BLOCK_MOST));
            for (number, group) in differences.as_chunks().0.iter().take(groups).enumerate() {
                header[number / 4] |= write_group(group, &mut bytes) << (2 * (number % 4));
            }
            out.write_all(&header[..groups.div_ceil(4)])?;
            out.write_all(&bytes)?;
        }
        self.waiting.clear();
        Ok(())
    }
}

/// Appends a group of differences to `bytes` with the number of bits that takes the fewest bytes.
/// Returns the code of that number: 0 for none, 1 for two, 2 for four, 3 for eight.
fn write_group(group: &[u8; GROUP], bytes: &mut Vec<u8>) -> u8 {
    if *group == [0; GROUP] {
        return 0;
    }
    // A number that needs more bits is replaced by the largest number, and follows as a byte.
    let size = |bits: u32| {
        let largest = (1 << bits) - 1;
        GROUP * bits as usize / 8 + group.iter().filter(|&&number| number >= largest).count()
    };
    let Some((code, bits)) = [(1, 2), (2, 4)]
        .into_iter()
        .filter(|&(_, bits)| size(bits) < GROUP)
        .min_by_key(|&(_, bits)| size(bits))
    else {
        bytes.extend(group);
        return 3;
    };
    let largest = (1 << bits) - 1;
    for together in group.chunks_exact(8 / bits as usize) {
        bytes.push(together.iter().fold(0, |byte, &number| byte << bits | number.min(largest)));
    }
    bytes.extend(group.iter().filter(|&&number| number >= largest));
    code
}
