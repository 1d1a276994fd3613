//! Packed vertices: for each ring of each yarn, as many as the section has sides.

use texere_core::PackedVertex;
use texere_core::backend::Chunk;
use texere_core::definitions::Ring;

use crate::engine::Work;
use crate::packed::caps;

pub(super) fn packed(work: &Work, chunk: &Chunk, rings: &[Ring], out: &mut [PackedVertex]) {
    let plan = &work.plan;
    let (sides, quantum) = (plan.settings().sides as usize, plan.settings().quantum);
    for part in chunk.parts() {
        let outline = plan.outline(plan.yarn(part.yarn as usize).section as usize);
        let first_ring = part.first_vertex as usize / sides;
        for k in first_ring..first_ring + part.rings as usize {
            let stance = rings[k].stance();
            for (packed, point) in out[k * sides..][..sides].iter_mut().zip(outline) {
                *packed = PackedVertex::pack(&rings[k].vertex(&stance, point), quantum);
            }
        }
    }
    caps(work, chunk, out);
}
