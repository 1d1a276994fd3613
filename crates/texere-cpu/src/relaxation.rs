//! What both CPU relaxers share: their memory, the lists of neighbours, and the sum of all pulls.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::{WorkWatch, filled};
use texere_core::relaxation::{
    RelaxationLists, RelaxationPlan, RelaxationPull, RelaxationSamples, RelaxationSeen, RelaxationState,
};

use crate::asked::in_parts;

/// The number of intervals whose samples are worked out between two questions to the caller whether
/// to go on.
const PART: usize = 4096;

/// The samples of a state, the lists of neighbours, and the pulls of all intervals.
#[derive(Debug)]
pub(crate) struct RelaxationMemory {
    pub(crate) plan: Arc<RelaxationPlan>,
    samples: RelaxationSamples,
    lists: Option<RelaxationLists>,
    pulls: Vec<RelaxationPull>,
}

impl RelaxationMemory {
    /// Allocates the memory for `plan`.
    pub(crate) fn new(plan: Arc<RelaxationPlan>) -> Result<Self, BackendError> {
        let samples = RelaxationSamples::new(&plan)?;
        let pulls = filled("pulls of intervals", plan.intervals().len(), RelaxationPull::default())?;
        Ok(Self { plan, samples, lists: None, pulls })
    }

    /// Measures a state. `pull_all` works out the pull of each interval with the function that it
    /// gets, which takes the interval's number.
    pub(crate) fn measure(
        &mut self,
        state: &RelaxationState,
        growth: f64,
        watch: WorkWatch<'_>,
        pull_all: impl FnOnce(
            &(dyn Fn(usize, &mut RelaxationPull) -> Result<(), BackendError> + Sync),
            &mut [RelaxationPull],
            WorkWatch<'_>,
        ) -> Result<ControlFlow<()>, BackendError>,
    ) -> Result<ControlFlow<(), RelaxationSeen>, BackendError> {
        let Self { plan, samples, lists, pulls } = self;
        let sampled = in_parts(plan.intervals().len(), PART, watch, |part| samples.place(plan, state, part));
        if sampled.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let lists = match lists.take().filter(|lists| lists.hold(plan, state, growth)) {
            Some(held) => lists.insert(held),
            None => match RelaxationLists::new(plan, state, growth, samples, watch)? {
                ControlFlow::Continue(made) => lists.insert(made),
                ControlFlow::Break(()) => return Ok(ControlFlow::Break(())),
            },
        };
        let measure = |interval: usize, pull: &mut RelaxationPull| {
            pull.measure(plan, state, growth, interval, samples, lists.of(interval))
        };
        let pulled = pull_all(&measure, pulls, watch)?;
        Ok(pulled.map_continue(|()| RelaxationSeen::of(plan, pulls)))
    }
}
