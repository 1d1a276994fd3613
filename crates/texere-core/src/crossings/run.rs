//! The course of a settling: passes until rest.

use std::ops::ControlFlow;

use super::pass::GROWING;
use super::{CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use crate::BackendError;

/// A pass counts as still if no unknown moves further than this, in the plan's unit. With twice the
/// value, `layers_lie_on_one_another` is red.
const STILL: f32 = 5e-5;

/// The number of still passes in a row after which the cloth is at rest. One is not enough, because
/// an oscillation stands still for a moment where it turns. With half the value,
/// `layers_lie_on_one_another` is red; with twice, `turns_do_not_fold`.
const STILL_PASSES: u32 = 10;

/// The result of a settling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsRest {
    /// Whether the cloth has come to rest: in the last passes, no unknown moved noticeably.
    pub at_rest: bool,
    /// Number of passes made.
    pub passes: u32,
    /// The measures of the last pass.
    pub seen: CrossingsSeen,
}

/// Lets crossings come to rest on a device, and leaves them there. `watch` is called with the
/// measures of every pass after the pass, and without measures while a pass is being made. If it
/// breaks off, the run ends: on a processor at once, with some crossings moved, and on any other
/// device after the passes that were sent to it together, ten at most.
///
/// In the first fifty passes, threads grow from four tenths of their area, and the penalties that
/// keep them apart harden. More passes follow until the cloth is at rest, at most as many as the
/// problem allows. The device gets as many passes at once as are certainly needed to reach rest.
///
/// **Errors**: [`BackendError`] of the device, and [`BackendError::OutOfMemory`] of the host.
pub fn settle(
    plan: &CrossingsPlan,
    settler: &mut dyn CrossingsSettler,
    mut watch: impl FnMut(&CrossingsPass, Option<&CrossingsSeen>) -> ControlFlow<()>,
) -> Result<CrossingsRest, BackendError> {
    settler.upload(&plan.start()?)?;
    let mut rest = CrossingsRest { at_rest: false, passes: 0, seen: CrossingsSeen::NOTHING };
    let mut still = 0;
    while rest.passes < plan.passes() && !rest.at_rest {
        // The cloth is at rest only if all of these passes are still, so not before the last of
        // them.
        let last = plan.passes().min(rest.passes + STILL_PASSES - still);
        let passes: Vec<CrossingsPass> = (rest.passes..last).map(CrossingsPass::of).collect();
        let broken_off = settler.passes(&passes, &mut |pass, seen| {
            if let Some(seen) = seen {
                rest.seen = seen;
                still = if rest.passes > GROWING && seen.step < STILL { still + 1 } else { 0 };
                rest.passes += 1;
                rest.at_rest = still == STILL_PASSES;
            }
            watch(pass, seen.as_ref())
        })?;
        if broken_off.is_break() {
            break;
        }
    }
    Ok(rest)
}
