//! Algorithm 3 of the paper: for each yarn and each ring, as many vertices as the section has sides
//! (nc in the paper); and the triangles between rings.

use texere_core::Topology;
use texere_core::backend::{Chunk, MeshMut};
use texere_core::definitions::{Ring, index_pattern};

use crate::caps::caps;
use crate::engine::Work;

pub(super) fn mesh(work: &Work, chunk: &Chunk, rings: &[Ring], out: MeshMut<'_>) {
    let plan = &work.plan;
    let sides = plan.settings().sides as usize;
    let indexed = plan.settings().topology == Topology::Indexed;
    let pattern = index_pattern(plan.settings().sides);

    for part in chunk.parts() {
        let outline = plan.outline(plan.yarn(part.yarn as usize).section as usize);
        let first_ring = part.first_vertex as usize / sides;
        for k in 0..part.rings as usize {
            let ring = &rings[first_ring + k];
            let first_vertex = part.first_vertex as usize + k * sides;
            let stance = ring.stance();
            for (vertex, point) in out.vertices[first_vertex..][..sides].iter_mut().zip(outline) {
                *vertex = ring.vertex(&stance, point);
            }
            if indexed && k + 1 < part.rings as usize {
                let first_index = part.first_index as usize + k * pattern.len();
                for (index, offset) in out.indices[first_index..][..pattern.len()].iter_mut().zip(&pattern) {
                    *index = first_vertex as u32 + offset;
                }
            }
        }
    }
    caps(work, chunk, out);
}
