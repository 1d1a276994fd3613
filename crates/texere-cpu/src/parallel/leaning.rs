//! Yarns that leave the plane of their cloth, by the reference's own functions, a run of blocks on each core.

use texere_core::{BLOCK_RINGS, Ring, index_pattern};

use super::runs::{MeshRun, RingRun};
use crate::engine::Work;
use crate::serial;

pub(super) fn rings(work: &Work, run: RingRun<'_>) {
    for block in run.blocks {
        let first = (block.chunk_ring - run.first_ring) as usize;
        let own = &mut run.rings[first..][..block.rings as usize];
        serial::rings(work, block.yarn as usize, block.first_ring, own);
    }
}

/// Vertices, and indices where they are wanted.
pub(super) fn mesh(work: &Work, indexed: bool, run: MeshRun<'_>) {
    let (plan, sides) = (&work.plan, work.plan.settings().sides);
    let pattern = index_pattern(sides);
    let mut rings = [Ring::default(); BLOCK_RINGS as usize];
    for block in run.blocks {
        let rings = &mut rings[..block.rings as usize];
        serial::rings(work, block.yarn as usize, block.first_ring, rings);
        let outline = plan.outline(plan.yarn(block.yarn as usize).section as usize);
        let first = (block.first_vertex - run.first_vertex) as usize;
        let vertices = run.vertices[first..].chunks_exact_mut(sides as usize);
        for (ring, vertices) in rings.iter().zip(vertices) {
            let stance = ring.stance();
            for (vertex, point) in vertices.iter_mut().zip(outline) {
                *vertex = ring.vertex(&stance, point);
            }
        }
        if indexed {
            let first = (block.first_index - run.first_index) as usize;
            let quads = run.indices[first..].chunks_exact_mut(pattern.len()).take(block.quads as usize);
            for (k, indices) in (0..).zip(quads) {
                for (index, offset) in indices.iter_mut().zip(&pattern) {
                    *index = block.first_vertex + k * sides + offset;
                }
            }
        }
    }
}
