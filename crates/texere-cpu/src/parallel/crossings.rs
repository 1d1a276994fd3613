//! Crossings on all cores: the same bits as the reference.

use std::sync::Arc;

use rayon::prelude::*;
use texere_core::crossings::{Crossing, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use texere_core::{BackendError, zeroed};

/// Crossings that a core takes at a time.
const TASK: usize = 256;

/// All cores.
#[derive(Debug)]
pub(crate) struct ParallelCrossings {
    plan: Arc<CrossingsPlan>,
    /// As they are.
    crossings: Vec<Crossing>,
    /// As others find them in the next pass, and in the one after it.
    found: Vec<Crossing>,
    next: Vec<Crossing>,
}

impl ParallelCrossings {
    /// Takes memory for a plan.
    pub(crate) fn new(plan: Arc<CrossingsPlan>) -> Result<Self, BackendError> {
        let count = plan.crossings() as u64;
        let room = || zeroed("crossings", count);
        Ok(Self { crossings: room()?, found: room()?, next: room()?, plan })
    }
}

impl CrossingsSettler for ParallelCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.plan
    }

    fn upload(&mut self, crossings: &[Crossing]) -> Result<(), BackendError> {
        self.crossings.copy_from_slice(crossings);
        self.found.copy_from_slice(crossings);
        Ok(())
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let (plan, found) = (&*self.plan, self.found.as_slice());
        let tasks = self.crossings.par_chunks_mut(TASK).zip(self.next.par_chunks_mut(TASK)).enumerate();
        let seen = tasks.map(|(task, (crossings, next))| {
            let mut seen = CrossingsSeen::NOTHING;
            for (number, (crossing, next)) in (task * TASK..).zip(crossings.iter_mut().zip(next)) {
                let site = plan.site(number);
                let block = plan.block(pass, found, site);
                let moved = plan.moved(&found[number], &block, site);
                *next = plan.ahead(crossing, &moved, site);
                seen =
                    seen.and(CrossingsSeen { step: moved.difference(crossing), clearance: block.clearance });
                *crossing = moved;
            }
            seen
        });
        // The greatest and the least are the same in any order.
        let seen = seen.reduce(|| CrossingsSeen::NOTHING, CrossingsSeen::and);
        std::mem::swap(&mut self.found, &mut self.next);
        Ok(seen)
    }

    fn read(&mut self, crossings: &mut [Crossing]) -> Result<(), BackendError> {
        crossings.copy_from_slice(&self.crossings);
        Ok(())
    }
}
