//! The serial algorithms of the paper "GPU-based yarn-level parallel computing framework", written
//! as plain nested loops.

mod attributes;
mod crossings;
mod mesh;
mod packed;
mod relaxation;
mod scan;
mod settling;
mod trajectory;

pub(crate) use crossings::SerialCrossings;
pub(crate) use relaxation::SerialRelaxer;
pub(crate) use scan::scan_yarn;
pub(crate) use settling::SerialSettler;
pub(crate) use trajectory::rings;

use std::ops::Range;

use texere_core::backend::{Chunk, MeshMut, PaddedPoints, Plan};
use texere_core::definitions::Ring;
use texere_core::{ArcLength, Attribute, BackendError, PackedVertex};

use crate::engine::{Executor, Work};
use crate::rolls::Rolls;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Serial;

impl Executor for Serial {
    const FUSED: bool = false;

    fn scan(
        self,
        plan: &Plan,
        points: &PaddedPoints,
        rolls: &mut Rolls,
        yarns: Range<usize>,
    ) -> Result<(), BackendError> {
        scan::scan(plan, points, rolls, yarns)
    }

    fn trajectory(self, work: &Work, chunk: &Chunk, out: &mut [Ring]) {
        trajectory::trajectory(work, chunk, out);
    }

    fn mesh(self, work: &Work, chunk: &Chunk, rings: &[Ring], out: MeshMut<'_>, _bytes: u64) {
        mesh::mesh(work, chunk, rings, out);
    }

    fn packed(self, work: &Work, chunk: &Chunk, rings: &[Ring], out: &mut [PackedVertex]) {
        packed::packed(work, chunk, rings, out);
    }

    fn measure(self, plan: &Plan, points: &PaddedPoints, lengths: &mut [ArcLength], yarns: Range<usize>) {
        attributes::measure(plan, points, lengths, yarns);
    }

    fn attributes(self, work: &Work, chunk: &Chunk, out: &mut [Attribute]) {
        attributes::attributes(work, chunk, out);
    }
}
