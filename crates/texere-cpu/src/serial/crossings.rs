//! The reference settler of crossings: one crossing after the other on one thread.

use std::sync::Arc;

use texere_core::BackendError;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};

use crate::crossings::{CrossingsMemory, step};

/// The reference settler of crossings.
#[derive(Debug)]
pub(crate) struct SerialCrossings(pub(crate) CrossingsMemory);

impl CrossingsSettler for SerialCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.0.plan
    }

    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError> {
        self.0.upload(crossings);
        Ok(())
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let CrossingsMemory { plan, crossings, found, next } = &mut self.0;
        let mut seen = CrossingsSeen::NOTHING;
        for (number, (crossing, next)) in crossings.iter_mut().zip(next).enumerate() {
            seen = seen.and(step(plan, pass, found, number, crossing, next));
        }
        self.0.end_pass();
        Ok(seen)
    }

    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError> {
        crossings.copy_from_slice(&self.0.crossings);
        Ok(())
    }
}
