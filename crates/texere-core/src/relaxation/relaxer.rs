//! The work of a device for a relaxation.

use std::any::Any;
use std::fmt::Debug;
use std::iter;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3};

use super::{Energy, RelaxationPlan, RelaxationPull, RelaxationState};
use crate::BackendError;
use crate::work_watch::WorkWatch;

/// The energy of a state, and its forces.
#[derive(Debug, Clone, PartialEq)]
pub struct RelaxationSeen {
    /// The energy.
    pub energy: Energy,
    /// By how much the energy grows with each coordinate of each control point, N: the force at the
    /// point, with the opposite sign. There is one element per control point.
    pub slopes: Vec<DVec3>,
    /// By how much the energy grows with the repeat's length along x and y, N, if no control point
    /// moves.
    pub repeat: DVec2,
    /// The largest sum of contact forces on an interval, N.
    pub pressed: f64,
    /// The contact stiffness of each interval, N/mm: the sum over its samples, each as if the other
    /// yarns stood still.
    pub stiffness: Vec<DMat3>,
}

/// A relaxation on one device.
///
/// **Errors**: [`BackendError`] for failures that could not be foreseen, and
/// [`BackendError::Crowded`] if too many yarns lie in one place.
pub trait Relaxer: Any + Debug + Send {
    /// The plan of the relaxer.
    fn plan(&self) -> &Arc<RelaxationPlan>;

    /// The energy and the forces of `state`, for yarns with the share `growth` of their thickness.
    /// Asks `watch` a few times in each 50 ms whether to go on.
    fn measure(
        &mut self,
        state: &RelaxationState,
        growth: f64,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), RelaxationSeen>, BackendError>;
}

impl RelaxationSeen {
    /// The sums of the pulls of all intervals, in the order of intervals. A relaxer on a CPU adds
    /// them up so, on any number of threads.
    #[must_use]
    pub fn of(plan: &RelaxationPlan, pulls: &[RelaxationPull]) -> Self {
        let nothing = Energy::default();
        let points = plan.start().points.len();
        let mut seen = Self {
            energy: nothing,
            slopes: vec![DVec3::ZERO; points],
            repeat: DVec2::ZERO,
            pressed: 0.0,
            stiffness: vec![DMat3::ZERO; pulls.len()],
        };
        let mut pressed = vec![0.0; pulls.len()];
        for pull in pulls {
            for press in iter::once(&pull.own).chain(&pull.presses) {
                let interval = press.interval as usize;
                for (point, slope) in plan.window(interval).into_iter().zip(press.slopes) {
                    seen.slopes[point as usize] += slope;
                }
                pressed[interval] += press.pressed;
                seen.stiffness[interval] += press.stiffness;
            }
            seen.energy = seen.energy.and(pull.energy);
            seen.repeat += pull.repeat;
        }
        seen.pressed = pressed.into_iter().fold(0.0, f64::max);
        seen
    }
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn Relaxer>();
};
