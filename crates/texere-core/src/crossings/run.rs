//! The course: how threads grow, how penalties harden, and when it is done.

use std::ops::ControlFlow;

use super::{CrossingsPlan, CrossingsSeen, CrossingsSettler};
use crate::BackendError;

/// In so many passes threads grow and penalties harden.
const GROWING: u32 = 50;

/// The share of their area that threads have at first.
const THIN: f64 = 0.4;

/// Penalties at first and in the end.
const PENALTIES: [f64; 2] = [30.0, 1000.0];

/// It is at rest where no unknown has moved further than that in so many passes, in the plan's
/// unit. One pass would not do: what swings stands still where it turns.
const STILL: f32 = 5e-5;
const STILL_PASSES: u32 = 10;

/// What a pass goes by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsPass {
    /// The weight of terms that keep threads apart.
    pub penalty: f32,
    /// The share of its area that a thread wants.
    pub area: f32,
}

impl CrossingsPass {
    /// Pass number `number` of the course, from 0.
    ///
    /// ```
    /// use texere_core::crossings::CrossingsPass;
    /// assert_eq!(CrossingsPass::of(200), CrossingsPass { penalty: 1000.0, area: 1.0 });
    /// ```
    #[must_use]
    pub fn of(number: u32) -> Self {
        let grown = (f64::from(number) / f64::from(GROWING)).min(1.0);
        let [soft, hard] = PENALTIES;
        Self {
            penalty: (soft * (hard / soft).powf(grown)) as f32,
            area: (THIN + (1.0 - THIN) * grown) as f32,
        }
    }
}

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
