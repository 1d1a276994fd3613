//! Time spent on the device, by stage.

use std::sync::Arc;
use std::time::Duration;

use opencl3::event::{
    CL_EVENT_COMMAND_EXECUTION_STATUS, CL_PROFILING_COMMAND_END, CL_PROFILING_COMMAND_START, get_event_info,
    get_event_profiling_info, wait_for_events,
};
use texere_core::backend::StageTimings;

use crate::handles::Handle;

/// The stage that a command's time counts towards.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stage {
    Upload,
    Scan,
    Trajectory,
    Mesh,
    Readback,
}

/// Adds up the times of commands as they end.
#[derive(Debug, Default)]
pub(crate) struct Clock {
    total: StageTimings,
    /// Groups of commands that may still run, each with its first and its last command.
    pending: Vec<(Stage, [Arc<Handle>; 2])>,
}

/// If at least this many groups are pending, the times of the groups that have ended are added up.
const PENDING: usize = 64;

impl Clock {
    /// Counts `event`'s command once it has ended.
    pub(crate) fn note(&mut self, stage: Stage, event: &Arc<Handle>) {
        self.note_all(stage, event, event);
    }

    /// Counts the time from the start of `first`'s command to the end of `last`'s, which comes
    /// later in the same queue.
    pub(crate) fn note_all(&mut self, stage: Stage, first: &Arc<Handle>, last: &Arc<Handle>) {
        self.pending.push((stage, [first.clone(), last.clone()]));
        if self.pending.len() >= PENDING {
            let pending = std::mem::take(&mut self.pending);
            let (ended, running): (Vec<_>, _) =
                pending.into_iter().partition(|(_, [_, last])| has_ended(last));
            ended.iter().for_each(|(stage, events)| add(&mut self.total, *stage, duration(events)));
            self.pending = running;
        }
    }

    /// Counts time that passed on the host.
    pub(crate) fn add(&mut self, stage: Stage, time: Duration) {
        add(&mut self.total, stage, time);
    }

    /// Waits for all commands, and returns their times.
    pub(crate) fn timings(&self) -> StageTimings {
        let mut total = self.total;
        for (stage, events) in &self.pending {
            // A command that failed counts as no time.
            if wait_for_events(&[events[1].raw()]).is_ok() {
                add(&mut total, *stage, duration(events));
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

/// The time on the device from the first command's start to the last one's end. Zero for a command
/// that failed.
fn duration([first, last]: &[Arc<Handle>; 2]) -> Duration {
    let at = |event: &Handle, what| get_event_profiling_info(event.raw(), what).map(|time| time.to_ulong());
    match (at(first, CL_PROFILING_COMMAND_START), at(last, CL_PROFILING_COMMAND_END)) {
        (Ok(start), Ok(end)) => Duration::from_nanos(end.saturating_sub(start)),
        _ => Duration::ZERO,
    }
}
