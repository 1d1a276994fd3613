//! Stage 1 alone, for callers that want rings and no mesh.

use rayon::prelude::*;
use texere_core::backend::{Block, Chunk};
use texere_core::definitions::Ring;

use super::instruction_set::InstructionSet;
use super::leaning;
use super::maker::{Maker, Piece, Sink};
use super::rings::Rings;
use super::runs::{RingRun, ring_runs, take};
use super::simd::{Job, LANES_MAX, Simd};
use crate::engine::Work;

pub(super) fn trajectory(set: InstructionSet, work: &Work, chunk: &Chunk, out: &mut [Ring]) {
    let maker = Maker::new(work);
    ring_runs(chunk, out).into_par_iter().for_each(|run| set.run(RingJob { maker: &maker, run }));
}

/// Stage 1 for a run of blocks.
struct RingJob<'a> {
    maker: &'a Maker<'a>,
    run: RingRun<'a>,
}

impl Job for RingJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { maker, run: RingRun { blocks, first_ring, rings } } = self;
        for blocks in blocks.chunk_by(|block, next| block.is_before(next)) {
            let count: usize = blocks.iter().map(|block| block.rings as usize).sum();
            let rings = &mut rings[(blocks[0].chunk_ring - first_ring) as usize..][..count];
            if maker.leans(blocks) {
                leaning::rings(maker.work, blocks, rings);
                continue;
            }
            maker.make(simd, RingPiece { maker, blocks, sink: RingSink { rings } }, blocks);
        }
    }
}

struct RingPiece<'a> {
    maker: &'a Maker<'a>,
    blocks: &'a [Block],
    sink: RingSink<'a>,
}

impl Piece for RingPiece<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn make<S: Simd, const FLATTENED: bool>(mut self, simd: S) {
        self.maker.rings::<S, FLATTENED>(simd, self.blocks, &mut self.sink);
    }
}

/// The sink that writes a trajectory.
struct RingSink<'a> {
    rings: &'a mut [Ring],
}

impl Sink for RingSink<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn take<S: Simd, const FLATTENED: bool>(
        &mut self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        roll: S::Integers,
        _rolled: bool,
        count: usize,
    ) {
        let mut out = [Ring::default(); LANES_MAX];
        rings.store(simd, roll, &mut out);
        take(&mut self.rings, count).copy_from_slice(&out[..count]);
    }
}
