//! The reference settler of crossings: one crossing after the other on one thread.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};

use crate::asked::{self, in_parts};
use crate::crossings::{CrossingsMemory, step};

/// The number of crossings between two questions to the caller whether to go on.
const PART: usize = 1024;

/// The reference settler of crossings.
#[derive(Debug)]
pub(crate) struct SerialCrossings(pub(crate) CrossingsMemory);

impl SerialCrossings {
    /// Moves every crossing once, unless `watch` breaks off.
    fn move_all(&mut self, pass: &CrossingsPass, watch: WorkWatch<'_>) -> ControlFlow<(), CrossingsSeen> {
        let CrossingsMemory { plan, crossings, found, next } = &mut self.0;
        let mut seen = CrossingsSeen::NOTHING;
        in_parts(crossings.len(), PART, watch, |part| {
            let own = crossings[part.clone()].iter_mut().zip(&mut next[part.clone()]);
            for (number, (crossing, next)) in part.zip(own) {
                seen = seen.and(step(plan, pass, found, number, crossing, next));
            }
        })?;
        self.0.end_pass();
        ControlFlow::Continue(seen)
    }
}

impl CrossingsSettler for SerialCrossings {
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
