//! Packed vertices. The vertices of a few blocks are made in memory that stays in the core's cache.
//! They are packed in lanes, and then sent to the output in whole lines.

use rayon::prelude::*;
use texere_core::backend::{Block, Chunk};
use texere_core::{PackedVertex, Quantum, Vertex};

use super::instruction_set::InstructionSet;
use super::lines::Lines;
use super::maker::Maker;
use super::mesh::{MeshJob, STREAM_BYTES};
use super::runs::{MeshRun, vertex_runs};
use super::simd::{Floats, IN_TURN, Integers, Job, LANES_MAX, LINE, Mask, Simd};
use crate::engine::Work;
use crate::packed::caps;
use crate::pages;

/// The number of blocks that are made at a time. With six sides their vertices and their packed
/// vertices together take some 70 kB.
const BLOCKS: usize = 5;

/// The number of words of a packed vertex.
const WORDS: usize = 3;

/// Two vertices, whose floats are three vectors of four.
type Pair = [[f32; 4]; 3];

pub(super) fn packed(set: InstructionSet, work: &Work, chunk: &Chunk, out: &mut [PackedVertex]) {
    let settings = work.plan.settings();
    let (maker, streams) = (&Maker::new(work), size_of_val(out) as u64 >= STREAM_BYTES);
    pages::prefer_huge(out);
    vertex_runs(chunk, BLOCKS, settings.sides, out).into_par_iter().for_each_init(
        || (Vec::new(), Vec::new()),
        |(vertices, words): &mut (Vec<Vertex>, Vec<f32>), (blocks, out)| {
            vertices.resize(out.len(), Vertex::default());
            words.resize(WORDS * out.len(), 0.0);
            let first_vertex = blocks[0].first_vertex;
            let run = MeshRun { blocks, first_vertex, first_index: 0, vertices, indices: &mut [] };
            set.run(MeshJob { maker, table: None, streams: false, run });
            for blocks in blocks.chunk_by(Block::is_before) {
                let rings: u32 = blocks.iter().map(|block| block.rings).sum();
                let first = (blocks[0].first_vertex - first_vertex) as usize;
                let own = first..first + (rings * settings.sides) as usize;
                let (vertices, out) = (&vertices[own.clone()], &mut out[own]);
                set.run(PackJob { vertices, quantum: settings.quantum, words, out, streams });
            }
        },
    );
    caps(work, chunk, out);
}

/// Packs consecutive vertices and writes them to the output.
struct PackJob<'a> {
    vertices: &'a [Vertex],
    quantum: Quantum,
    /// Memory for the words of the packed vertices. Each word is held as the float that has the
    /// same bits.
    words: &'a mut [f32],
    out: &'a mut [PackedVertex],
    streams: bool,
}

impl Job for PackJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { vertices, quantum, words, out, streams } = self;
        let words = &mut words[..WORDS * vertices.len()];
        let (pairs, _) = vertices.as_chunks::<2>();
        let pairs: &[Pair] = bytemuck::cast_slice(pairs);
        let whole = pairs.len() / S::LANES * S::LANES;
        let (packed, rest) = words.split_at_mut(2 * WORDS * whole);
        let vectors = pairs[..whole].chunks_exact(S::LANES);
        for (pairs, words) in vectors.zip(packed.chunks_exact_mut(2 * WORDS * S::LANES)) {
            pack(simd, pairs, quantum, words);
        }
        // Fewer pairs than a vector holds are left, and perhaps one single vertex.
        let mut last = [Vertex::default(); 2 * LANES_MAX];
        last[..rest.len() / WORDS].copy_from_slice(&vertices[2 * whole..]);
        let mut room = [0.0; 2 * WORDS * LANES_MAX];
        let (pairs, _) = last.as_chunks::<2>();
        pack(simd, bytemuck::cast_slice(pairs), quantum, &mut room);
        rest.copy_from_slice(&room[..rest.len()]);
        let from: &[f32] = words;
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

/// Packs a vector of pairs, one pair in each lane, as [`PackedVertex::pack`] does.
#[cfg_attr(optimized, inline(always))]
fn pack<S: Simd>(simd: S, pairs: &[Pair], quantum: Quantum, words: &mut [f32]) {
    // No closures here: they would not be compiled for the instructions of `simd`.
    let [x, y, z, normal_x] = simd.rows(pairs, &IN_TURN, 0);
    let [normal_y, normal_z, next_x, next_y] = simd.rows(pairs, &IN_TURN, 1);
    let [next_z, next_normal_x, next_normal_y, next_normal_z] = simd.rows(pairs, &IN_TURN, 2);
    let [low, high] = position(simd, [x, y, z], quantum);
    let normal = octahedral(simd, [normal_x, normal_y, normal_z]);
    let [next_low, next_high] = position(simd, [next_x, next_y, next_z], quantum);
    let next_normal = octahedral(simd, [next_normal_x, next_normal_y, next_normal_z]);
    simd.scatter([low, high, normal, next_low], words, 2 * WORDS);
    // Two of the words are stored again, so that no store reaches into the next pair.
    simd.scatter([normal, next_low, next_high, next_normal], &mut words[2..], 2 * WORDS);
}

/// The two words of each position.
#[cfg_attr(optimized, inline(always))]
fn position<S: Simd>(simd: S, [x, y, z]: [S::Floats; 3], quantum: Quantum) -> [S::Floats; 2] {
    let [x, y, z] = [wrapped(simd, x, quantum), wrapped(simd, y, quantum), wrapped(simd, z, quantum)];
    [(x + y.shift_left::<21>()).bit_cast(), (y.shift_right::<11>() + z.shift_left::<10>()).bit_cast()]
}

const _: () = assert!(Quantum::BITS == 21);

/// The coordinates `mm`, rounded to whole quanta. Only the lowest [`Quantum::BITS`] bits are kept.
#[cfg_attr(optimized, inline(always))]
fn wrapped<S: Simd>(simd: S, mm: S::Floats, quantum: Quantum) -> S::Integers {
    let quanta = mm * simd.splat(quantum.per_mm());
    // `turns` says how often the lowest bits wrap round. If two numbers of turns are equally near,
    // either will do, because the lowest bits are the same.
    let turns = (quanta * simd.splat(1.0 / Quantum::WRAP) + simd.splat(0.5)).floor();
    let rest = quanta - turns * simd.splat(Quantum::WRAP);
    (rest + simd.splat(PackedVertex::ROUNDING)).to_bits().masked((1 << Quantum::BITS) - 1)
}

/// The word of each normal.
#[cfg_attr(optimized, inline(always))]
fn octahedral<S: Simd>(simd: S, [x, y, z]: [S::Floats; 3]) -> S::Floats {
    let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
    let scale = one / (x.abs() + y.abs() + z.abs());
    let (x, y) = (x * scale, y * scale);
    let (beyond_x, beyond_y) = (one - y.abs(), one - x.abs());
    let lower = z.less(zero);
    let steps_x = lower.select(x.less(zero).select(-beyond_x, beyond_x), x);
    let steps_y = lower.select(y.less(zero).select(-beyond_y, beyond_y), y);
    let (steps, rounding) = (simd.splat(PackedVertex::NORMAL_STEPS), simd.splat(PackedVertex::ROUNDING));
    let x = (steps_x * steps + rounding).to_bits().masked(0xffff);
    (x + (steps_y * steps + rounding).to_bits().shift_left::<16>()).bit_cast()
}
