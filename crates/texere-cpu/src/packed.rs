//! Packed vertices, from those of a block.

use texere_core::PackedVertex;
use texere_core::backend::Chunk;

use crate::caps::end_normal;
use crate::engine::Work;

/// Makes those of caps once those of tubes stand: the end ring's positions again, with the end's
/// own normal.
pub(crate) fn caps(work: &Work, chunk: &Chunk, out: &mut [PackedVertex]) {
    let sides = work.plan.settings().sides as usize;
    for cap in chunk.caps() {
        let (ring, own, normal) =
            (cap.chunk_ring as usize * sides, cap.first_vertex as usize, end_normal(work, cap));
        for k in 0..sides {
            out[own + k] = out[ring + k].with_normal(normal);
        }
    }
}
