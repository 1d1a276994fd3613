//! Equal ranges of rings over all cores: inside a yarn as well as across yarns.

mod attributes;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod crossings;
mod instruction_set;
mod leaning;
mod lines;
mod packed;
mod planar;
mod portable;
mod rings;
mod runs;
mod scan;
mod settling;

mod simd;
mod spline;
mod stances;
mod tiles;
mod turns;
mod vertices;

use std::ops::Range;

use rayon::prelude::*;
use texere_core::backend::{BLOCK_RINGS, Block, Chunk, MeshMut, PaddedPoints, Plan};
use texere_core::definitions::Ring;
use texere_core::{ArcLength, Attribute, BackendError, PackedVertex, Topology, Vertex};

use crate::caps::caps;
use crate::engine::{Executor, Work};
use crate::pages;
use crate::rolls::{Rolls, block_number};
pub(crate) use crossings::ParallelCrossings;
use instruction_set::InstructionSet;
use lines::{IndexLines, IndexTable, Lines, VertexLines};
use rings::{Rings, Source, Stretch, Walk};
use runs::{MeshRun, RingRun, mesh_runs, ring_runs, take};
pub(crate) use settling::ParallelSettler;
use simd::{Job, LANES_MAX, LINE, Line, Simd};
use spline::Seats;
use tiles::TileLines;
use vertices::{Surface, VERTEX};

/// All cores, each with the same set of vector instructions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parallel(InstructionSet);

/// Bytes of output from which on stores go past the caches: as much as the last cache of a large
/// processor holds.
const STREAM_BYTES: usize = 32 << 20;

impl Parallel {
    /// With the vectors that `TEXERE_SIMD` names or, without it, the widest ones that the processor
    /// has.
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

    fn scan(
        self,
        plan: &Plan,
        points: &PaddedPoints,
        rolls: &mut Rolls,
        yarns: Range<usize>,
    ) -> Result<(), BackendError> {
        scan::scan(self.0, plan, points, rolls, yarns)
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
        mesh_runs(chunk, settings.sides, indexed, &mut out)
            .into_par_iter()
            .for_each(|run| set.run(MeshJob { maker, table, streams, run }));
        caps(work, chunk, out);
    }

    fn packed(self, work: &Work, chunk: &Chunk, _rings: &[Ring], out: &mut [PackedVertex]) {
        packed::packed(self.0, work, chunk, out);
    }

    fn measure(self, plan: &Plan, points: &PaddedPoints, lengths: &mut [ArcLength], yarns: Range<usize>) {
        attributes::measure(plan, points, lengths, yarns);
    }

    fn attributes(self, work: &Work, chunk: &Chunk, out: &mut [Attribute]) {
        attributes::attributes(work, chunk, out);
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

    /// Makes `piece`, a function of its own if any of its rings may be flattened: so the loops of
    /// round yarns stay small.
    #[cfg_attr(optimized, inline(always))]
    fn make<S: Simd>(&self, simd: S, piece: impl Piece, blocks: &[Block]) {
        if self.source().all_round(Stretch::of(blocks)) {
            piece.make::<S, false>(simd);
        } else {
            simd.run(Flattened(piece));
        }
    }

    /// Whether the yarn leans that `blocks` are of.
    fn leans(&self, blocks: &[Block]) -> bool {
        self.work.plan.leans(blocks[0].yarn as usize).is_some()
    }

    fn source(&self) -> Source<'_> {
        Source { plan: &self.work.plan, points: &self.work.points, seats: &self.seats }
    }

    /// Gives `sink` the rings of `blocks`, which are one yarn's and follow each other: a vector of
    /// rings at a time, with their rolls, and how many of them there are. Without `FLATTENED` all
    /// are taken for round.
    #[cfg_attr(optimized, inline(always))]
    fn rings<S: Simd, const FLATTENED: bool>(&self, simd: S, blocks: &[Block], sink: &mut impl Sink) {
        let (Work { plan, rolls, .. }, stretch) = (self.work, Stretch::of(blocks));
        let mut walk = Walk::<S, FLATTENED>::new(simd, self.source(), stretch);
        let rolled = plan.turns(stretch.yarn);
        let number = block_number(plan, &blocks[0]);
        while let count @ 1.. = walk.left() {
            let (done, mut rings, mut roll) = (walk.done, walk.next(), simd.splat_integer(0));
            if rolled {
                let block = number + u64::from(done / BLOCK_RINGS);
                roll = turns::rolls(simd, plan, rolls, stretch.yarn, stretch.first + done, block);
                rings = rings.turned(simd, roll);
            }
            sink.take::<S, FLATTENED>(simd, &rings, roll, rolled, count);
        }
    }
}

/// What is made of consecutive blocks of one yarn.
trait Piece {
    /// Makes it. It must be inlined, so that it is compiled for the instructions of `simd`.
    fn make<S: Simd, const FLATTENED: bool>(self, simd: S);
}

/// A piece of a yarn that is flattened somewhere.
struct Flattened<P>(P);

impl<P: Piece> Job for Flattened<P> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        self.0.make::<S, true>(simd);
    }
}

/// What becomes of rings.
trait Sink {
    /// Takes the first `count` rings of a vector, whose rolls are all zero unless they are
    /// `rolled`. It must be inlined, so that it is compiled for the instructions of its path.
    fn take<S: Simd, const FLATTENED: bool>(
        &mut self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        roll: S::Integers,
        rolled: bool,
        count: usize,
    );
}

/// Stage 1 for a run of blocks.
struct RingJob<'a> {
    maker: &'a Maker<'a>,
    run: RingRun<'a>,
}

impl Job for RingJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { maker, run: RingRun { blocks, first_ring, rings } } = self;
        for blocks in blocks.chunk_by(|block, next| block.is_before(next)) {
            let count: usize = blocks.iter().map(|block| block.rings as usize).sum();
            let rings = &mut rings[(blocks[0].chunk_ring - first_ring) as usize..][..count];
            if maker.leans(blocks) {
                leaning::rings(maker.work, blocks, rings);
                continue;
            }
            maker.make(simd, RingPiece { maker, blocks, sink: RingSink { rings } }, blocks);
        }
    }
}

struct RingPiece<'a> {
    maker: &'a Maker<'a>,
    blocks: &'a [Block],
    sink: RingSink<'a>,
}

impl Piece for RingPiece<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn make<S: Simd, const FLATTENED: bool>(mut self, simd: S) {
        self.maker.rings::<S, FLATTENED>(simd, self.blocks, &mut self.sink);
    }
}

/// Where a trajectory goes.
struct RingSink<'a> {
    rings: &'a mut [Ring],
}

impl Sink for RingSink<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn take<S: Simd, const FLATTENED: bool>(
        &mut self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        roll: S::Integers,
        _rolled: bool,
        count: usize,
    ) {
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
        let sides = maker.work.plan.settings().sides as usize;
        let floats = sides * VERTEX;
        let room = VertexLines::scratch(floats).max(TileLines::scratch(floats));
        let mut scratch = vec![Line([0.0; LINE]); room];
        for blocks in run.blocks.chunk_by(|block, next| block.is_before(next)) {
            let rings: usize = blocks.iter().map(|block| block.rings as usize).sum();
            let quads: usize = blocks.iter().map(|block| block.quads as usize).sum();
            let first = (blocks[0].first_vertex - run.first_vertex) as usize;
            let own: &mut [Vertex] = &mut run.vertices[first..][..rings * sides];
            let own_indices = table.map(|_| {
                let first = (blocks[0].first_index - run.first_index) as usize;
                &mut run.indices[first..][..quads * sides * 6]
            });
            if maker.leans(blocks) {
                leaning::mesh(maker.work, blocks, own, own_indices.unwrap_or_default());
                continue;
            }
            let out = Lines::new(bytemuck::cast_slice_mut(own), streams);
            let indices = table
                .zip(own_indices)
                .map(|(table, own)| IndexLines::new(own, streams, table, blocks[0].first_vertex));
            let scratch = &mut scratch[..];
            maker.make(simd, MeshPiece { maker, blocks, floats, out, scratch, indices }, blocks);
        }
        simd.fence();
    }
}

struct MeshPiece<'a> {
    maker: &'a Maker<'a>,
    blocks: &'a [Block],
    /// Floats of the vertices of a ring, as many as it has indices.
    floats: usize,
    out: Lines<'a>,
    scratch: &'a mut [Line],
    indices: Option<IndexLines<'a>>,
}

impl Piece for MeshPiece<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn make<S: Simd, const FLATTENED: bool>(self, simd: S) {
        let Self { maker, blocks, floats, out, scratch, indices } = self;
        let vertices = if TileLines::fit(&out, floats) {
            Way::Tiles(TileLines::new(out, floats, scratch))
        } else {
            Way::Scratch(VertexLines::new(out, scratch))
        };
        let section = maker.work.plan.yarn(blocks[0].yarn as usize).section as usize;
        let mut sink = MeshSink { surface: &maker.surfaces[section], floats, vertices, indices };
        maker.rings::<S, FLATTENED>(simd, blocks, &mut sink);
        match sink.vertices {
            Way::Tiles(tiles) => tiles.finish(simd),
            Way::Scratch(lines) => lines.finish(simd),
        }
        if let Some(indices) = sink.indices {
            indices.finish(simd);
        }
    }
}

/// Where a mesh goes.
struct MeshSink<'a> {
    surface: &'a Surface<'a>,
    /// Floats of the vertices of a ring, as many as it has indices.
    floats: usize,
    vertices: Way<'a>,
    indices: Option<IndexLines<'a>>,
}

impl Sink for MeshSink<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn take<S: Simd, const FLATTENED: bool>(
        &mut self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        _roll: S::Integers,
        rolled: bool,
        count: usize,
    ) {
        match &mut self.vertices {
            Way::Tiles(tiles) => {
                self.surface.write::<S, FLATTENED, true>(simd, rings, rolled, tiles.next(simd));
                tiles.send(simd, count);
            }
            Way::Scratch(lines) => {
                lines.send_waiting(simd);
                self.surface.write::<S, FLATTENED, false>(simd, rings, rolled, lines.next());
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
