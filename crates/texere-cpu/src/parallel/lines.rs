//! Output in whole cache lines, which can go past the caches.
//!
//! If a whole line is written past the caches, the processor need not read it from memory first.
//! But only few such lines can be on their way to memory at a time. Lines are therefore sent in
//! small groups between other work, so that the processor need not wait for memory.

use std::ops::Range;

use super::runs::take;
use super::simd::{Floats, Integers, LANES_MAX, LINE, Line, Simd};
use super::vertices::OVERHANG;

/// A slice of the output, split into whole lines.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    /// The floats before the first whole line.
    pub(super) head: &'a mut [f32],
    /// The floats after the last whole line.
    pub(super) tail: &'a mut [f32],
    /// The whole lines between `head` and `tail`.
    pub(super) lines: &'a mut [Line],
    /// Whether lines go past the caches.
    pub(super) streams: bool,
}

impl<'a> Lines<'a> {
    pub(super) fn new(out: &'a mut [f32], streams: bool) -> Self {
        let (head, lines, tail) = bytemuck::pod_align_to_mut::<f32, Line>(out);
        Self { head, tail, lines, streams }
    }
}

/// Vertices on their way to the output.
///
/// They are written to scratch memory, aligned there as they will be in the output. Whole lines are
/// sent from there: half of them immediately, the other half before the vertices of the next rings
/// are written. The floats after the last whole line are copied to the front of a second scratch
/// memory, which takes the next vertices. The two scratch memories take turns. Each holds the
/// vertices of one vector of rings, so both stay in the nearest cache.
#[derive(Debug)]
pub(super) struct VertexLines<'a> {
    out: Lines<'a>,
    scratch: &'a mut [f32],
    other: &'a mut [f32],
    /// Index in the scratch memory at which the next vertices go.
    end: usize,
    /// The floats of the other scratch memory whose lines are still to be sent.
    waiting: Range<usize>,
    /// Whether the floats before the first whole line are still to be sent.
    starts: bool,
}

impl<'a> VertexLines<'a> {
    /// The number of lines of scratch memory for vertices of `floats` floats a ring.
    pub(super) const fn scratch(floats: usize) -> usize {
        2 * (1 + (LANES_MAX * floats + OVERHANG).div_ceil(LINE))
    }

    pub(super) fn new(out: Lines<'a>, scratch: &'a mut [Line]) -> Self {
        let end = out.head.len().wrapping_neg() % LINE;
        let (scratch, other) = scratch.split_at_mut(scratch.len() / 2);
        let (scratch, other) = (bytemuck::cast_slice_mut(scratch), bytemuck::cast_slice_mut(other));
        Self { starts: end > 0, end, out, scratch, other, waiting: 0..0 }
    }

    /// The memory for the next vertices. A few floats behind them may be overwritten.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn next(&mut self) -> &mut [f32] {
        &mut self.scratch[self.end..]
    }

    /// Begins to send `floats` values that have been written. The lines that waited before must
    /// have been sent.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn send(&mut self, simd: impl Simd, floats: usize) {
        let mut first = 0;
        self.end += floats;
        if self.starts && self.end >= LINE {
            self.out.head.copy_from_slice(&self.scratch[LINE - self.out.head.len()..LINE]);
            (self.starts, first) = (false, LINE);
        }
        let whole = self.end / LINE * LINE;
        if whole > 0 {
            self.other[..LINE].copy_from_slice(&self.scratch[whole..whole + LINE]);
            self.end -= whole;
            std::mem::swap(&mut self.scratch, &mut self.other);
            let half = first + (whole - first) / LINE / 2 * LINE;
            self.pass(simd, first..half);
            self.waiting = half..whole;
        }
    }

    /// Sends the lines that wait.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn send_waiting(&mut self, simd: impl Simd) {
        let waiting = std::mem::take(&mut self.waiting);
        self.pass(simd, waiting);
    }

    /// Sends whole lines of the other scratch memory.
    #[cfg_attr(optimized, inline(always))]
    fn pass(&mut self, simd: impl Simd, floats: Range<usize>) {
        let (from, _) = self.other[floats].as_chunks::<LINE>();
        let to = take(&mut self.out.lines, from.len());
        if self.out.streams {
            to.iter_mut().zip(from).for_each(|(to, from)| simd.stream(from, to));
        } else {
            to.iter_mut().zip(from).for_each(|(to, from)| to.0 = *from);
        }
    }

    /// Sends what is left.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn finish(mut self, simd: impl Simd) {
        self.send_waiting(simd);
        let Lines { head, tail, .. } = self.out;
        if self.starts {
            head.copy_from_slice(&self.scratch[self.end - head.len()..self.end]);
        } else {
            tail.copy_from_slice(&self.scratch[..tail.len()]);
        }
    }
}

/// The indices of the first [`INDEX_RINGS`] rings, which fill whole lines, and one line more with
/// indices of the next ring.
#[derive(Debug)]
pub(super) struct IndexTable {
    table: Vec<u32>,
    period: usize,
    growth: u32,
}

/// The number of rings whose indices fill whole lines, whatever the number of sides: a ring has six
/// indices a side, so eight rings have 48 indices a side, and 48 indices are three lines.
const INDEX_RINGS: u32 = 8;

impl IndexTable {
    pub(super) fn new(sides: u32) -> Self {
        let pattern = texere_core::definitions::index_pattern(sides);
        let rings = (0..=INDEX_RINGS).flat_map(|ring| pattern.iter().map(move |index| ring * sides + index));
        let period = pattern.len() * INDEX_RINGS as usize;
        Self { table: rings.take(period + LINE).collect(), period, growth: INDEX_RINGS * sides }
    }
}

/// Indices on their way to the output.
#[derive(Debug)]
pub(super) struct IndexLines<'a> {
    out: Lines<'a>,
    /// The pattern from the first whole line on. It is repeated, each time with `base` grown by
    /// `growth`.
    pattern: &'a [[u32; LINE]],
    growth: u32,
    base: u32,
    /// The number of the pattern's line that comes next.
    next: usize,
}

impl<'a> IndexLines<'a> {
    /// The indices of the quads of consecutive rings. `first_vertex` is the first vertex of the
    /// first ring.
    pub(super) fn new(out: &'a mut [u32], streams: bool, table: &'a IndexTable, first_vertex: u32) -> Self {
        let out = Lines::new(bytemuck::cast_slice_mut(out), streams);
        put(out.head, &table.table, first_vertex);
        let (pattern, _) = table.table[out.head.len()..][..table.period].as_chunks();
        Self { out, pattern, growth: table.growth, base: first_vertex, next: 0 }
    }

    /// Sends the next lines, at most `count` of them.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn send<S: Simd>(&mut self, simd: S, count: usize) {
        let mut left = count.min(self.out.lines.len());
        while left > 0 {
            let offsets = &self.pattern[self.next..];
            let lines = take(&mut self.out.lines, left.min(offsets.len()));
            let base = simd.splat_integer(self.base);
            if self.out.streams {
                lines
                    .iter_mut()
                    .zip(offsets)
                    .for_each(|(line, offsets)| simd.stream_indices(offsets, base, line));
            } else {
                for (line, offsets) in lines.iter_mut().zip(offsets) {
                    for k in (0..LINE).step_by(S::LANES) {
                        let indices = simd.load_integers(&offsets[k..]) + base;
                        indices.bit_cast().store(&mut line.0[k..]);
                    }
                }
            }
            left -= lines.len();
            self.next += lines.len();
            if self.next == self.pattern.len() {
                (self.next, self.base) = (0, self.base.wrapping_add(self.growth));
            }
        }
    }

    /// Sends what is left.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn finish(mut self, simd: impl Simd) {
        self.send(simd, usize::MAX);
        put(self.out.tail, &self.pattern[self.next], self.base);
    }
}

/// Writes `base + table[i]` to `out[i]`, for all of `out`.
fn put(out: &mut [f32], table: &[u32], base: u32) {
    for (index, offset) in out.iter_mut().zip(table) {
        *index = f32::from_bits(base.wrapping_add(*offset));
    }
}
