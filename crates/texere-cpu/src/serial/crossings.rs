//! Crossings as they read: one after the other on one thread.

use std::sync::Arc;

use texere_core::crossings::{Crossing, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use texere_core::{BackendError, zeroed};

/// The reference.
#[derive(Debug)]
pub(crate) struct SerialCrossings {
    plan: Arc<CrossingsPlan>,
    /// As they are.
    crossings: Vec<Crossing>,
    /// As others find them in the next pass, and in the one after it.
    found: Vec<Crossing>,
    next: Vec<Crossing>,
}

impl SerialCrossings {
    /// Takes memory for a plan.
    pub(crate) fn new(plan: Arc<CrossingsPlan>) -> Result<Self, BackendError> {
        let count = plan.crossings() as u64;
        let room = || zeroed("crossings", count);
        Ok(Self { crossings: room()?, found: room()?, next: room()?, plan })
    }
}

impl CrossingsSettler for SerialCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.plan
    }

    fn upload(&mut self, crossings: &[Crossing]) -> Result<(), BackendError> {
        self.crossings.copy_from_slice(crossings);
        self.found.copy_from_slice(crossings);
        Ok(())
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let mut seen = CrossingsSeen::NOTHING;
        for (number, (crossing, next)) in self.crossings.iter_mut().zip(&mut self.next).enumerate() {
            let site = self.plan.site(number);
            let block = self.plan.block(pass, &self.found, site);
            let moved = self.plan.moved(&self.found[number], &block, site);
            *next = self.plan.ahead(crossing, &moved, site);
            seen = seen.and(CrossingsSeen { step: moved.difference(crossing), clearance: block.clearance });
            *crossing = moved;
        }
        std::mem::swap(&mut self.found, &mut self.next);
        Ok(seen)
    }

    fn read(&mut self, crossings: &mut [Crossing]) -> Result<(), BackendError> {
        crossings.copy_from_slice(&self.crossings);
        Ok(())
    }
}
