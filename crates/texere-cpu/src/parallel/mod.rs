//! Equal ranges of rings over all cores: inside a yarn as well as across yarns.

mod block;
mod runs;
mod scan;

use rayon::prelude::*;
use texere_core::{Chunk, MeshMut, PaddedPoints, Plan, Topology, index_pattern};

use crate::caps::caps;
use crate::rolls::Rolls;
use crate::session::{ChunkRings, Stages, Work};
use block::{BlockRings, block_rings};
use runs::{mesh_runs, ring_runs};

#[derive(Debug)]
pub(crate) struct Parallel;

impl Stages for Parallel {
    const FUSED: bool = true;

    fn scan(plan: &Plan, points: &PaddedPoints) -> Rolls {
        scan::scan(plan, points)
    }

    fn trajectory(work: &Work, chunk: &Chunk, out: &mut ChunkRings) {
        ring_runs(chunk, out).into_par_iter().for_each(|run| {
            let mut block_space = BlockRings::default();
            let mut done = 0;
            for (block, number) in run.blocks.iter().zip(run.first_block..) {
                block_rings(work, block, number, &mut block_space);
                let count = block.rings as usize;
                run.rings[done..done + count].copy_from_slice(&block_space.rings[..count]);
                run.slopes[done..done + count].copy_from_slice(&block_space.slopes[..count]);
                done += count;
            }
        });
    }

    fn mesh(work: &Work, chunk: &Chunk, _rings: &ChunkRings, mut out: MeshMut<'_>) {
        let plan = &work.plan;
        let sides = plan.settings().sides as usize;
        let indexed = plan.settings().topology == Topology::Indexed;
        let pattern = index_pattern(plan.settings().sides);
        mesh_runs(chunk, sides, indexed, &mut out).into_par_iter().for_each(|run| {
            let mut block_space = BlockRings::default();
            let (mut vertices, mut indices) = (run.vertices, run.indices);
            for (block, number) in run.blocks.iter().zip(run.first_block..) {
                block_rings(work, block, number, &mut block_space);
                let outline = plan.outline(plan.yarn(block.yarn as usize).section as usize);
                let (own, others) = vertices.split_at_mut(block.rings as usize * sides);
                vertices = others;
                block_space.vertices(block.rings as usize, outline, own);
                if indexed {
                    let (own, others) = indices.split_at_mut(block.quads as usize * pattern.len());
                    indices = others;
                    block::indices(block.first_vertex, sides as u32, &pattern, own);
                }
            }
        });
        caps(work, chunk, out);
    }
}
