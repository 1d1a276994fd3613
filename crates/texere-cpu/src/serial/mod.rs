//! The paper's serial algorithms: one loop inside the other, nothing clever.

mod crossings;
mod mesh;
mod scan;
mod settling;
mod trajectory;

pub(crate) use crossings::SerialCrossings;
pub(crate) use settling::SerialSettler;

use texere_core::{BackendError, Chunk, MeshMut, PaddedPoints, Plan, Ring};

use crate::engine::{Executor, Work};
use crate::rolls::Rolls;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Serial;

impl Executor for Serial {
    const FUSED: bool = false;

    fn scan(self, plan: &Plan, points: &PaddedPoints, rolls: &mut Rolls) -> Result<(), BackendError> {
        *rolls = scan::scan(plan, points);
        Ok(())
    }

    fn trajectory(self, work: &Work, chunk: &Chunk, out: &mut [Ring]) {
        trajectory::trajectory(work, chunk, out);
    }

    fn mesh(self, work: &Work, chunk: &Chunk, rings: &[Ring], out: MeshMut<'_>) {
        mesh::mesh(work, chunk, rings, out);
    }
}
