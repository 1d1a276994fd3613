//! Rolls: how far each ring's section is turned about its yarn. Each block adds up its own steps,
//! the turns from one ring to the next. A running sum then goes along each yarn's blocks.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::backend::{BLOCK_RINGS, PaddedPoints, Plan};
use texere_core::definitions::Turn;

use super::instruction_set::InstructionSet;
use super::planar::stays_upright;
use super::rings::{Source, Stretch, Walk};
use super::runs::take;
use super::simd::{Integers, Job, LANES_MAX, Simd};
use super::spline::Seats;
use super::turns::Steps;
use crate::engine::resize;
use crate::rolls::Rolls;

/// The number of blocks of one rayon item.
const RUN_BLOCKS: u32 = 64;

/// The most rings of one rayon item.
const RUN_RINGS: u32 = RUN_BLOCKS * BLOCK_RINGS;

pub(super) fn scan(
    set: InstructionSet,
    plan: &Plan,
    points: &PaddedPoints,
    rolls: &mut Rolls,
    yarns: Range<usize>,
) -> Result<(), BackendError> {
    let Rolls { at_block, in_block, whole } = rolls;
    resize("rolls", at_block, plan.block_count())?;
    // A vector may reach past the last ring.
    let rings = plan.ring_offsets().last().copied().unwrap_or(0);
    resize("rolls", in_block, rings + LANES_MAX as u64)?;
    resize("whole turns", whole, plan.counts().yarns)?;
    let seats = Seats::at_each_place(plan);
    let source = Source { plan, points, seats: &seats };
    runs(plan, yarns.clone(), at_block, in_block)
        .into_par_iter()
        .for_each(|run| set.run(ScanRun { source, run }));
    for yarn in yarns {
        let (first, blocks) = (plan.block_offsets()[yarn] as usize, plan.rings(yarn).div_ceil(BLOCK_RINGS));
        let mut roll = Turn::ZERO;
        for turn in &mut at_block[first..first + blocks as usize] {
            let here = roll;
            roll = roll + *turn;
            *turn = here;
        }
        whole[yarn] = roll;
    }
    Ok(())
}

/// Consecutive blocks of one yarn, and the memory for their sums.
struct Run<'a> {
    yarn: usize,
    first_ring: u32,
    /// For each block, the sum of its steps: to the next block's first ring, or to the yarn's last
    /// ring.
    blocks: &'a mut [Turn],
    /// For each ring, the sum of the steps to it from its block's first ring.
    rings: &'a mut [Turn],
}

fn runs<'a>(plan: &Plan, yarns: Range<usize>, blocks: &'a mut [Turn], rings: &'a mut [Turn]) -> Vec<Run<'a>> {
    let mut runs = Vec::new();
    let [mut blocks_left, mut rings_left] = [blocks, rings];
    // The offsets of the blocks and rings that are left.
    let [mut block, mut ring] = [0, 0];
    for yarn in yarns {
        let mut first_ring = 0;
        // Blocks and rings between the yarns may belong to yarns that are not scanned.
        let starts = [plan.block_offsets()[yarn] as usize, plan.ring_offsets()[yarn] as usize];
        take(&mut blocks_left, starts[0] - block);
        take(&mut rings_left, starts[1] - ring);
        [block, ring] = starts;
        while first_ring < plan.rings(yarn) {
            let count = (plan.rings(yarn) - first_ring).min(RUN_RINGS);
            let blocks = take(&mut blocks_left, count.div_ceil(BLOCK_RINGS) as usize);
            [block, ring] = [block + blocks.len(), ring + count as usize];
            runs.push(Run { yarn, first_ring, blocks, rings: take(&mut rings_left, count as usize) });
            first_ring += count;
        }
    }
    runs
}

struct ScanRun<'a> {
    source: Source<'a>,
    run: Run<'a>,
}

impl Job for ScanRun<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { source, run: Run { yarn, first_ring, mut blocks, mut rings } } = self;
        let of_yarn = source.plan.rings(yarn);
        let (frame, twist) = (source.plan.frame(yarn), source.plan.turns_per_mm(yarn));
        // The blocks' own rings and, unless the yarn ends, the ring after them: the step to it
        // belongs to the last block.
        let stretch =
            |first: u32, rings: u32| Stretch { yarn, first, count: (rings + 1).min(of_yarn - first) };
        let mut first = first_ring;
        let mut upright = [false; RUN_BLOCKS as usize];
        for (number, upright) in upright.iter_mut().enumerate().take(blocks.len()) {
            let first = first_ring + number as u32 * BLOCK_RINGS;
            *upright = frame.is_level(twist)
                || (twist == 0.0 && stays_upright(simd, &source, stretch(first, BLOCK_RINGS)));
        }
        for alike in upright[..blocks.len()].chunk_by(|a, b| a == b) {
            let blocks = take(&mut blocks, alike.len());
            let count = rings.len().min(alike.len() * BLOCK_RINGS as usize);
            let rings = take(&mut rings, count);
            if alike[0] {
                blocks.fill(Turn::ZERO);
                rings.fill(Turn::ZERO);
            } else {
                sums(simd, source, stretch(first, count as u32), blocks, rings);
            }
            first += count as u32;
        }
    }
}

/// Adds up the steps between the rings of `stretch`. It has one ring for each entry of `rings`, and
/// one ring more unless the yarn ends there.
#[cfg_attr(optimized, inline(always))]
fn sums<S: Simd>(simd: S, source: Source<'_>, stretch: Stretch, blocks: &mut [Turn], rings: &mut [Turn]) {
    // Rolls do not depend on sizes.
    let mut walk = Walk::<S, false>::new(simd, source, stretch);
    let mut steps = Steps::new(simd, &source, stretch.yarn);
    for (number, rings) in rings.chunks_mut(BLOCK_RINGS as usize).enumerate() {
        let mut sum = simd.splat_integer(0);
        for (group, rings) in rings.chunks_mut(S::LANES).enumerate() {
            let mut own = steps.next(&walk.next());
            if group == 0 {
                if let Some(before) = number.checked_sub(1) {
                    blocks[before] = blocks[before] + Turn(own.first());
                }
                own = own.without_first();
            }
            let mut sums = [0; LANES_MAX];
            sum = sum.splat_last() + own.running_sum();
            sum.store(&mut sums);
            rings.copy_from_slice(&bytemuck::cast_slice(&sums)[..rings.len()]);
        }
        blocks[number] = rings.last().copied().unwrap_or_default();
    }
    if walk.left() > 0 {
        let own = steps.next(&walk.next());
        if let Some(last) = blocks.last_mut() {
            *last = *last + Turn(own.first());
        }
    }
}
