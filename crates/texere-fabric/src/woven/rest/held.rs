//! Dense woven cloth of mixed threads, which rests with its threads held in their places.

use std::ops::ControlFlow;

use texere_core::Backend;

use super::certificate::ENOUGH;
use super::problem::rooms;
use super::{Certified, SETTLED};
use crate::diagnosis::is_clear;
use crate::{Finish, FinishError, Thread, Woven};

impl Woven {
    /// Whether the threads of a set differ in what decides how they are pressed. Colors, and
    /// sections that need equal room, don't count.
    pub(super) fn is_mixed(&self) -> bool {
        let kind = |(thread, room): (&Thread, [f32; 2])| {
            let Thread { radius_mm, flatness, stiffness, firmness, least_area, .. } = *thread;
            (room, [radius_mm, flatness, stiffness, firmness, least_area])
        };
        [self.warp(), self.weft()].into_iter().zip(rooms(self)).any(|(threads, rooms)| {
            let mut kinds = threads.iter().zip(rooms).map(kind);
            let first = kinds.next();
            kinds.any(|kind| Some(kind) != first)
        })
    }

    /// The crossings at rest with no thread shifted sideways, if they are clear, or nearer to it
    /// than `free`, and `free` otherwise. In dense cloth of hard and soft threads, energy is
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
        let worth = |rest: &Certified| {
            let clearance = rest.clearance[1];
            (is_clear(clearance, rest.bend), (clearance / ENOUGH).min(rest.bend))
        };
        Ok(if worth(&held) > worth(&free) { held } else { free })
    }
}
