//! Lengths along yarns, and attributes of vertices. Each rayon item is one block.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::backend::{Chunk, PaddedPoints, Plan};
use texere_core::{ArcLength, Attribute};

use super::runs::{take, vertex_runs};
use crate::attributes::{block, block_length, blocks_of, caps, sum_up};
use crate::engine::Work;

pub(super) fn measure(plan: &Plan, points: &PaddedPoints, lengths: &mut [ArcLength], yarns: Range<usize>) {
    // Each item is one block, so that all cores share the work on one long yarn as well as on many
    // short ones.
    let (mut left, mut first, mut blocks) = (&mut *lengths, 0, Vec::new());
    for yarn in yarns.clone() {
        let own = blocks_of(plan, yarn);
        take(&mut left, own.start - first);
        first = own.end;
        blocks.extend((0..).zip(take(&mut left, own.len())).map(|(number, length)| (yarn, number, length)));
    }
    blocks.into_par_iter().for_each(|(yarn, number, length)| {
        *length = block_length(plan, points, yarn, number);
    });
    yarns.for_each(|yarn| sum_up(&mut lengths[blocks_of(plan, yarn)]));
}

pub(super) fn attributes(work: &Work, chunk: &Chunk, out: &mut [Attribute]) {
    let runs = vertex_runs(chunk, 1, work.plan.settings().sides, out);
    runs.into_par_iter().for_each(|(rows, out)| block(work, &rows[0], out));
    caps(work, chunk, out);
}
