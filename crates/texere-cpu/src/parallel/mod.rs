//! Equal ranges of rings over all cores: inside a yarn as well as across yarns.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod instruction_set;
mod lines;
mod planar;
mod portable;
mod rings;
mod runs;
mod scan;
mod simd;
mod spline;
mod tiles;
mod turns;
mod vertices;

use rayon::prelude::*;
use texere_core::{
    BLOCK_RINGS, BackendError, Block, Chunk, MeshMut, PaddedPoints, Plan, Ring, Topology, Vertex,
};

use crate::caps::caps;
use crate::engine::{Executor, Work};
use crate::pages;
use crate::rolls::Rolls;
use instruction_set::InstructionSet;
use lines::{IndexLines, IndexTable, Lines, VertexLines};
use rings::{Rings, Source, Stretch, Walk};
use runs::{MeshRun, RingRun, mesh_runs, ring_runs, take};
use simd::{Job, LANES_MAX, LINE, Line, Simd};
use spline::Seats;
use tiles::TileLines;
use vertices::{Surface, VERTEX};

/// All cores, each with the same set of vector instructions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parallel(InstructionSet);

/// Bytes of output from which on stores go past the caches: as much as the last cache of a large processor holds.
const STREAM_BYTES: usize = 32 << 20;

impl Parallel {
    /// With the vectors that `TEXERE_SIMD` names or, without it, the widest ones that the processor has.
    ///
    /// **Errors**: [`BackendError::NoInstructionSet`] where it has none of that name.
    pub(crate) fn new() -> Result<Self, BackendError> {
        InstructionSet::chosen().map(Self)
    }

    /// One for each kind of vectors that the processor has, the widest last.
    pub(crate) fn each() -> impl Iterator<Item = Self> {
        InstructionSet::available().into_iter().map(Self)
    }

    /// What the vectors are called.
    pub(crate) const fn vectors(self) -> &'static str {
        self.0.name()
    }
}

impl Executor for Parallel {
    const FUSED: bool = true;

    fn scan(self, plan: &Plan, points: &PaddedPoints, rolls: &mut Rolls) -> Result<(), BackendError> {
        scan::scan(self.0, plan, points, rolls)
    }

    fn trajectory(self, work: &Work, chunk: &Chunk, out: &mut [Ring]) {
        let (set, maker) = (self.0, Maker::new(work));
        ring_runs(chunk, out).into_par_iter().for_each(|run| set.run(RingJob { maker: &maker, run }));
    }

    fn mesh(self, work: &Work, chunk: &Chunk, _rings: &[Ring], mut out: MeshMut<'_>) {
        let (settings, set) = (work.plan.settings(), self.0);
        let indexed = settings.topology == Topology::Indexed;
        pages::prefer_huge(out.vertices);
        pages::prefer_huge(out.indices);
        let streams = size_of_val(out.vertices) + size_of_val(out.indices) >= STREAM_BYTES;
        let (maker, table) = (Maker::new(work), indexed.then(|| IndexTable::new(settings.sides)));
        let (maker, table) = (&maker, table.as_ref());
        mesh_runs(chunk, settings.sides as usize, indexed, &mut out)
            .into_par_iter()
            .for_each(|run| set.run(MeshJob { maker, table, streams, run }));
        caps(work, chunk, out);
    }
}

/// What is the same for all runs.
struct Maker<'a> {
    work: &'a Work,
    seats: Vec<Seats>,
    /// One for each section.
    surfaces: Vec<Surface<'a>>,
}

impl<'a> Maker<'a> {
    fn new(work: &'a Work) -> Self {
        let plan = &work.plan;
        let sections = 0..plan.layout().sections().len();
        let surfaces = sections.map(|section| Surface::new(plan.outline(section))).collect();
        Self { work, seats: Seats::at_each_place(plan), surfaces }
    }

    /// Calls `take` with the rings of `blocks`, which are one yarn's and follow each other, the first of them number `number`
    /// among all of the plan: a vector of rings at a time, with their rolls, and how many of them there are.
    #[cfg_attr(optimized, inline(always))]
    fn rings<S: Simd>(&self, simd: S, blocks: &[Block], number: u64, sink: &mut impl Sink) {
        let Work { plan, points, .. } = self.work;
        let source = Source { plan, points, seats: &self.seats };
        let (yarn, first) = (blocks[0].yarn as usize, blocks[0].first_ring);
        let stretch = Stretch { yarn, first, count: blocks.iter().map(|block| block.rings).sum() };
        if source.all_round(stretch) {
            self.along::<S, false>(simd, source, stretch, number, sink);
        } else {
            self.along::<S, true>(simd, source, stretch, number, sink);
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn along<S: Simd, const FLATTENED: bool>(
        &self,
        simd: S,
        source: Source<'_>,
        stretch: Stretch,
        number: u64,
        sink: &mut impl Sink,
    ) {
        let (Work { plan, rolls, .. }, Stretch { yarn, first, .. }) = (self.work, stretch);
        let mut walk = Walk::<S, FLATTENED>::new(simd, source, stretch);
        if plan.settings().frame.is_level(plan.twist_turns(yarn)) {
            while let count @ 1.. = walk.left() {
                sink.take(simd, &walk.next(), simd.splat_integer(0), count);
            }
        } else {
            while let count @ 1.. = walk.left() {
                let block = number + u64::from(walk.done / BLOCK_RINGS);
                let roll = turns::rolls(simd, plan, rolls, yarn, first + walk.done, block);
                sink.take(simd, &walk.next().turned(simd, roll), roll, count);
            }
        }
    }
}

/// What becomes of rings.
trait Sink {
    /// Takes the first `count` rings of a vector. It must be inlined, so that it is compiled for the instructions of its
    /// path.
    fn take<S: Simd>(&mut self, simd: S, rings: &Rings<S>, roll: S::Integers, count: usize);
}

/// Stage 1 for a run of blocks.
struct RingJob<'a> {
    maker: &'a Maker<'a>,
    run: RingRun<'a>,
}

impl Job for RingJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let RingRun { blocks, first_block, rings } = self.run;
        let (mut number, mut sink) = (first_block, RingSink { rings });
        for blocks in blocks.chunk_by(|a, b| a.yarn == b.yarn) {
            self.maker.rings(simd, blocks, number, &mut sink);
            number += blocks.len() as u64;
        }
    }
}

/// Where a trajectory goes.
struct RingSink<'a> {
    rings: &'a mut [Ring],
}

impl Sink for RingSink<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn take<S: Simd>(&mut self, simd: S, rings: &Rings<S>, roll: S::Integers, count: usize) {
        let mut out = [Ring::default(); LANES_MAX];
        rings.store(simd, roll, &mut out);
        take(&mut self.rings, count).copy_from_slice(&out[..count]);
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
    fn run<S: Simd>(self, simd: S) {
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
            let surface = maker.surfaces[section];
            let mut sink = MeshSink { surface, floats, vertices, indices };
            maker.rings(simd, blocks, number, &mut sink);
            match sink.vertices {
                Way::Tiles(tiles) => tiles.finish(simd),
                Way::Scratch(lines) => lines.finish(simd),
            }
            if let Some(indices) = sink.indices {
                indices.finish(simd);
            }
            number += blocks.len() as u64;
        }
        simd.fence();
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
    fn take<S: Simd>(&mut self, simd: S, rings: &Rings<S>, _roll: S::Integers, count: usize) {
        match &mut self.vertices {
            Way::Tiles(tiles) => {
                self.surface.write::<S, true>(simd, rings, tiles.next(simd));
                tiles.send(simd, count);
            }
            Way::Scratch(lines) => {
                lines.send_waiting(simd);
                self.surface.write::<S, false>(simd, rings, lines.next());
                lines.send(simd, count * self.floats);
            }
        }
        if let Some(indices) = &mut self.indices {
            indices.send(simd, S::LANES * self.floats / LINE);
        }
    }
}

/// How vertices get to their lines.
enum Way<'a> {
    Tiles(TileLines<'a>),
    Scratch(VertexLines<'a>),
}
