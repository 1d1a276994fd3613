//! What both CPU settlers of crossings share: their memory, and the step of one crossing.

use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::zeroed;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen};

/// The states of all crossings, before and after a pass.
#[derive(Debug)]
pub(crate) struct CrossingsMemory {
    pub(crate) plan: Arc<CrossingsPlan>,
    /// The states after the last pass, without momentum.
    pub(crate) crossings: Vec<CrossingState>,
    /// The states with momentum added, which the next pass reads.
    pub(crate) found: Vec<CrossingState>,
    /// The states with momentum added that the next pass writes.
    pub(crate) next: Vec<CrossingState>,
}

impl CrossingsMemory {
    /// Allocates the memory for `plan`.
    pub(crate) fn new(plan: Arc<CrossingsPlan>) -> Result<Self, BackendError> {
        let count = plan.crossings() as u64;
        let room = || zeroed("crossings", count);
        Ok(Self { crossings: room()?, found: room()?, next: room()?, plan })
    }

    /// Sets the states that crossings start from.
    pub(crate) fn upload(&mut self, crossings: &[CrossingState]) {
        self.crossings.copy_from_slice(crossings);
        self.found.copy_from_slice(crossings);
    }

    /// Ends a pass: the states in `next` become those that the next pass reads.
    pub(crate) fn end_pass(&mut self) {
        std::mem::swap(&mut self.found, &mut self.next);
    }
}

/// Moves crossing `number` by one step of a pass. All crossings are read from `found`. `crossing`
/// holds the state after the pass before, and gets the moved state. The moved state with momentum
/// added goes to `next`.
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
    *next = plan.ahead(crossing, &moved, &block, site);
    let seen = CrossingsSeen { step: moved.difference(crossing), clearance: block.clearance };
    *crossing = moved;
    seen
}
