//! The parallel backend. It spreads short ranges of rings over all cores, inside a yarn as well as
//! across yarns.

mod attributes;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod crossings;
mod instruction_set;
mod leaning;
mod lines;
mod maker;
mod mesh;
mod packed;
mod planar;
mod portable;
mod relaxation;
mod rings;
mod runs;
mod scan;
mod settling;
mod simd;
mod spline;
mod stances;
mod tiles;
mod trajectory;
mod turns;
mod vertices;

use std::ops::Range;

use texere_core::backend::{Chunk, MeshMut, PaddedPoints, Plan};
use texere_core::definitions::Ring;
use texere_core::{ArcLength, Attribute, BackendError, PackedVertex};

use crate::engine::{Executor, Work};
use crate::rolls::Rolls;
pub(crate) use crossings::ParallelCrossings;
use instruction_set::InstructionSet;
pub(crate) use relaxation::ParallelRelaxer;
pub(crate) use settling::ParallelSettler;

/// The executor of all cores, with one set of vector instructions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parallel(InstructionSet);

impl Parallel {
    /// Uses the vectors that `TEXERE_SIMD` names or, without it, the widest that the processor has.
    ///
    /// **Errors**: [`BackendError::NoInstructionSet`] if the processor has none of that name.
    pub(crate) fn new() -> Result<Self, BackendError> {
        InstructionSet::chosen().map(Self)
    }

    /// An executor for each kind of vectors that the processor has, the widest last.
    pub(crate) fn each() -> impl Iterator<Item = Self> {
        InstructionSet::available().into_iter().map(Self)
    }

    /// The name of the vectors.
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
        trajectory::trajectory(self.0, work, chunk, out);
    }

    fn mesh(self, work: &Work, chunk: &Chunk, _rings: &[Ring], out: MeshMut<'_>, bytes: u64) {
        mesh::mesh(self.0, work, chunk, out, bytes);
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
