//! The work of a device for crossings.

use std::any::Any;
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::{CrossingState, CrossingsPass, CrossingsPlan};
use crate::BackendError;

/// The measures of a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsSeen {
    /// The longest step of any unknown, in the plan's unit.
    pub step: f32,
    /// The least distance of two threads before the step, divided by the distance that they need: 1
    /// where they touch.
    pub clearance: f32,
}

impl CrossingsSeen {
    /// The measures of no pass.
    pub const NOTHING: Self = Self { step: 0.0, clearance: f32::INFINITY };

    /// The measures of two passes or parts of a pass together.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self { step: self.step.max(other.step), clearance: self.clearance.min(other.clearance) }
    }
}

/// Crossings on one device. [`settle`](super::settle) calls it: first `upload`, with as many
/// crossings as the plan has.
///
/// **Errors**: all methods return a [`BackendError`] for failures that could not be foreseen, and
/// for nothing else.
pub trait CrossingsSettler: Any + Debug + Send {
    /// The plan of the settler.
    fn plan(&self) -> &Arc<CrossingsPlan>;

    /// Takes the states of all crossings, all at rest.
    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError>;

    /// Moves every crossing once. Each reads the states that all crossings showed before the pass,
    /// and afterwards shows its own new state.
    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError>;

    /// Makes several passes, and calls `watch` with the measures of each. A device that the host
    /// waits for may make all of them first. Any other makes no more after `watch` breaks off.
    fn passes(
        &mut self,
        passes: &[CrossingsPass],
        watch: &mut dyn FnMut(&CrossingsPass, CrossingsSeen) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        for pass in passes {
            if watch(pass, self.pass(pass)?).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Writes the present states of all crossings.
    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError>;
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn CrossingsSettler>();
};
