//! Crossings on all cores, with the same bits as the reference.

use std::ops::ControlFlow;
use std::sync::Arc;

use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};

use crate::asked::{self, for_all_threads, in_parts};
use crate::crossings::{CrossingsMemory, step};

/// The number of crossings of one rayon item.
const TASK: usize = 256;

/// The settler of crossings on all cores.
#[derive(Debug)]
pub(crate) struct ParallelCrossings(pub(crate) CrossingsMemory);

impl ParallelCrossings {
    /// Moves every crossing once, unless `watch` breaks off.
    fn move_all(&mut self, pass: &CrossingsPass, watch: WorkWatch<'_>) -> ControlFlow<(), CrossingsSeen> {
        let CrossingsMemory { plan, crossings, found, next } = &mut self.0;
        let (plan, found) = (&**plan, found.as_slice());
        let mut seen = CrossingsSeen::NOTHING;
        in_parts(crossings.len(), for_all_threads(2 * TASK), watch, |part| {
            let from = part.start;
            let next = next[part.clone()].par_chunks_mut(TASK);
            let tasks = crossings[part].par_chunks_mut(TASK).zip(next).enumerate();
            let own = tasks.map(|(task, (crossings, next))| {
                let numbered = (from + task * TASK..).zip(crossings.iter_mut().zip(next));
                let seen = numbered
                    .map(|(number, (crossing, next))| step(plan, pass, found, number, crossing, next));
                seen.fold(CrossingsSeen::NOTHING, CrossingsSeen::and)
            });
            // Maxima and minima do not depend on the order.
            seen = seen.and(own.reduce(|| CrossingsSeen::NOTHING, CrossingsSeen::and));
        })?;
        self.0.end_pass();
        ControlFlow::Continue(seen)
    }
}

impl CrossingsSettler for ParallelCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.0.plan
    }

    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError> {
        self.0.upload(crossings);
        Ok(())
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let seen = self.move_all(pass, &mut asked::go_on).continue_value();
        Ok(seen.unwrap_or(CrossingsSeen::NOTHING))
    }

    fn pass_watched(
        &mut self,
        pass: &CrossingsPass,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), CrossingsSeen>, BackendError> {
        Ok(self.move_all(pass, watch))
    }

    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError> {
        crossings.copy_from_slice(&self.0.crossings);
        Ok(())
    }
}
