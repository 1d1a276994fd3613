//! Stage 1 (rings) and stage 2 (vertices and indices) in one loop. Rings stay in registers and are
//! never stored. Yarns whose outlines lean are made in `leaning.rs`.

use rayon::prelude::*;
use texere_core::backend::{Block, Chunk, MeshMut};
use texere_core::{Topology, Vertex};

use super::instruction_set::InstructionSet;
use super::leaning;
use super::lines::{IndexLines, IndexTable, Lines, VertexLines};
use super::maker::{Maker, Piece, Sink};
use super::rings::Rings;
use super::runs::{MeshRun, mesh_runs};
use super::simd::{Job, LINE, Line, Simd};
use super::stances::VERTEX;
use super::tiles::TileLines;
use super::vertices::Surface;
use crate::caps::caps;
use crate::engine::Work;
use crate::pages;

/// Outputs of at least this many bytes are stored past the caches. The limit is the size of a large
/// processor's last cache.
pub(super) const STREAM_BYTES: u64 = 32 << 20;

pub(super) fn mesh(set: InstructionSet, work: &Work, chunk: &Chunk, mut out: MeshMut<'_>, bytes: u64) {
    let settings = work.plan.settings();
    let indexed = settings.topology == Topology::Indexed;
    pages::prefer_huge(out.vertices);
    pages::prefer_huge(out.indices);
    let streams = bytes >= STREAM_BYTES;
    let (maker, table) = (Maker::new(work), indexed.then(|| IndexTable::new(settings.sides)));
    let (maker, table) = (&maker, table.as_ref());
    mesh_runs(chunk, settings.sides, indexed, &mut out)
        .into_par_iter()
        // A core that is done takes single runs from the others. With the groups that rayon makes
        // by itself, cores waited for the last group: a mesh took 4 % longer on sixteen cores, 6 %
        // on two.
        .with_max_len(1)
        .for_each(|run| set.run(MeshJob { maker, table, streams, run }));
    caps(work, chunk, out);
}

/// Makes the rings and the mesh of a run of blocks.
pub(super) struct MeshJob<'a> {
    pub(super) maker: &'a Maker<'a>,
    /// The pattern of indices; none if the topology has no indices.
    pub(super) table: Option<&'a IndexTable>,
    /// Whether stores go past the caches, because the output is too large for them.
    pub(super) streams: bool,
    pub(super) run: MeshRun<'a>,
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
    /// The number of floats of a ring's vertices. The ring has as many indices.
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

/// The sink that writes a mesh.
struct MeshSink<'a> {
    surface: &'a Surface<'a>,
    /// The number of floats of a ring's vertices. The ring has as many indices.
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

/// The scratch memory through which vertices get to the lines of the output.
enum Way<'a> {
    Tiles(TileLines<'a>),
    Scratch(VertexLines<'a>),
}
