//! Rings in vectors: the maker that works them out from consecutive blocks, and the sinks that they
//! go to.

use texere_core::backend::{BLOCK_RINGS, Block};

use super::rings::{Rings, Source, Stretch, Walk};
use super::scan;
use super::simd::{Job, Simd};
use super::spline::Seats;
use super::turns;
use super::vertices::Surface;
use crate::engine::Work;
use crate::rolls::block_number;

/// The input that all runs of blocks share.
pub(super) struct Maker<'a> {
    pub(super) work: &'a Work,
    seats: Vec<Seats>,
    /// The surface of each section.
    pub(super) surfaces: Vec<Surface<'a>>,
}

impl<'a> Maker<'a> {
    pub(super) fn new(work: &'a Work) -> Self {
        let plan = &work.plan;
        let sections = 0..plan.layout().sections().len();
        let surfaces = sections.map(|section| Surface::new(plan.outline(section))).collect();
        Self { work, seats: Seats::at_each_place(plan), surfaces }
    }

    /// Makes `piece`, which is work on `blocks`. A piece with rings that may be flattened is made
    /// in a separate function, so that the loops for round yarns stay small.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn make<S: Simd>(&self, simd: S, piece: impl Piece, blocks: &[Block]) {
        if self.source().all_round(Stretch::of(blocks)) {
            piece.make::<S, false>(simd);
        } else {
            simd.run(Flattened(piece));
        }
    }

    /// Whether the outlines of the yarn of `blocks` lean.
    pub(super) fn leans(&self, blocks: &[Block]) -> bool {
        self.work.plan.leans(blocks[0].yarn as usize).is_some()
    }

    fn source(&self) -> Source<'_> {
        Source { plan: &self.work.plan, points: &self.work.points, seats: &self.seats }
    }

    /// Gives `sink` the rings of `blocks`, consecutive blocks of one yarn, a vector of rings at a
    /// time. Without `FLATTENED` all rings are treated as round.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn rings<S: Simd, const FLATTENED: bool>(
        &self,
        simd: S,
        blocks: &[Block],
        sink: &mut impl Sink,
    ) {
        let (Work { plan, rolls, .. }, stretch) = (self.work, Stretch::of(blocks));
        let mut walk = Walk::<S, FLATTENED>::new(simd, self.source(), stretch);
        let rolled = plan.turns(stretch.yarn);
        let number = block_number(plan, &blocks[0]);
        let sums = rolled.then(|| scan::in_blocks(simd, self.source(), rolls, stretch));
        let sums = sums.as_deref().unwrap_or_default();
        while let count @ 1.. = walk.left() {
            let (done, mut rings, mut roll) = (walk.done, walk.next(), simd.splat_integer(0));
            if rolled {
                let block = number + u64::from(done / BLOCK_RINGS);
                let (yarn, in_block) = (stretch.yarn, &sums[done as usize..]);
                roll = turns::rolls(simd, plan, rolls, in_block, yarn, stretch.first + done, block);
                rings = rings.turned(simd, roll);
            }
            sink.take::<S, FLATTENED>(simd, &rings, roll, rolled, count);
        }
    }
}

/// Work on consecutive blocks of one yarn.
pub(super) trait Piece {
    /// Does the work. The function must be inlined, so that it is compiled for the instructions of
    /// `simd`.
    fn make<S: Simd, const FLATTENED: bool>(self, simd: S);
}

/// A piece with rings that may be flattened.
struct Flattened<P>(P);

impl<P: Piece> Job for Flattened<P> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        self.0.make::<S, true>(simd);
    }
}

/// A consumer of rings.
pub(super) trait Sink {
    /// Uses the first `count` rings of a vector. Unless `rolled`, all rolls are zero. The function
    /// must be inlined, so that it is compiled for the instructions of `simd`.
    fn take<S: Simd, const FLATTENED: bool>(
        &mut self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        roll: S::Integers,
        rolled: bool,
        count: usize,
    );
}
