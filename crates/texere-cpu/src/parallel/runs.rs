//! Runs of blocks, each with its own part of the output. A run is the work of one rayon item.

use texere_core::Vertex;
use texere_core::backend::{Block, Chunk, MeshMut};
use texere_core::definitions::Ring;

/// The number of blocks in a run: 2,048 rings, some 600 kB of mesh with six sides. That is enough
/// for the hand-over to take negligible time, and few enough for several cores to share a fabric of
/// a few thousand rings.
const RUN_BLOCKS: usize = 32;

/// A run of blocks, and the output for their rings.
pub(super) struct RingRun<'a> {
    pub(super) blocks: &'a [Block],
    /// The number of the first ring of `rings` in the chunk.
    pub(super) first_ring: u32,
    pub(super) rings: &'a mut [Ring],
}

/// A run of blocks, and the output for their mesh.
pub(super) struct MeshRun<'a> {
    pub(super) blocks: &'a [Block],
    /// The number of the first vertex of `vertices` in the chunk.
    pub(super) first_vertex: u32,
    /// The number of the first index of `indices` in the chunk.
    pub(super) first_index: u32,
    pub(super) vertices: &'a mut [Vertex],
    pub(super) indices: &'a mut [u32],
}

pub(super) fn ring_runs<'a>(chunk: &'a Chunk, rings: &'a mut [Ring]) -> Vec<RingRun<'a>> {
    let mut rings = Rest { first: 0, rest: rings };
    let run = |blocks: &'a [Block]| {
        let [first, last] = ends(blocks);
        let rings = rings.take(first.chunk_ring, last.chunk_ring + last.rings);
        RingRun { blocks, first_ring: first.chunk_ring, rings }
    };
    chunk.blocks().chunks(RUN_BLOCKS).map(run).collect()
}

pub(super) fn mesh_runs<'a>(
    chunk: &'a Chunk,
    sides: u32,
    indexed: bool,
    out: &'a mut MeshMut<'_>,
) -> Vec<MeshRun<'a>> {
    let mut vertices = Rest { first: 0, rest: &mut out.vertices[..] };
    let mut indices = Rest { first: 0, rest: &mut out.indices[..] };
    let run = |blocks: &'a [Block]| {
        let [first, last] = ends(blocks);
        let vertices = vertices.take(first.first_vertex, last.first_vertex + last.rings * sides);
        let end_index = if indexed { last.first_index + last.quads * sides * 6 } else { first.first_index };
        let indices = indices.take(first.first_index, end_index);
        MeshRun {
            blocks,
            first_vertex: first.first_vertex,
            first_index: first.first_index,
            vertices,
            indices,
        }
    };
    chunk.blocks().chunks(RUN_BLOCKS).map(run).collect()
}

/// Runs of `each` blocks, each run with the part of the output for its vertices. The last run may
/// have fewer blocks.
pub(super) fn vertex_runs<'a, T>(
    chunk: &'a Chunk,
    each: usize,
    sides: u32,
    out: &'a mut [T],
) -> Vec<(&'a [Block], &'a mut [T])> {
    let mut rest = Rest { first: 0, rest: out };
    let run = |blocks: &'a [Block]| {
        let [first, last] = ends(blocks);
        (blocks, rest.take(first.first_vertex, last.first_vertex + last.rings * sides))
    };
    chunk.blocks().chunks(each).map(run).collect()
}

/// The first and the last of some blocks.
fn ends(blocks: &[Block]) -> [&Block; 2] {
    [&blocks[0], &blocks[blocks.len() - 1]]
}

/// The part of the output that no run has yet. It begins at number `first` of the chunk's output.
struct Rest<'a, T> {
    first: u32,
    rest: &'a mut [T],
}

impl<'a, T> Rest<'a, T> {
    /// Splits off the values from number `first` up to `end`. Values between runs may belong to no
    /// run.
    fn take(&mut self, first: u32, end: u32) -> &'a mut [T] {
        take(&mut self.rest, (first - self.first) as usize);
        self.first = end;
        take(&mut self.rest, (end - first) as usize)
    }
}

/// Splits the first `count` values off `left`, and returns them.
pub(super) fn take<'a, T>(left: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (taken, rest) = std::mem::take(left).split_at_mut(count);
    *left = rest;
    taken
}
