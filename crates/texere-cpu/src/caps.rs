//! The caps that close the ends of open yarns.

use texere_core::backend::{Chunk, MeshMut};
use texere_core::{Cap, End, Topology, Vertex};

use crate::engine::Work;

/// Writes the caps of `chunk`. A cap has the positions of the end ring and the normal of the yarn's
/// end. The tube's vertices must be in `out` already.
pub(crate) fn caps(work: &Work, chunk: &Chunk, out: MeshMut<'_>) {
    let plan = &work.plan;
    let sides = plan.settings().sides as usize;
    for cap in chunk.caps() {
        let (yarn, normal) = (cap.yarn as usize, end_normal(work, cap));
        let ring_vertex = cap.chunk_ring as usize * sides;
        for k in 0..sides {
            let position = out.vertices[ring_vertex + k].position;
            out.vertices[cap.first_vertex as usize + k] = Vertex { position, normal };
        }
        if plan.settings().topology == Topology::Indexed {
            let corners = plan.cap_indices(plan.yarn(yarn).section as usize, cap.end);
            for (index, corner) in out.indices[cap.first_index as usize..].iter_mut().zip(corners) {
                *index = cap.first_vertex + corner;
            }
        }
    }
}

/// The normal of a cap: the tangent at the yarn's end, pointing out of the yarn.
pub(crate) fn end_normal(work: &Work, cap: &Cap) -> [f32; 3] {
    let (plan, yarn) = (&work.plan, cap.yarn as usize);
    let rings = plan.rings(yarn);
    let (ring, sign) = if cap.end == End::Start { (0, -1.0) } else { (rings - 1, 1.0) };
    let end = plan.sampling().sample(work.points.yarn(plan, yarn), ring, rings, false);
    (end.sample.tangent * sign).to_array()
}
