//! Dense woven cloth of mixed threads, which rests with its threads held in their places.

use std::ops::ControlFlow;

use texere_core::Backend;

use super::{Certified, SETTLED};
use crate::{Finish, FinishError, Thread, Woven};

impl Woven {
    /// Whether the threads of a set differ in size, stiffness or firmness.
    pub(super) fn is_mixed(&self) -> bool {
        let kind = |thread: &Thread| [thread.radius_mm, thread.stiffness, thread.firmness];
        let differ = |threads: &[Thread]| threads.windows(2).any(|pair| kind(&pair[0]) != kind(&pair[1]));
        differ(self.warp()) || differ(self.weft())
    }

    /// The crossings at rest with no thread shifted sideways, if their surfaces are clearer than
    /// those of `free`, and `free` otherwise. In dense cloth of hard and soft threads, energy is
    /// least where threads crowd beside the soft ones. Between two that crowd, a thread changes
    /// sides so steeply that its surface pierces theirs.
    pub(super) fn clearer_if_held(
        &self,
        free: Certified,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Certified, FinishError> {
        let (resting, rest) =
            self.resting(finish, tension, backend, true, |done| progress(SETTLED * done))?;
        let held = self.certified(resting, rest, |done| progress(SETTLED + (1.0 - SETTLED) * done))?;
        Ok(if held.clearance[1] > free.clearance[1] { held } else { free })
    }
}
