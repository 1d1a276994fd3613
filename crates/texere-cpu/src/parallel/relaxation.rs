//! Relaxation on all cores, with the same bits as the reference.

use std::ops::ControlFlow;
use std::sync::Arc;

use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::relaxation::{RelaxationPlan, RelaxationSeen, RelaxationState, Relaxer};

use crate::asked::{for_all_threads, in_slices};
use crate::relaxation::RelaxationMemory;

/// The least number of intervals of one task. Intervals of stockinette take some 20 µs each.
const TASK: usize = 4;

/// The relaxer on all cores.
#[derive(Debug)]
pub(crate) struct ParallelRelaxer(pub(crate) RelaxationMemory);

impl Relaxer for ParallelRelaxer {
    fn plan(&self) -> &Arc<RelaxationPlan> {
        &self.0.plan
    }

    fn measure(
        &mut self,
        state: &RelaxationState,
        growth: f64,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), RelaxationSeen>, BackendError> {
        self.0.measure(state, growth, watch, |measure, pulls, watch| {
            in_slices(pulls, for_all_threads(4 * TASK), watch, |first, pulls| {
                // Sums are made of all pulls in their order, so they do not depend on the tasks.
                let pulls = pulls.par_iter_mut().with_min_len(TASK).enumerate();
                pulls.try_for_each(|(number, pull)| measure(first + number, pull))
            })
        })
    }
}
