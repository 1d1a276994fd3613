//! What both CPU settlers of crossings share: their memory, and the step of one crossing.

use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::zeroed;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen};

/// The states of all crossings.
#[derive(Debug)]
pub(crate) struct CrossingsMemory {
    pub(crate) plan: Arc<CrossingsPlan>,
    /// The crossings as they are.
    pub(crate) crossings: Vec<CrossingState>,
    /// The crossings as others find them: in the next pass, and in the one after it.
    pub(crate) found: Vec<CrossingState>,
    pub(crate) next: Vec<CrossingState>,
}

impl CrossingsMemory {
    /// Takes memory for a plan.
    pub(crate) fn new(plan: Arc<CrossingsPlan>) -> Result<Self, BackendError> {
        let count = plan.crossings() as u64;
        let room = || zeroed("crossings", count);
        Ok(Self { crossings: room()?, found: room()?, next: room()?, plan })
    }

    /// Takes the states that crossings start from.
    pub(crate) fn upload(&mut self, crossings: &[CrossingState]) {
        self.crossings.copy_from_slice(crossings);
        self.found.copy_from_slice(crossings);
    }

    /// Ends a pass: what it wrote for others to find is what the next pass finds.
    pub(crate) fn end_pass(&mut self) {
        std::mem::swap(&mut self.found, &mut self.next);
    }
}

/// Crossing `number` makes its step of a pass. It reads all crossings as `found`, and writes to
/// `next` what the next pass finds of it.
pub(crate) fn step(
    plan: &CrossingsPlan,
    pass: &CrossingsPass,
    found: &[CrossingState],
    number: usize,
    crossing: &mut CrossingState,
    next: &mut CrossingState,
) -> CrossingsSeen {
    let site = plan.site(number);
    let block = plan.block(pass, found, site);
    let moved = plan.moved(&found[number], &block, site);
    *next = plan.ahead(crossing, &moved, site);
    let seen = CrossingsSeen { step: moved.difference(crossing), clearance: block.clearance };
    *crossing = moved;
    seen
}
