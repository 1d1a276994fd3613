//! Crossings on all cores, with the same bits as the reference.

use std::sync::Arc;

use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};

use crate::crossings::{CrossingsMemory, step};

/// The number of crossings of one rayon item.
const TASK: usize = 256;

/// The settler of crossings on all cores.
#[derive(Debug)]
pub(crate) struct ParallelCrossings(pub(crate) CrossingsMemory);

impl CrossingsSettler for ParallelCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.0.plan
    }

    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError> {
        self.0.upload(crossings);
        Ok(())
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let CrossingsMemory { plan, crossings, found, next } = &mut self.0;
        let (plan, found) = (&**plan, found.as_slice());
        let tasks = crossings.par_chunks_mut(TASK).zip(next.par_chunks_mut(TASK)).enumerate();
        let seen = tasks.map(|(task, (crossings, next))| {
            let numbered = (task * TASK..).zip(crossings.iter_mut().zip(next));
            let seen =
                numbered.map(|(number, (crossing, next))| step(plan, pass, found, number, crossing, next));
            seen.fold(CrossingsSeen::NOTHING, CrossingsSeen::and)
        });
        // Maxima and minima do not depend on the order.
        let seen = seen.reduce(|| CrossingsSeen::NOTHING, CrossingsSeen::and);
        self.0.end_pass();
        Ok(seen)
    }

    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError> {
        crossings.copy_from_slice(&self.0.crossings);
        Ok(())
    }
}
