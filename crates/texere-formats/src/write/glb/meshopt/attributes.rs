//! The mode `ATTRIBUTES`: elements of some bytes each, as differences from the element before.

use std::io::{self, Write};

use super::{Meshopt, zigzag};

/// The number of elements of a group. The differences of a group have one number of bits.
const GROUP: usize = 16;

/// The most elements of a block.
const BLOCK_MOST: usize = 256;

/// The most bytes of a block's elements.
const BLOCK_BYTES_MOST: usize = 8192;

/// The numbers of bits that the codes of a group stand for in a stream of version 0.
const BITS: [u32; 4] = [0, 2, 4, 8];

/// The numbers of bits that the codes of a group stand for in a stream of version 1, in the control
/// modes 0 and 1.
const BITS_BY_CONTROL: [[u32; 4]; 2] = [[0, 1, 2, 4], [1, 2, 4, 8]];

/// The control mode of a byte whose differences are all 0: nothing is written of them.
const NOTHING: u8 = 2;

/// The control mode of a byte whose differences are written as they are.
const LITERAL: u8 = 3;

/// What differences are taken of. The number of a variant is its channel mode in the tail of a
/// stream of version 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::write::glb) enum Differences {
    /// Single bytes.
    Bytes = 0,
    /// Little-endian numbers of 16 bits. A stream of version 0 can't say so.
    Words = 1,
}

/// An encoder of elements of a fixed number of bytes.
#[derive(Debug)]
pub(in crate::write::glb) struct AttributeEncoder {
    /// Bytes of an element.
    stride: usize,
    extension: Meshopt,
    differences: Differences,
    /// The first element. Empty before it comes.
    first: Vec<u8>,
    /// The element before those that wait.
    before: Vec<u8>,
    /// The elements of a block that is not full yet.
    waiting: Vec<u8>,
}

/// The differences of the elements of a block at one of their bytes. Differences beyond the last
/// element of the last group are 0. Readers pass over them.
type OfByte = [u8; BLOCK_MOST];

impl AttributeEncoder {
    /// An encoder of elements of `stride` bytes, a multiple of four up to 256.
    pub(in crate::write::glb) fn new(stride: usize, extension: Meshopt, differences: Differences) -> Self {
        let (first, before, waiting) = (Vec::new(), Vec::new(), Vec::new());
        Self { stride, extension, differences, first, before, waiting }
    }

    /// Takes further `elements`. Writes every block that they fill to `out`.
    pub(in crate::write::glb) fn add(&mut self, elements: &[u8], out: &mut impl Write) -> io::Result<()> {
        if self.first.is_empty() && !elements.is_empty() {
            self.first = elements[..self.stride].to_vec();
            self.before.clone_from(&self.first);
            out.write_all(&[self.extension.attributes_header()])?;
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

    /// Writes the rest of the stream to `out`: the elements that wait, and the tail, which holds
    /// the first element, and in version 1 a channel mode for every four bytes. There must have
    /// been an element.
    pub(in crate::write::glb) fn finish(mut self, out: &mut impl Write) -> io::Result<()> {
        if !self.waiting.is_empty() {
            self.write_block(out)?;
        }
        let mut tail = self.first;
        if self.extension == Meshopt::Khr {
            tail.resize(self.stride + self.stride / 4, self.differences as u8);
        }
        let padding = vec![0; self.extension.tail_bytes_least().saturating_sub(tail.len())];
        out.write_all(&padding)?;
        out.write_all(&tail)
    }

    /// Writes the elements that wait as a block. The differences of all elements at their first
    /// byte come first, then those at their second byte, and so on.
    fn write_block(&mut self, out: &mut impl Write) -> io::Result<()> {
        let count = self.waiting.len() / self.stride;
        let mut all = Vec::with_capacity(self.waiting.len() + self.stride);
        let mut controls = vec![0; self.stride / 4];
        for place in 0..self.stride {
            let differences = self.of_byte(place);
            let groups = &differences.as_chunks().0[..count.div_ceil(GROUP)];
            match self.extension {
                Meshopt::Ext => all.extend(coded(groups, BITS)),
                Meshopt::Khr => {
                    let (control, bytes) = controlled(&differences[..count], groups);
                    controls[place / 4] |= control << (2 * (place % 4));
                    all.extend(bytes);
                }
            }
        }
        self.before.copy_from_slice(&self.waiting[self.waiting.len() - self.stride..]);
        self.waiting.clear();
        if self.extension == Meshopt::Khr {
            out.write_all(&controls)?;
        }
        out.write_all(&all)
    }

    /// The differences at byte `place` of the elements that wait.
    fn of_byte(&self, place: usize) -> OfByte {
        let mut differences = [0; BLOCK_MOST];
        let mut before = &self.before[..];
        for (difference, element) in differences.iter_mut().zip(self.waiting.chunks_exact(self.stride)) {
            *difference = match self.differences {
                Differences::Bytes => {
                    zigzag(i32::from(element[place].wrapping_sub(before[place]) as i8)) as u8
                }
                Differences::Words => {
                    let low = place / 2 * 2;
                    let word = |element: &[u8]| u16::from_le_bytes([element[low], element[low + 1]]);
                    let difference = word(element).wrapping_sub(word(before)) as i16;
                    (zigzag(i32::from(difference)) as u16).to_le_bytes()[place % 2]
                }
            };
            before = element;
        }
        differences
    }
}

/// The differences of one byte in the control mode that takes the fewest bytes, and that mode.
/// `groups` are the same differences, and zeros.
fn controlled(differences: &[u8], groups: &[[u8; GROUP]]) -> (u8, Vec<u8>) {
    if differences.iter().all(|difference| *difference == 0) {
        return (NOTHING, Vec::new());
    }
    let in_code = (0..).zip(BITS_BY_CONTROL.map(|bits| coded(groups, bits)));
    let literal = (LITERAL, differences.to_vec());
    in_code.fold(literal, |least, mode| if mode.1.len() < least.1.len() { mode } else { least })
}

/// Groups of differences in code: first the codes of all groups, four in a byte, then the groups.
/// Code number c stands for `bits[c]` bits for each difference.
fn coded(groups: &[[u8; GROUP]], bits: [u32; 4]) -> Vec<u8> {
    let codes = groups.len().div_ceil(4);
    let mut bytes = vec![0; codes];
    for (number, group) in groups.iter().enumerate() {
        bytes[number / 4] |= write_group(group, bits, &mut bytes) << (2 * (number % 4));
    }
    bytes
}

/// Appends a group of differences to `bytes` with the number of bits, one of `all`, that takes the
/// fewest bytes. Returns the place of that number in `all`.
fn write_group(group: &[u8; GROUP], all: [u32; 4], bytes: &mut Vec<u8>) -> u8 {
    // A difference that is the largest number of these bits, or larger, is replaced by that number
    // and follows as a byte.
    let beyond = |bits: u32| {
        let largest = u8::MAX >> (8 - bits);
        group.iter().filter(move |&&difference| difference >= largest)
    };
    let size = |bits: u32| match bits {
        0 if *group == [0; GROUP] => 0,
        0 => usize::MAX,
        8 => GROUP,
        _ => GROUP * bits as usize / 8 + beyond(bits).count(),
    };
    let (code, bits) = (0..).zip(all).min_by_key(|&(_, bits)| size(bits)).unwrap_or((0, 8));
    match bits {
        0 => {}
        8 => bytes.extend(group),
        _ => {
            let largest = u8::MAX >> (8 - bits);
            for together in group.chunks_exact(8 / bits as usize) {
                let in_order = together.iter().map(|&difference| difference.min(largest));
                // Single bits begin at the lowest, pairs and fours at the highest.
                bytes.push(match bits {
                    1 => in_order.rev().fold(0, |byte, difference| byte << 1 | difference),
                    _ => in_order.fold(0, |byte, difference| byte << bits | difference),
                });
            }
            bytes.extend(beyond(bits));
        }
    }
    code
}
