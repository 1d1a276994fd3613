//! Yarns whose outlines lean: their control points have up directions of their own. Such yarns are
//! rare, so they are not made in lanes. The serial backend's function makes their rings, and the
//! core's `Ring::vertex` makes their vertices. The blocks of a call are consecutive blocks of one
//! yarn.

use texere_core::Vertex;
use texere_core::backend::{BLOCK_RINGS, Block};
use texere_core::definitions::{Ring, index_pattern};

use crate::engine::Work;
use crate::serial;

pub(super) fn rings(work: &Work, blocks: &[Block], out: &mut [Ring]) {
    let mut out = out;
    for block in blocks {
        let own = out.split_off_mut(..block.rings as usize).unwrap_or_default();
        serial::rings(work, block.yarn as usize, block.first_ring, own);
    }
}

/// Makes vertices and indices. `indices` is empty if none are wanted.
pub(super) fn mesh(work: &Work, blocks: &[Block], vertices: &mut [Vertex], indices: &mut [u32]) {
    let (plan, sides) = (&work.plan, work.plan.settings().sides);
    let outline = plan.outline(plan.yarn(blocks[0].yarn as usize).section as usize);
    let mut vertices = vertices.chunks_exact_mut(sides as usize);
    let mut rings = [Ring::default(); BLOCK_RINGS as usize];
    for block in blocks {
        let rings = &mut rings[..block.rings as usize];
        serial::rings(work, block.yarn as usize, block.first_ring, rings);
        for (ring, vertices) in rings.iter().zip(&mut vertices) {
            let stance = ring.stance();
            for (vertex, point) in vertices.iter_mut().zip(outline) {
                *vertex = ring.vertex(&stance, point);
            }
        }
    }
    let pattern = index_pattern(sides);
    for (k, indices) in (0..).zip(indices.chunks_exact_mut(pattern.len())) {
        for (index, offset) in indices.iter_mut().zip(&pattern) {
            *index = blocks[0].first_vertex + k * sides + offset;
        }
    }
}
