//! What a device does for crossings.

use std::any::Any;
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::{CrossingState, CrossingsPass, CrossingsPlan};
use crate::BackendError;

/// What a pass has seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingsSeen {
    /// The longest step of any unknown, in the plan's unit.
    pub step: f32,
    /// The least distance of two threads before the step, over what they need: 1 where they touch.
    pub clearance: f32,
}

impl CrossingsSeen {
    /// Nothing yet.
    pub const NOTHING: Self = Self { step: 0.0, clearance: f32::INFINITY };

    /// What either has seen.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self { step: self.step.max(other.step), clearance: self.clearance.min(other.clearance) }
    }
}

/// Crossings on one device. [`settle`](super::settle) calls it: `upload` comes first, with as many
/// crossings as the plan has.
///
/// All methods give back a [`BackendError`] for what could not be foreseen, and nothing else.
pub trait CrossingsSettler: Any + Debug + Send {
    /// The plan that it works on.
    fn plan(&self) -> &Arc<CrossingsPlan>;

    /// Takes all crossings, none of which is moving.
    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError>;

    /// Moves every crossing once. Each reads where all were found before the pass, and says where
    /// it is found after it.
    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError>;

    /// Makes passes one after the other, and hands over what each has seen. A device that is waited
    /// for may make all of them first; another one makes no more where `watch` breaks off.
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

    /// Writes the present crossings.
    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError>;
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn CrossingsSettler>();
};
