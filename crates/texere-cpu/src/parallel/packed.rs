//! Packed vertices: those of a few blocks are made in memory that stays in the core's cache, packed there in lanes, and sent on in whole
//! lines.

use rayon::prelude::*;
use texere_core::{Block, Chunk, PackedVertex, Quantum, Vertex};

use super::lines::Lines;
use super::runs::{MeshRun, vertex_runs};
use super::simd::{Floats, Integers, Job, LINE, Mask, Simd};
use super::vertices::VERTEX;
use super::{InstructionSet, Maker, MeshJob, STREAM_BYTES};
use crate::engine::Work;
use crate::packed::caps;
use crate::pages;

/// Blocks that are made at a time: of six sides some 70 kB, with what they are packed to.
const BLOCKS: usize = 5;

/// Words of a packed vertex.
const WORDS: usize = 3;

/// Words of as many packed vertices as are packed at a time, which are whole lines.
type Group = [[u32; WORDS]; LINE];

pub(super) fn packed(set: InstructionSet, work: &Work, chunk: &Chunk, out: &mut [PackedVertex]) {
    let settings = work.plan.settings();
    let (maker, streams) = (&Maker::new(work), size_of_val(out) >= STREAM_BYTES);
    pages::prefer_huge(out);
    vertex_runs(chunk, BLOCKS, settings.sides, out).into_par_iter().for_each_init(
        || (Vec::new(), Vec::new()),
        |(vertices, groups): &mut (Vec<Vertex>, Vec<Group>), (blocks, out)| {
            vertices.resize(out.len(), Vertex::default());
            groups.resize(out.len().div_ceil(LINE), Group::default());
            let first_vertex = blocks[0].first_vertex;
            let run = MeshRun { blocks, first_vertex, first_index: 0, vertices, indices: &mut [] };
            set.run(MeshJob { maker, table: None, streams: false, run });
            for blocks in blocks.chunk_by(Block::is_before) {
                let rings: u32 = blocks.iter().map(|block| block.rings).sum();
                let first = (blocks[0].first_vertex - first_vertex) as usize;
                let own = first..first + (rings * settings.sides) as usize;
                let (vertices, out) = (&vertices[own.clone()], &mut out[own]);
                set.run(PackJob { vertices, quantum: settings.quantum, groups, out, streams });
            }
        },
    );
    caps(work, chunk, out);
}

/// The way of consecutive vertices to memory.
struct PackJob<'a> {
    vertices: &'a [Vertex],
    quantum: Quantum,
    /// Memory in between, for as many vertices.
    groups: &'a mut [Group],
    out: &'a mut [PackedVertex],
    streams: bool,
}

impl Job for PackJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { vertices, quantum, groups, out, streams } = self;
        let (whole, rest) = vertices.as_chunks::<LINE>();
        for (vertices, group) in whole.iter().zip(&mut *groups) {
            pack(simd, vertices, quantum, group);
        }
        if !rest.is_empty() {
            let mut last = [Vertex::default(); LINE];
            last[..rest.len()].copy_from_slice(rest);
            pack(simd, &last, quantum, &mut groups[whole.len()]);
        }
        let from: &[f32] = &bytemuck::cast_slice(groups)[..WORDS * vertices.len()];
        let Lines { head, lines, tail, .. } = Lines::new(bytemuck::cast_slice_mut(out), streams);
        let (first, from) = from.split_at(head.len());
        head.copy_from_slice(first);
        let (whole, last) = from.as_chunks::<LINE>();
        if streams {
            lines.iter_mut().zip(whole).for_each(|(line, from)| simd.stream(from, line));
            simd.fence();
        } else {
            lines.iter_mut().zip(whole).for_each(|(line, from)| line.0 = *from);
        }
        tail.copy_from_slice(last);
    }
}

/// Packs vertices, a vertex a lane, as [`PackedVertex::pack`] does.
#[cfg_attr(optimized, inline(always))]
fn pack<S: Simd>(simd: S, vertices: &[Vertex; LINE], quantum: Quantum, group: &mut Group) {
    let floats: &[[f32; VERTEX]] = bytemuck::cast_slice(vertices);
    let mut columns = [[0.0; LINE]; VERTEX];
    for (lane, vertex) in floats.iter().enumerate() {
        for (column, value) in columns.iter_mut().zip(vertex) {
            column[lane] = *value;
        }
    }
    let mut words = [[0; LINE]; WORDS];
    for first in (0..LINE).step_by(S::LANES) {
        // No closures here: they would not be compiled for the instructions of the path.
        let mut parts = [simd.splat(0.0); VERTEX];
        for (part, column) in parts.iter_mut().zip(&columns) {
            *part = simd.load(&column[first..]);
        }
        let [x, y, z, normal_x, normal_y, normal_z] = parts;
        let [low, high] = position(simd, [x, y, z], quantum);
        low.store(&mut words[0][first..]);
        high.store(&mut words[1][first..]);
        octahedral(simd, [normal_x, normal_y, normal_z]).store(&mut words[2][first..]);
    }
    for (lane, vertex) in group.iter_mut().enumerate() {
        *vertex = [words[0][lane], words[1][lane], words[2][lane]];
    }
}

/// The words of positions.
#[cfg_attr(optimized, inline(always))]
fn position<S: Simd>(simd: S, [x, y, z]: [S::Floats; 3], quantum: Quantum) -> [S::Integers; 2] {
    let [x, y, z] = [wrapped(simd, x, quantum), wrapped(simd, y, quantum), wrapped(simd, z, quantum)];
    [x + y.shift_left::<21>(), y.shift_right::<11>() + z.shift_left::<10>()]
}

const _: () = assert!(Quantum::BITS == 21);

/// The lowest bits of the whole quanta that are nearest to coordinates.
#[cfg_attr(optimized, inline(always))]
fn wrapped<S: Simd>(simd: S, mm: S::Floats, quantum: Quantum) -> S::Integers {
    let quanta = mm * simd.splat(quantum.per_mm());
    // Of two as near either does: they are the same bits.
    let turns = (quanta * simd.splat(1.0 / Quantum::WRAP) + simd.splat(0.5)).floor();
    let rest = quanta - turns * simd.splat(Quantum::WRAP);
    (rest + simd.splat(PackedVertex::ROUNDING)).to_bits().masked((1 << Quantum::BITS) - 1)
}

/// The words of normals.
#[cfg_attr(optimized, inline(always))]
fn octahedral<S: Simd>(simd: S, [x, y, z]: [S::Floats; 3]) -> S::Integers {
    let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
    let scale = one / (x.abs() + y.abs() + z.abs());
    let (x, y) = (x * scale, y * scale);
    let (beyond_x, beyond_y) = (one - y.abs(), one - x.abs());
    let lower = z.less(zero);
    let steps_x = lower.select(x.less(zero).select(-beyond_x, beyond_x), x);
    let steps_y = lower.select(y.less(zero).select(-beyond_y, beyond_y), y);
    let (steps, rounding) = (simd.splat(PackedVertex::NORMAL_STEPS), simd.splat(PackedVertex::ROUNDING));
    let x = (steps_x * steps + rounding).to_bits().masked(0xffff);
    x + (steps_y * steps + rounding).to_bits().shift_left::<16>()
}
