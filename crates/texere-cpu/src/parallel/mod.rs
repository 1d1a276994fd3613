//! Equal ranges of rings over all cores: inside a yarn as well as across yarns.

mod rings;
mod runs;
mod scan;
mod vertices;
mod walk;

use rayon::prelude::*;
use texere_core::{Chunk, MeshMut, PaddedPoints, Plan, Topology, index_pattern};

use crate::caps::caps;
use crate::rolls::Rolls;
use crate::session::{ChunkRings, Stages, Work};
use rings::BlockRings;
use runs::{mesh_runs, ring_runs};
use vertices::{indices, vertices};

#[derive(Debug)]
pub(crate) struct Parallel;

impl Stages for Parallel {
    const FUSED: bool = true;

    fn scan(plan: &Plan, points: &PaddedPoints) -> Rolls {
        scan::scan(plan, points)
    }

    fn trajectory(work: &Work, chunk: &Chunk, out: &mut ChunkRings) {
        ring_runs(chunk, out).into_par_iter().for_each(|run| {
            let mut rings = BlockRings::new();
            let mut out = run.rings.iter_mut().zip(run.slopes);
            for (block, number) in run.blocks.iter().zip(run.first_block..) {
                rings.make(work, block, number);
                for (k, (ring, slope)) in (0..rings.count).zip(&mut out) {
                    (*ring, *slope) = (rings.ring(k), rings.slope[k]);
                }
            }
        });
    }

    fn mesh(work: &Work, chunk: &Chunk, _rings: &ChunkRings, mut out: MeshMut<'_>) {
        let plan = &work.plan;
        let sides = plan.settings().sides as usize;
        let indexed = plan.settings().topology == Topology::Indexed;
        let pattern = index_pattern(plan.settings().sides);
        mesh_runs(chunk, sides, indexed, &mut out).into_par_iter().for_each(|run| {
            let mut rings = BlockRings::new();
            let (mut vertices_left, mut indices_left) = (run.vertices, run.indices);
            for (block, number) in run.blocks.iter().zip(run.first_block..) {
                rings.make(work, block, number);
                let outline = plan.outline(plan.yarn(block.yarn as usize).section as usize);
                let (own, others) = vertices_left.split_at_mut(rings.count * sides);
                vertices(&rings, outline, own);
                vertices_left = others;
                if indexed {
                    let (own, others) = indices_left.split_at_mut(block.quads as usize * pattern.len());
                    indices(block.first_vertex, sides as u32, &pattern, own);
                    indices_left = others;
                }
            }
        });
        caps(work, chunk, out);
    }
}
