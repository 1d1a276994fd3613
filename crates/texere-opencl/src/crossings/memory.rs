//! The memory of crossings.

use texere_core::crossings::{CrossingState, CrossingsPlan};
use texere_core::{BackendError, Limits};
use texere_gpu::{CROSSINGS_PASSES, CrossingSite, CrossingsSeenRow, ThreadRow};
use texere_kernels::CROSSINGS_MOVE;

use crate::buffer::Buffer;
use crate::opened::Opened;
use crate::room::Room;

/// The buffers that the kernels read and write.
#[derive(Debug)]
pub(super) struct Memory {
    pub(super) threads: Buffer,
    pub(super) sites: Buffer,
    /// The lies (states of threads at crossings) after the last pass, without momentum.
    pub(super) crossings: Buffer,
    /// Two buffers of lies with momentum added. Each pass reads one and writes the other, for the
    /// next pass.
    pub(super) found: Buffer,
    pub(super) next: Buffer,
    /// The measures of each workgroup, and of each pass since the last wait.
    pub(super) group_rows: Buffer,
    pub(super) pass_rows: Buffer,
}

impl Memory {
    pub(super) fn new(opened: &Opened, limits: &Limits, plan: &CrossingsPlan) -> Result<Self, BackendError> {
        let mut room = Room::new(limits);
        let rows = |count: u64| size_of::<CrossingsSeenRow>() as u64 * count;
        let crossings = plan.crossings() as u64;
        let bytes = size_of::<CrossingState>() as u64 * crossings;
        let groups = crossings.div_ceil(CROSSINGS_MOVE.group as u64);
        Ok(Self {
            threads: room.holding(opened, "the thread table", &ThreadRow::all(plan))?,
            sites: room.holding(opened, "the table of crossings", &CrossingSite::all(plan))?,
            crossings: room.zeroed(opened, "crossings", bytes)?,
            found: room.zeroed(opened, "crossings as others find them", bytes)?,
            next: room.zeroed(opened, "crossings as others will find them", bytes)?,
            group_rows: room.zeroed(opened, "what groups have seen", rows(groups))?,
            pass_rows: room.zeroed(opened, "what was seen", rows(CROSSINGS_PASSES.into()))?,
        })
    }
}
