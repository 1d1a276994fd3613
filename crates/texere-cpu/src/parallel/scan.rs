//! Rolls: how far each ring's section is turned about its yarn. Each block adds up its own steps,
//! the turns from one ring to the next. A running sum then goes along each yarn's blocks.

use std::borrow::Cow;
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
use crate::rolls::{Rolls, Sums};

/// The number of blocks of one rayon item.
const RUN_BLOCKS: u32 = 64;

/// The most rings whose sums are kept: 128 MiB of sums. A mesh of more rings is streamed as a rule,
/// in memory that must not grow with the rings. To make sums again takes as long as the scan. With
/// half the value, the Jacquard cloth of `designs/paper/figure-7a.toml` would have its sums made
/// again if its yarns were twisted.
const KEPT_RINGS: u64 = 1 << 25;

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
    resize("whole turns", whole, plan.counts().yarns)?;
    let seats = Seats::at_each_place(plan);
    let source = Source { plan, points, seats: &seats };
    // Sums that are not kept stay so, because only some yarns are scanned here.
    let rings = plan.ring_offsets().last().copied().unwrap_or(0);
    if rings > KEPT_RINGS {
        *in_block = Sums::MadeAgain;
    }
    let kept = match in_block {
        Sums::Kept(kept) => {
            // A vector may reach past the last ring.
            resize("rolls", kept, rings + LANES_MAX as u64)?;
            Some(&mut kept[..])
        }
        Sums::MadeAgain => None,
    };
    let scratch = if kept.is_some() { 0 } else { RUN_RINGS as usize };
    runs(plan, yarns.clone(), at_block, kept).into_par_iter().for_each_init(
        || vec![Turn::ZERO; scratch],
        |scratch, Run { yarn, first_ring, count, blocks, kept }| {
            let rings = kept.unwrap_or_else(|| &mut scratch[..count as usize]);
            set.run(BlockSums { source, yarn, first_ring, blocks, rings });
        },
    );
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
    /// Number of the rings.
    count: u32,
    blocks: &'a mut [Turn],
    /// The memory for sums of rings, if they are kept.
    kept: Option<&'a mut [Turn]>,
}

/// The blocks of `yarns` in runs, each with its part of `blocks`, and of `kept` if there is any.
fn runs<'a>(
    plan: &Plan,
    yarns: Range<usize>,
    blocks: &'a mut [Turn],
    kept: Option<&'a mut [Turn]>,
) -> Vec<Run<'a>> {
    let mut runs = Vec::new();
    let (mut blocks_left, mut kept_left) = (blocks, kept);
    // The offsets of the blocks and rings that are left.
    let [mut block, mut ring] = [0, 0];
    for yarn in yarns {
        let mut first_ring = 0;
        // Blocks and rings between the yarns may belong to yarns that are not scanned.
        let starts = [plan.block_offsets()[yarn] as usize, plan.ring_offsets()[yarn] as usize];
        take(&mut blocks_left, starts[0] - block);
        if let Some(left) = &mut kept_left {
            take(left, starts[1] - ring);
        }
        [block, ring] = starts;
        while first_ring < plan.rings(yarn) {
            let count = (plan.rings(yarn) - first_ring).min(RUN_RINGS);
            let blocks = take(&mut blocks_left, count.div_ceil(BLOCK_RINGS) as usize);
            [block, ring] = [block + blocks.len(), ring + count as usize];
            let kept = kept_left.as_mut().map(|left| take(left, count as usize));
            runs.push(Run { yarn, first_ring, count, blocks, kept });
            first_ring += count;
        }
    }
    runs
}

/// The sums of steps inside blocks, from the first ring of `stretch` on. The stretch begins with a
/// block. A vector may be loaded at each of its rings.
#[cfg_attr(optimized, inline(always))]
pub(super) fn in_blocks<'a, S: Simd>(
    simd: S,
    source: Source<'_>,
    rolls: &'a Rolls,
    stretch: Stretch,
) -> Cow<'a, [Turn]> {
    match &rolls.in_block {
        Sums::Kept(kept) => {
            let first = source.plan.ring_offsets()[stretch.yarn] + u64::from(stretch.first);
            Cow::Borrowed(&kept[first as usize..])
        }
        Sums::MadeAgain => Cow::Owned(made_again(simd, source, stretch)),
    }
}

fn made_again<S: Simd>(simd: S, source: Source<'_>, stretch: Stretch) -> Vec<Turn> {
    let Stretch { yarn, first, count } = stretch;
    let mut sums = vec![Turn::ZERO; count as usize + LANES_MAX];
    let mut blocks = [Turn::ZERO; RUN_BLOCKS as usize];
    let runs = sums[..count as usize].chunks_mut(RUN_RINGS as usize);
    for (rings, first_ring) in runs.zip((first..).step_by(RUN_RINGS as usize)) {
        let blocks = &mut blocks[..rings.len().div_ceil(BLOCK_RINGS as usize)];
        simd.run(BlockSums { source, yarn, first_ring, blocks, rings });
    }
    sums
}

/// The job that adds up the steps of at most [`RUN_BLOCKS`] consecutive blocks of a yarn.
struct BlockSums<'a> {
    source: Source<'a>,
    yarn: usize,
    first_ring: u32,
    /// For each block, the sum of its steps: to the next block's first ring, or to the yarn's last
    /// ring.
    blocks: &'a mut [Turn],
    /// For each ring, the sum of the steps to it from its block's first ring.
    rings: &'a mut [Turn],
}

impl Job for BlockSums<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { source, yarn, first_ring, mut blocks, mut rings } = self;
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod tests {
    use std::sync::Arc;

    use texere_core::backend::MeshMut;
    use texere_core::{ControlPoint, Frame, Limits, Settings, Vertex, Yarn, Yarns};

    use super::*;
    use crate::engine::{Executor, Work};
    use crate::parallel::Parallel;

    /// Twisted yarns on helices, one of them closed, and a yarn that keeps to a plane. The long
    /// ones have more blocks than one job of the scan.
    fn yarns() -> Yarns {
        let mut yarns = Yarns::builder();
        for (points, closed, twist) in
            [(3, false, 300.0), (2500, false, 0.0), (2500, false, -700.0), (700, true, 200.0)]
        {
            let round = |point: u32| std::f32::consts::TAU * point as f32 / 700.0;
            let place = |point: u32| {
                let (sin, cos) = round(point).sin_cos();
                let wave = (40.0 * round(point)).sin();
                ControlPoint::new(
                    90.0 * cos,
                    90.0 * sin,
                    if closed { wave } else { point as f32 * 0.05 },
                    0.2,
                )
            };
            let points: Vec<_> = (0..points).map(place).collect();
            yarns.yarn(Yarn { closed, twist, ..Yarn::default() }, &points);
        }
        let flat: Vec<_> = (0..300).map(|x| ControlPoint::new(x as f32, 0.0, (x % 2) as f32, 0.2)).collect();
        yarns.yarn(Yarn::default(), &flat);
        yarns.build().unwrap()
    }

    #[test]
    fn sums_that_are_made_again_are_those_that_are_kept() {
        let yarns = yarns();
        let settings = Settings { subdivisions: 2, frame: Frame::RotationMinimizing, ..Settings::default() };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
        let chunks: Vec<_> = plan.chunks(&Limits { blocks: 50, ..Limits::default() }).unwrap().collect();
        let mesh = |executor: Parallel, in_block: Sums| {
            let mut points = PaddedPoints::new(&plan).unwrap();
            points.upload(&plan, 0, yarns.points());
            let rolls = Rolls { in_block, ..Rolls::default() };
            let mut work = Work { plan: plan.clone(), points, rolls, lengths: Vec::new() };
            executor.scan(&plan, &work.points, &mut work.rolls, 0..yarns.layout().yarns().len()).unwrap();
            let made = chunks.iter().flat_map(|chunk| {
                let mut vertices = vec![Vertex::default(); chunk.vertices() as usize];
                let mut indices = vec![0; chunk.indices() as usize];
                let out = MeshMut { vertices: &mut vertices, indices: &mut indices };
                executor.mesh(&work, chunk, &[], out, 0);
                vertices
            });
            let made: Vec<Vertex> = made.collect();
            let Rolls { at_block, whole, in_block } = work.rolls;
            (
                bytemuck::cast_slice::<_, u8>(&made).to_vec(),
                at_block,
                whole,
                matches!(in_block, Sums::Kept(_)),
            )
        };
        for executor in Parallel::each() {
            let kept = mesh(executor, Sums::default());
            let again = mesh(executor, Sums::MadeAgain);
            assert!(kept.3 && !again.3);
            assert!(kept.2.iter().any(|turn| *turn != Turn::ZERO));
            assert!((kept.0, kept.1, kept.2) == (again.0, again.1, again.2), "{}", executor.vectors());
        }
    }
}
