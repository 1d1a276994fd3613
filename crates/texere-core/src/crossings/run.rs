//! The course: how threads grow, how penalties harden, and when it is done.

use std::ops::ControlFlow;

use super::pass::GROWING;
use super::{CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler};
use crate::BackendError;

/// It is at rest where no unknown has moved further than that in so many passes, in the plan's
/// unit. One pass would not do: what swings stands still where it turns.
const STILL: f32 = 5e-5;
const STILL_PASSES: u32 = 10;

/// What came of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsRest {
    /// Whether the last passes moved nothing any more.
    pub at_rest: bool,
    /// Passes in all.
    pub passes: u32,
    /// What the last pass has seen.
    pub seen: CrossingsSeen,
}

/// Lets crossings come to rest on a device, and leaves them there. `watch` sees every pass, and may
/// break it off: after it, or after the passes that were asked for with it, ten at most.
///
/// Threads grow from four tenths of their area and are parted by penalties that harden, in fifty
/// passes. Then passes go on until nothing moves, as many as the problem allows. A device is asked
/// at once for as many passes as rest is away at least.
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
        // Rest takes all of these to stand still, so none of them comes after it.
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
