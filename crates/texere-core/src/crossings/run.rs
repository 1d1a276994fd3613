//! The course of a settling: passes until rest.

use std::ops::ControlFlow;

use super::pass::GROWING;
use super::{CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use crate::BackendError;

/// The cloth is at rest if no unknown has moved further than this, in the plan's unit, in this
/// number of passes. One pass is not enough: an oscillation stands still where it turns.
const STILL: f32 = 5e-5;
const STILL_PASSES: u32 = 10;

/// The result of a settling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsRest {
    /// Whether the last passes moved nothing.
    pub at_rest: bool,
    /// Passes in all.
    pub passes: u32,
    /// The measures of the last pass.
    pub seen: CrossingsSeen,
}

/// Lets crossings come to rest on a device, and leaves them there. `watch` sees every pass. If it
/// breaks off, the run ends after that pass, or after the passes that were asked for together with
/// it, ten at most.
///
/// In fifty passes threads grow from four tenths of their area, while penalties that part them
/// harden. Then passes follow until nothing moves, as many as the problem allows. The device gets
/// as many passes at once as are certainly needed to reach rest.
///
/// **Errors**: [`BackendError`] of the device.
pub fn settle(
    plan: &CrossingsPlan,
    settler: &mut dyn CrossingsSettler,
    mut watch: impl FnMut(&CrossingsPass, &CrossingsSeen) -> ControlFlow<()>,
) -> Result<CrossingsRest, BackendError> {
    settler.upload(&plan.start()?)?;
    let mut rest = CrossingsRest { at_rest: false, passes: 0, seen: CrossingsSeen::NOTHING };
    let mut still = 0;
    while rest.passes < plan.passes() && !rest.at_rest {
        // Rest needs all of these passes to stand still, so it can't come before the last of them.
        let last = plan.passes().min(rest.passes + STILL_PASSES - still);
        let passes: Vec<CrossingsPass> = (rest.passes..last).map(CrossingsPass::of).collect();
        let broken_off = settler.passes(&passes, &mut |pass, seen| {
            rest.seen = seen;
            still = if rest.passes > GROWING && seen.step < STILL { still + 1 } else { 0 };
            rest.passes += 1;
            rest.at_rest = still == STILL_PASSES;
            watch(pass, &seen)
        })?;
        if broken_off.is_break() {
            break;
        }
    }
    Ok(rest)
}
