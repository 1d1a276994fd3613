//! Time spent on the device, by stage.

use std::sync::Arc;
use std::time::Duration;

use opencl3::event::{
    CL_EVENT_COMMAND_EXECUTION_STATUS, CL_PROFILING_COMMAND_END, CL_PROFILING_COMMAND_START, get_event_info,
    get_event_profiling_info, wait_for_events,
};
use texere_core::StageTimings;

use crate::handles::Handle;

/// What a command's time counts towards.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stage {
    Upload,
    Scan,
    Trajectory,
    Mesh,
    Readback,
}

/// Adds up the time of commands as they end.
#[derive(Debug, Default)]
pub(crate) struct Clock {
    total: StageTimings,
    /// Commands that may still be running.
    pending: Vec<(Stage, Arc<Handle>)>,
}

/// Commands that are held before those that have ended are added up.
const PENDING: usize = 64;

impl Clock {
    /// Counts `event`'s command once it has ended.
    pub(crate) fn note(&mut self, stage: Stage, event: &Arc<Handle>) {
        self.pending.push((stage, event.clone()));
        if self.pending.len() >= PENDING {
            let pending = std::mem::take(&mut self.pending);
            let (ended, running): (Vec<_>, _) = pending.into_iter().partition(|(_, event)| has_ended(event));
            ended.iter().for_each(|(stage, event)| add(&mut self.total, *stage, duration(event)));
            self.pending = running;
        }
    }

    /// Counts time that the host has taken.
    pub(crate) fn add(&mut self, stage: Stage, time: Duration) {
        add(&mut self.total, stage, time);
    }

    /// The time of all commands, which are waited for.
    pub(crate) fn timings(&self) -> StageTimings {
        let mut total = self.total;
        for (stage, event) in &self.pending {
            // A command that failed is one that took no time.
            if wait_for_events(&[event.raw()]).is_ok() {
                add(&mut total, *stage, duration(event));
            }
        }
        total
    }
}

fn add(total: &mut StageTimings, stage: Stage, time: Duration) {
    *match stage {
        Stage::Upload => &mut total.upload,
        Stage::Scan => &mut total.scan,
        Stage::Trajectory => &mut total.trajectory,
        Stage::Mesh => &mut total.mesh,
        Stage::Readback => &mut total.readback,
    } += time;
}

/// Whether the command is complete, or has failed.
fn has_ended(event: &Handle) -> bool {
    get_event_info(event.raw(), CL_EVENT_COMMAND_EXECUTION_STATUS).map_or(true, |status| status.to_int() <= 0)
}

/// From start to end on the device; none for a command that failed.
fn duration(event: &Handle) -> Duration {
    let at =
        |what| get_event_profiling_info(event.raw(), what).map_or(0, |nanoseconds| nanoseconds.to_ulong());
    Duration::from_nanos(at(CL_PROFILING_COMMAND_END).saturating_sub(at(CL_PROFILING_COMMAND_START)))
}
