//! Vertices that become whole cache lines in registers. This works if rings start at quarters of
//! lines: with an even number of sides, in memory aligned to 16 bytes.
//!
//! Four rings then fill as many lines as a ring has quarters. [`Surface`](super::vertices::Surface)
//! gives a column for each quarter of four rings. The first four lanes of a column hold one quarter
//! of one ring, the next four lanes the same quarter of the ring four further on, and so on. The
//! first four lanes of four consecutive columns are a line, and so are the next four lanes. Columns
//! pass through memory. Each column is stored, and later read, as one aligned vector, so the
//! processor can hand the stored vector on to the read. Otherwise the read would wait until the
//! lines of earlier rings have gone past the caches, which is slow.

use super::lines::Lines;
use super::runs::take;
use super::simd::{Floats, LANES_MAX, LINE, Line, Simd};

/// The number of floats of a quarter of a line.
const QUARTER: usize = 4;

/// The most columns of earlier rings that the first lines of a vector of rings need: a line less a
/// quarter.
const BEFORE: usize = LINE / QUARTER - 1;

/// Vertices on their way to the output, a vector of rings at a time.
#[derive(Debug)]
pub(super) struct TileLines<'a> {
    out: Lines<'a>,
    /// The last columns of the rings sent before, and then a column for each quarter of four rings.
    columns: &'a mut [f32],
    /// Memory for lines that lie only in part in the output.
    edge: &'a mut [Line],
    /// The number of quarters of a ring.
    quarters: usize,
    /// The number of quarters from the start of a line to the start of the first ring.
    shift: usize,
    /// Whether the first rings are still to come.
    starts: bool,
}

impl<'a> TileLines<'a> {
    /// Whether rings of `floats` floats start at quarters of the lines of `out`, and the lines go
    /// past the caches. Lines that stay in the caches are better written in order.
    pub(super) fn fit(out: &Lines<'_>, floats: usize) -> bool {
        out.streams && floats.is_multiple_of(QUARTER) && out.head.len().is_multiple_of(QUARTER)
    }

    pub(super) fn new(out: Lines<'a>, floats: usize, scratch: &'a mut [Line]) -> Self {
        let shift = out.head.len().wrapping_neg() % LINE / QUARTER;
        let (columns, edge) = scratch.split_at_mut(BEFORE + floats);
        let columns = bytemuck::cast_slice_mut(columns);
        Self { out, columns, edge, quarters: floats / QUARTER, shift, starts: true }
    }

    /// The number of lines of scratch memory for rings of `floats` floats.
    pub(super) const fn scratch(floats: usize) -> usize {
        (BEFORE + floats) + floats * LANES_MAX / LINE
    }

    /// The memory for the columns of the next rings.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn next<S: Simd>(&mut self, _simd: S) -> &mut [f32] {
        &mut self.columns[BEFORE * S::LANES..]
    }

    /// Sends the lines of `count` rings whose columns have been written.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn send<S: Simd>(&mut self, simd: S, count: usize) {
        let (before, here) = self.columns.split_at_mut(BEFORE * S::LANES);
        let last = &here[(4 * self.quarters - BEFORE) * S::LANES..][..BEFORE * S::LANES];
        for (before, last) in before.chunks_exact_mut(S::LANES).zip(last.chunks_exact(S::LANES)) {
            // The lanes of ring 0 get the last quarters of the ring sent before, those of ring 4
            // the last quarters of ring 3, and so on.
            simd.load(last).shift_in_four(simd.load(before)).store(before);
        }

        if self.starts || count < S::LANES {
            self.send_edge(simd, count);
        } else {
            let lines = take(&mut self.out.lines, self.quarters * S::LANES / QUARTER);
            let columns = &self.columns[(BEFORE - self.shift) * S::LANES..];
            simd.arrange::<true>(columns, lines);
        }

        let (before, here) = self.columns.split_at_mut(BEFORE * S::LANES);
        let last = &here[(4 * self.quarters - BEFORE) * S::LANES..][..BEFORE * S::LANES];
        for (before, last) in before.chunks_exact_mut(S::LANES).zip(last.chunks_exact(S::LANES)) {
            simd.load(last).store(before);
        }
    }

    /// Sends the lines of the first rings, or of the last rings if they do not fill a vector.
    #[cfg_attr(optimized, inline(always))]
    fn send_edge<S: Simd>(&mut self, simd: S, count: usize) {
        let lines = self.quarters * S::LANES / QUARTER;
        let columns = &self.columns[(BEFORE - self.shift) * S::LANES..];
        simd.arrange::<false>(columns, &mut self.edge[..lines]);
        let mut floats: &[f32] = bytemuck::cast_slice(&self.edge[..lines]);
        // A part of a line is sent with the rings that follow, if any do.
        let mut left = (self.shift + count * self.quarters) * QUARTER;
        if self.starts {
            self.starts = false;
            if self.shift > 0 {
                self.out.head.copy_from_slice(&floats[self.shift * QUARTER..LINE]);
                (floats, left) = (&floats[LINE..], left - LINE);
            }
        }
        let (whole, rest) = floats[..left.min(floats.len())].as_chunks::<LINE>();
        let to = take(&mut self.out.lines, whole.len());
        for (to, from) in to.iter_mut().zip(whole) {
            simd.stream(from, to);
        }
        if !rest.is_empty() {
            std::mem::take(&mut self.out.tail).copy_from_slice(rest);
        }
    }

    /// Sends what is left.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn finish<S: Simd>(self, _simd: S) {
        // What is left lies in the last lanes of the last columns. If the last rings did not fill a
        // vector, `send_edge` has left nothing.
        let last = &self.columns[(BEFORE - self.shift) * S::LANES..BEFORE * S::LANES];
        let (tail, _) = self.out.tail.as_chunks_mut::<QUARTER>();
        for (to, from) in tail.iter_mut().zip(last.chunks_exact(S::LANES)) {
            to.copy_from_slice(&from[S::LANES - QUARTER..]);
        }
    }
}
