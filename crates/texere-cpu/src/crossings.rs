//! The memory of crossings, and the step of one: what both schedules share.

use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::zeroed;
use texere_core::crossings::{CrossingState, CrossingsPass, CrossingsPlan, CrossingsSeen};

/// Where all crossings are.
#[derive(Debug)]
pub(crate) struct CrossingsMemory {
    pub(crate) plan: Arc<CrossingsPlan>,
    /// As they are.
    pub(crate) crossings: Vec<CrossingState>,
    /// As others find them in the next pass, and in the one after it.
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

    /// All crossings as they start.
    pub(crate) fn upload(&mut self, crossings: &[CrossingState]) {
        self.crossings.copy_from_slice(crossings);
        self.found.copy_from_slice(crossings);
    }

    /// What others will find is found from now on.
    pub(crate) fn end_pass(&mut self) {
        std::mem::swap(&mut self.found, &mut self.next);
    }
}

/// Crossing `number` makes its step of a pass, where all were `found`, and goes on to where the
/// `next` pass finds it.
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
