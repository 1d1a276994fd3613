//! The work of a device for crossings.

use std::any::Any;
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::{CrossingState, CrossingsPass, CrossingsPlan};
use crate::BackendError;
use crate::work_watch::WorkWatch;

/// The measures of a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsSeen {
    /// The longest step of any unknown, in the plan's unit.
    pub step: f32,
    /// The least distance of two threads before the step, divided by the distance that they need.
    /// It is 1 if they touch.
    pub clearance: f32,
}

impl CrossingsSeen {
    /// The measures before any pass.
    pub const NOTHING: Self = Self { step: 0.0, clearance: f32::INFINITY };

    /// The measures of two passes, or of two parts of a pass, together.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self { step: self.step.max(other.step), clearance: self.clearance.min(other.clearance) }
    }
}

/// The crossings of a plan on one device. [`settle`](super::settle) calls `upload` first, with as
/// many crossings as the plan has.
///
/// **Errors**: methods that can fail return a [`BackendError`], only for failures that could not be
/// foreseen.
pub trait CrossingsSettler: Any + Debug + Send {
    /// The plan of the settler.
    fn plan(&self) -> &Arc<CrossingsPlan>;

    /// Sets the states of all crossings, without momentum.
    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError>;

    /// Moves every crossing once. Each crossing reads the states of others that were written before
    /// the pass, and writes its own state for the next pass.
    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError>;

    /// Does what [`pass`](Self::pass) does, and asks `watch` a few times in each 50 ms whether to
    /// go on. After `Break` some crossings have moved and others have not.
    ///
    /// The provided method does not ask.
    fn pass_watched(
        &mut self,
        pass: &CrossingsPass,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), CrossingsSeen>, BackendError> {
        let _ = watch;
        self.pass(pass).map(ControlFlow::Continue)
    }

    /// Makes several passes. `watch` is called with the measures of every pass after the pass, and
    /// without measures while a pass is being made. A device that the host waits for may make all
    /// passes before the first call of `watch`. Any other device makes no pass after `watch` breaks
    /// off.
    fn passes(
        &mut self,
        passes: &[CrossingsPass],
        watch: &mut dyn FnMut(&CrossingsPass, Option<CrossingsSeen>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        for pass in passes {
            let goes_on = match self.pass_watched(pass, &mut || watch(pass, None))? {
                ControlFlow::Continue(seen) => watch(pass, Some(seen)),
                ControlFlow::Break(()) => ControlFlow::Break(()),
            };
            if goes_on.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Writes the present states of all crossings into `crossings`.
    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError>;
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn CrossingsSettler>();
};
