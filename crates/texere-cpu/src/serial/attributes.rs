//! Lengths along yarns, and attributes of vertices, one after the other on one thread.

use std::ops::Range;

use texere_core::backend::{Chunk, PaddedPoints, Plan};
use texere_core::{ArcLength, Attribute};

use crate::attributes::{block, block_length, blocks_of, caps, sum_up};
use crate::engine::Work;

pub(super) fn measure(plan: &Plan, points: &PaddedPoints, lengths: &mut [ArcLength], yarns: Range<usize>) {
    for yarn in yarns {
        let own = &mut lengths[blocks_of(plan, yarn)];
        for (number, length) in (0..).zip(&mut *own) {
            *length = block_length(plan, points, yarn, number);
        }
        sum_up(own);
    }
}

pub(super) fn attributes(work: &Work, chunk: &Chunk, out: &mut [Attribute]) {
    let sides = work.plan.settings().sides;
    for row in chunk.blocks() {
        let own = row.first_vertex as usize..(row.first_vertex + row.rings * sides) as usize;
        block(work, row, &mut out[own]);
    }
    caps(work, chunk, out);
}
