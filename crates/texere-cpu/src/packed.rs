//! The packed vertices of caps.

use texere_core::PackedVertex;
use texere_core::backend::Chunk;

use crate::caps::end_normal;
use crate::engine::Work;

/// Writes the packed vertices of caps. A cap has the positions of the end ring and the normal of
/// the yarn's end. The packed vertices of tubes must be in `out` already.
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
