//! The samples of yarns in one state.

use std::ops::Range;

use glam::DVec3;

use super::{RelaxationInterval, RelaxationPlan, RelaxationState};
use crate::BackendError;
use crate::backend::filled;

/// The places of the samples of all intervals in one state, and for each interval a ball that holds
/// its samples.
#[derive(Debug, Clone)]
pub struct RelaxationSamples {
    positions: Vec<DVec3>,
    balls: Vec<Ball>,
}

/// A ball that holds the samples of an interval. Its middle is that of the box round the samples.
/// Its radius, mm, is the largest distance of a sample from the middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) middle: DVec3,
    pub(super) radius: f64,
}

impl RelaxationSamples {
    /// Memory for the samples of `plan`. All lie at the origin.
    ///
    /// **Errors**: [`BackendError`] for short memory.
    pub fn new(plan: &RelaxationPlan) -> Result<Self, BackendError> {
        let none = Ball { middle: DVec3::ZERO, radius: 0.0 };
        Ok(Self {
            positions: filled("samples", plan.samples(), DVec3::ZERO)?,
            balls: filled("intervals", plan.intervals().len(), none)?,
        })
    }

    /// Works out the samples of the intervals with these numbers in `state`.
    pub fn place(&mut self, plan: &RelaxationPlan, state: &RelaxationState, numbers: Range<usize>) {
        for number in numbers {
            let interval = &plan.intervals()[number];
            let own = &mut self.positions[interval.sampled()];
            plan.sample(state, interval, own);
            self.balls[number] = Ball::around(own);
        }
    }

    /// The places of an interval's samples, mm.
    pub(super) fn of(&self, interval: &RelaxationInterval) -> &[DVec3] {
        &self.positions[interval.sampled()]
    }

    /// The balls of all intervals.
    pub(super) fn balls(&self) -> &[Ball] {
        &self.balls
    }
}

impl Ball {
    fn around(positions: &[DVec3]) -> Self {
        let far = DVec3::splat(f64::INFINITY);
        let (low, high) = positions.iter().fold((far, -far), |(low, high), at| (low.min(*at), high.max(*at)));
        let middle = 0.5 * (low + high);
        let square = positions.iter().map(|at| at.distance_squared(middle)).fold(0.0, f64::max);
        // Rounding must put no sample outside.
        Self { middle, radius: square.sqrt() * (1.0 + 1e-9) }
    }

    /// Whether a sample of this ball may be nearer than `reach` to one of the other.
    pub(super) fn touches(&self, other: &Self, reach: f64) -> bool {
        let reach = reach + self.radius + other.radius;
        self.middle.distance_squared(other.middle) < reach * reach
    }
}
