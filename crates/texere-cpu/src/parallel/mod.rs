//! Equal ranges of rings over all cores: inside a yarn as well as across yarns.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod lines;
mod path;
mod planar;
mod portable;
mod rings;
mod runs;
mod scan;
mod spline;
mod tiles;
mod turns;
mod vector;
mod vertices;

use rayon::prelude::*;
use texere_core::{
    BLOCK_RINGS, BackendError, Block, Chunk, MeshMut, PaddedPoints, Plan, Ring, Topology, Vertex,
};

use crate::caps::caps;
use crate::engine::{ChunkRings, Stages, Work};
use crate::pages;
use crate::rolls::Rolls;
use lines::{IndexLines, IndexTable, Lines, VertexLines};
use path::Job;
pub(crate) use path::Path;
use rings::{Rings, Source, Stretch, Walk};
use runs::{MeshRun, RingRun, mesh_runs, ring_runs, take};
use spline::Places;
use tiles::TileLines;
use vector::{LANES_MAX, LINE, Line, Vector};
use vertices::{Surface, VERTEX};

/// All cores, each with the vectors of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parallel(pub(crate) Path);

/// Bytes of output from which on stores go past the caches: as much as the last cache of a large processor holds.
const STREAM_BYTES: usize = 32 << 20;

impl Stages for Parallel {
    const FUSED: bool = true;

    fn scan(self, plan: &Plan, points: &PaddedPoints, rolls: &mut Rolls) -> Result<(), BackendError> {
        scan::scan(self.0, plan, points, rolls)
    }

    fn trajectory(self, work: &Work, chunk: &Chunk, out: &mut ChunkRings) {
        let (path, maker) = (self.0, Maker::new(work));
        ring_runs(chunk, out).into_par_iter().for_each(|run| path.run(RingJob { maker: &maker, run }));
    }

    fn mesh(self, work: &Work, chunk: &Chunk, _rings: &ChunkRings, mut out: MeshMut<'_>) {
        let (settings, path) = (work.plan.settings(), self.0);
        let indexed = settings.topology == Topology::Indexed;
        pages::prefer_huge(out.vertices);
        pages::prefer_huge(out.indices);
        let streams = size_of_val(out.vertices) + size_of_val(out.indices) >= STREAM_BYTES;
        let (maker, table) = (Maker::new(work), indexed.then(|| IndexTable::new(settings.sides)));
        let (maker, table) = (&maker, table.as_ref());
        mesh_runs(chunk, settings.sides as usize, indexed, &mut out)
            .into_par_iter()
            .for_each(|run| path.run(MeshJob { maker, table, streams, run }));
        caps(work, chunk, out);
    }
}

/// What is the same for all runs.
struct Maker<'a> {
    work: &'a Work,
    places: Places,
}

impl<'a> Maker<'a> {
    fn new(work: &'a Work) -> Self {
        Self { work, places: Places::new(&work.plan) }
    }

    /// Calls `take` with the rings of `blocks`, which are one yarn's and follow each other, the first of them number `number`
    /// among all of the plan: a vector of rings at a time, with their rolls, and how many of them there are.
    #[cfg_attr(optimized, inline(always))]
    fn rings<V: Vector>(&self, blocks: &[Block], number: u64, sink: &mut impl Sink) {
        let Work { plan, points, rolls } = self.work;
        let source = Source { plan, points, places: &self.places };
        let (yarn, first) = (blocks[0].yarn as usize, blocks[0].first_ring);
        let stretch = Stretch { yarn, first, count: blocks.iter().map(|block| block.rings).sum() };
        let mut walk = Walk::<V>::new(source, stretch);
        if plan.settings().frame.is_level(plan.twist_turns(yarn)) {
            while let count @ 1.. = walk.left() {
                sink.take(&walk.next(), V::splat_whole(0), count);
            }
        } else {
            while let count @ 1.. = walk.left() {
                let block = number + u64::from(walk.done / BLOCK_RINGS);
                let roll = turns::rolls::<V>(plan, rolls, yarn, first + walk.done, block);
                sink.take(&walk.next().turned(roll), roll, count);
            }
        }
    }
}

/// What becomes of rings.
trait Sink {
    /// Takes the first `count` rings of a vector. It must be inlined, so that it is compiled for the instructions of its
    /// path.
    fn take<V: Vector>(&mut self, rings: &Rings<V>, roll: V::Whole, count: usize);
}

/// Stage 1 for a run of blocks.
struct RingJob<'a> {
    maker: &'a Maker<'a>,
    run: RingRun<'a>,
}

impl Job for RingJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<V: Vector>(self) {
        let RingRun { blocks, first_block, rings, slopes } = self.run;
        let (mut number, mut sink) = (first_block, RingSink { rings, slopes });
        for blocks in blocks.chunk_by(|a, b| a.yarn == b.yarn) {
            self.maker.rings::<V>(blocks, number, &mut sink);
            number += blocks.len() as u64;
        }
    }
}

/// Where a trajectory goes.
struct RingSink<'a> {
    rings: &'a mut [Ring],
    slopes: &'a mut [f32],
}

impl Sink for RingSink<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn take<V: Vector>(&mut self, rings: &Rings<V>, roll: V::Whole, count: usize) {
        let mut out = [Ring::default(); LANES_MAX];
        rings.store(roll, &mut out);
        take(&mut self.rings, count).copy_from_slice(&out[..count]);
        let mut slopes = [0.0; LANES_MAX];
        rings.slope.store(&mut slopes);
        take(&mut self.slopes, count).copy_from_slice(&slopes[..count]);
    }
}

/// Both stages for a run of blocks.
struct MeshJob<'a> {
    maker: &'a Maker<'a>,
    /// What indices are made from, if there are any.
    table: Option<&'a IndexTable>,
    /// Whether the output is too large for any cache, so that stores had better go past them.
    streams: bool,
    run: MeshRun<'a>,
}

impl Job for MeshJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<V: Vector>(self) {
        let Self { maker, table, streams, run } = self;
        let plan = &maker.work.plan;
        let sides = plan.settings().sides as usize;
        let floats = sides * VERTEX;
        let room = VertexLines::scratch(floats).max(TileLines::scratch(floats));
        let mut scratch = vec![Line([0.0; LINE]); room];
        let (mut vertices_left, mut indices_left) = (run.vertices, run.indices);
        let mut number = run.first_block;
        for blocks in run.blocks.chunk_by(|a, b| a.yarn == b.yarn) {
            let rings: usize = blocks.iter().map(|block| block.rings as usize).sum();
            let quads: usize = blocks.iter().map(|block| block.quads as usize).sum();
            let own: &mut [Vertex] = take(&mut vertices_left, rings * sides);
            let out = Lines::new(bytemuck::cast_slice_mut(own), streams);
            let vertices = if TileLines::fit(&out, floats) {
                Way::Tiles(TileLines::new(out, floats, &mut scratch))
            } else {
                Way::Scratch(VertexLines::new(out, &mut scratch))
            };
            let indices = table.map(|table| {
                let own = take(&mut indices_left, quads * sides * 6);
                IndexLines::new(own, streams, table, blocks[0].first_vertex)
            });
            let section = plan.yarn(blocks[0].yarn as usize).section as usize;
            let surface = Surface::new(plan.outline(section));
            let mut sink = MeshSink { surface, floats, vertices, indices };
            maker.rings::<V>(blocks, number, &mut sink);
            match sink.vertices {
                Way::Tiles(tiles) => tiles.finish::<V>(),
                Way::Scratch(lines) => lines.finish::<V>(),
            }
            if let Some(indices) = sink.indices {
                indices.finish::<V>();
            }
            number += blocks.len() as u64;
        }
        V::fence();
    }
}

/// Where a mesh goes.
struct MeshSink<'a> {
    surface: Surface<'a>,
    /// Floats of the vertices of a ring, as many as it has indices.
    floats: usize,
    vertices: Way<'a>,
    indices: Option<IndexLines<'a>>,
}

impl Sink for MeshSink<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn take<V: Vector>(&mut self, rings: &Rings<V>, _roll: V::Whole, count: usize) {
        match &mut self.vertices {
            Way::Tiles(tiles) => {
                self.surface.write::<V, true>(rings, tiles.next::<V>());
                tiles.send::<V>(count);
            }
            Way::Scratch(lines) => {
                lines.send_waiting::<V>();
                self.surface.write::<V, false>(rings, lines.next());
                lines.send::<V>(count * self.floats);
            }
        }
        if let Some(indices) = &mut self.indices {
            indices.send::<V>(V::LANES * self.floats / LINE);
        }
    }
}

/// How vertices get to their lines.
enum Way<'a> {
    Tiles(TileLines<'a>),
    Scratch(VertexLines<'a>),
}
