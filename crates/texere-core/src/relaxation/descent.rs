//! The direction of the next step: the method of limited memory by Broyden, Fletcher, Goldfarb and
//! Shanno.

use std::collections::VecDeque;

/// The number of steps that are remembered. With 6, rib takes a third more steps to rest; with 24,
/// it takes as many as with 12. With half the value, and with twice, no test is red.
const REMEMBERED: usize = 12;

/// The least cosine between a step and the change of slopes that the step makes. A step that is
/// nearly perpendicular to this change says nothing about the curvature. With half the value, and
/// with twice, no test is red.
const COSINE: f64 = 1e-12;

/// The last steps, and how they have changed the slopes.
///
/// **Source**: Nocedal, "Updating quasi-Newton matrices with limited storage", Mathematics of
/// Computation 35, 1980, its two loops.
#[derive(Debug, Default)]
pub(super) struct Descent {
    steps: VecDeque<Step>,
}

#[derive(Debug)]
struct Step {
    step: Vec<f64>,
    change: Vec<f64>,
    /// The product of step and change.
    product: f64,
}

impl Descent {
    /// Whether no step is remembered.
    pub(super) fn is_new(&self) -> bool {
        self.steps.is_empty()
    }

    /// Forgets all steps.
    pub(super) fn forget(&mut self) {
        self.steps.clear();
    }

    /// Remembers a step, and the change of slopes from its start to its end.
    pub(super) fn learn(&mut self, step: Vec<f64>, change: Vec<f64>) {
        let product = dot(&step, &change);
        if product <= COSINE * dot(&step, &step).sqrt() * dot(&change, &change).sqrt() {
            return;
        }
        if self.steps.len() == REMEMBERED {
            self.steps.pop_front();
        }
        self.steps.push_back(Step { step, change, product });
    }

    /// The direction of the next step, for these slopes. `first` replaces forces by the step that
    /// they would make if no step were remembered. It must be a symmetric and positive map.
    pub(super) fn direction(&self, slopes: &[f64], first: impl Fn(&mut [f64])) -> Vec<f64> {
        let mut way: Vec<f64> = slopes.iter().map(|slope| -slope).collect();
        let mut shares = Vec::with_capacity(self.steps.len());
        for step in self.steps.iter().rev() {
            let share = dot(&step.step, &way) / step.product;
            shares.push(share);
            add(&mut way, -share, &step.change);
        }
        first(&mut way);
        if let Some(last) = self.steps.back() {
            let mut step = last.change.clone();
            first(&mut step);
            let scale = last.product / dot(&last.change, &step);
            way.iter_mut().for_each(|way| *way *= scale);
        }
        for (step, share) in self.steps.iter().zip(shares.iter().rev()) {
            let back = dot(&step.change, &way) / step.product;
            add(&mut way, share - back, &step.step);
        }
        way
    }
}

pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

fn add(sum: &mut [f64], factor: f64, other: &[f64]) {
    for (sum, other) in sum.iter_mut().zip(other) {
        *sum += factor * other;
    }
}
