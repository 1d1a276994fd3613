//! Equal ranges of rings over all cores: inside a yarn as well as across yarns.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod path;
mod rings;
mod runs;
mod scan;
mod turns;
mod vector;
mod vertices;

use rayon::prelude::*;
use texere_core::{BLOCK_RINGS, Chunk, MeshMut, PaddedPoints, Plan, Topology, Vertex};

use crate::caps::caps;
use crate::rolls::Rolls;
use crate::session::{ChunkRings, Stages, Work};
pub(crate) use path::Path;
use rings::BlockRings;
use runs::{MeshRun, mesh_runs, ring_runs};
use vector::{Portable, Vector};
use vertices::{IndexTable, OVERHANG, vertices};

#[derive(Debug)]
pub(crate) struct Parallel;

/// What is the same for all runs of a mesh.
pub(crate) struct MeshJob<'a> {
    work: &'a Work,
    indices: Option<IndexTable>,
    /// Whether the output is too large for any cache, so that stores had better go past them.
    streams: bool,
}

/// Bytes of output from which on stores go past the caches: as much as the last cache of a large processor holds.
const STREAM_BYTES: usize = 32 << 20;

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
        let (settings, path) = (work.plan.settings(), Path::detect());
        let indexed = settings.topology == Topology::Indexed;
        let bytes = size_of_val(out.vertices) + size_of_val(out.indices);
        let indices = indexed.then(|| IndexTable::new(settings.sides));
        let job = MeshJob { work, indices, streams: bytes >= STREAM_BYTES };
        mesh_runs(chunk, settings.sides as usize, indexed, &mut out)
            .into_par_iter()
            .for_each(|run| path.mesh_run(&job, run));
        caps(work, chunk, out);
    }
}

/// Both stages for a run of blocks.
#[inline(always)]
fn mesh_run<V: Vector>(job: &MeshJob<'_>, run: MeshRun<'_>) {
    let plan = &job.work.plan;
    let sides = plan.settings().sides as usize;
    let floats = sides * (size_of::<Vertex>() / size_of::<f32>());
    let mut scratch = vec![0.0; BLOCK_RINGS as usize * floats + OVERHANG];
    let mut rings = BlockRings::new();
    let mut vertices_left: &mut [f32] = bytemuck::cast_slice_mut(run.vertices);
    let mut indices_left = run.indices;
    for (block, number) in run.blocks.iter().zip(run.first_block..) {
        rings.make(job.work, block, number);
        let outline = plan.outline(plan.yarn(block.yarn as usize).section as usize);
        vertices::<V>(&rings, outline, &mut scratch);
        let (own, others) = vertices_left.split_at_mut(rings.count * floats);
        if job.streams {
            V::stream(&scratch[..own.len()], own);
        } else {
            own.copy_from_slice(&scratch[..own.len()]);
        }
        vertices_left = others;
        if let Some(table) = &job.indices {
            let (own, others) = indices_left.split_at_mut(block.quads as usize * sides * 6);
            if job.streams {
                table.write::<V>(block.first_vertex, own);
            } else {
                table.write::<Portable>(block.first_vertex, own);
            }
            indices_left = others;
        }
    }
    V::fence();
}
