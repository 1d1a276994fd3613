//! Runs of blocks, each with its own stretch of the output: what one rayon item works on.

use texere_core::{Block, Chunk, MeshMut, Ring, Vertex};

/// Blocks in a run: 2,048 rings, some 600 kB of mesh with six sides. Enough to make the hand-over cheap, few enough
/// that a fabric of a few thousand rings still feeds several cores.
const RUN_BLOCKS: usize = 32;

/// A run of blocks and where their rings go.
pub(super) struct RingRun<'a> {
    pub(super) blocks: &'a [Block],
    /// Number of the first block among all of the plan.
    pub(super) first_block: u64,
    pub(super) rings: &'a mut [Ring],
}

/// A run of blocks and where their mesh goes.
pub(super) struct MeshRun<'a> {
    pub(super) blocks: &'a [Block],
    /// Number of the first block among all of the plan.
    pub(super) first_block: u64,
    pub(super) vertices: &'a mut [Vertex],
    pub(super) indices: &'a mut [u32],
}

/// The runs of a chunk with the number of each one's first block.
fn runs(chunk: &Chunk) -> impl Iterator<Item = (&[Block], u64)> {
    let numbers = (chunk.block_range().start..).step_by(RUN_BLOCKS);
    chunk.blocks().chunks(RUN_BLOCKS).zip(numbers)
}

pub(super) fn ring_runs<'a>(chunk: &'a Chunk, mut rings_left: &'a mut [Ring]) -> Vec<RingRun<'a>> {
    runs(chunk)
        .map(|(blocks, first_block)| {
            let count = blocks.iter().map(|block| block.rings as usize).sum();
            RingRun { blocks, first_block, rings: take(&mut rings_left, count) }
        })
        .collect()
}

pub(super) fn mesh_runs<'a>(
    chunk: &'a Chunk,
    sides: usize,
    indexed: bool,
    out: &'a mut MeshMut<'_>,
) -> Vec<MeshRun<'a>> {
    let (mut vertices_left, mut indices_left) = (&mut out.vertices[..], &mut out.indices[..]);
    runs(chunk)
        .map(|(blocks, first_block)| {
            let rings: usize = blocks.iter().map(|block| block.rings as usize).sum();
            let quads: usize = blocks.iter().map(|block| block.quads as usize).sum();
            let indices = take(&mut indices_left, if indexed { quads * sides * 6 } else { 0 });
            MeshRun { blocks, first_block, vertices: take(&mut vertices_left, rings * sides), indices }
        })
        .collect()
}

/// Splits the first `count` values off `left`.
pub(super) fn take<'a, T>(left: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (taken, rest) = std::mem::take(left).split_at_mut(count);
    *left = rest;
    taken
}
