//! The reference relaxer: one interval after the other on one thread.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::relaxation::{RelaxationPlan, RelaxationSeen, RelaxationState, Relaxer};

use crate::asked::in_slices;
use crate::relaxation::RelaxationMemory;

/// The number of intervals between two questions to the caller whether to go on.
const PART: usize = 256;

/// The reference relaxer.
#[derive(Debug)]
pub(crate) struct SerialRelaxer(pub(crate) RelaxationMemory);

impl Relaxer for SerialRelaxer {
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
            in_slices(pulls, PART, watch, |first, pulls| {
                (first..).zip(pulls).try_for_each(|(number, pull)| measure(number, pull))
            })
        })
    }
}
