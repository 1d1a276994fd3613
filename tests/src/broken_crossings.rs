//! Broken settlers of crossings. Each does one thing wrong, and the comparison with `cpu-serial`
//! has to find the fault.

use std::sync::Arc;

use texere_core::crossings::{
    CrossingState, Crossings, CrossingsPass, CrossingsPlan, CrossingsSeen, CrossingsSettler, Set,
};
use texere_core::{BackendError, CrossingsError};

/// The fault of a broken settler of crossings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CrossingsSabotage {
    /// No fault.
    None,
    /// The first crossing reads itself in place of its neighbour at the next end.
    LostNeighbour,
    /// Every crossing reads the other crossings as they were one pass before.
    StaleStep,
    /// The repeat is left out: there is nothing beyond the last end and the last pick.
    LostRepeat,
    /// There is no momentum.
    LostMomentum,
}

impl CrossingsSabotage {
    /// All faults.
    pub const ALL: [Self; 4] = [Self::LostNeighbour, Self::StaleStep, Self::LostRepeat, Self::LostMomentum];
}

/// A settler with code of its own, which is broken as its [`CrossingsSabotage`] says.
#[derive(Debug)]
pub struct SabotagedCrossings {
    sabotage: CrossingsSabotage,
    plan: Arc<CrossingsPlan>,
    /// The plan that the settler works by: the given plan, or one without the repeat.
    by: CrossingsPlan,
    crossings: Vec<CrossingState>,
    /// The crossings with momentum added, as other crossings read them.
    found: Vec<CrossingState>,
    /// The crossings with momentum added, as they were one pass before.
    before: Vec<CrossingState>,
}

impl SabotagedCrossings {
    /// A settler for a problem.
    ///
    /// # Errors
    ///
    /// The errors of [`CrossingsPlan::new`].
    pub fn new(sabotage: CrossingsSabotage, problem: &Crossings) -> Result<Self, CrossingsError> {
        let plan = CrossingsPlan::new(problem)?;
        let by = match sabotage {
            CrossingsSabotage::LostRepeat => CrossingsPlan::new(&problem.clone().repeats(false, false))?,
            _ => plan.clone(),
        };
        let crossings = vec![CrossingState::default(); plan.crossings()];
        let (found, before) = (crossings.clone(), crossings.clone());
        Ok(Self { sabotage, plan: Arc::new(plan), by, crossings, found, before })
    }

    /// All crossings as crossing `number` reads them.
    fn found_by(&self, number: usize) -> Vec<CrossingState> {
        let mut found = match self.sabotage {
            CrossingsSabotage::StaleStep => {
                let mut found = self.before.clone();
                found[number] = self.found[number];
                found
            }
            _ => self.found.clone(),
        };
        if self.sabotage == CrossingsSabotage::LostNeighbour
            && number == 0
            && let Some(next) = self.by.beside(self.by.site(0), Set::Warp, 0, 1)
        {
            found[self.by.number(next)] = found[number];
        }
        found
    }
}

impl CrossingsSettler for SabotagedCrossings {
    fn plan(&self) -> &Arc<CrossingsPlan> {
        &self.plan
    }

    fn upload(&mut self, crossings: &[CrossingState]) -> Result<(), BackendError> {
        for own in [&mut self.crossings, &mut self.found, &mut self.before] {
            own.copy_from_slice(crossings);
        }
        Ok(())
    }

    fn pass(&mut self, pass: &CrossingsPass) -> Result<CrossingsSeen, BackendError> {
        let (by, mut seen) = (&self.by, CrossingsSeen::NOTHING);
        let (mut next, mut crossings) = (self.found.clone(), self.crossings.clone());
        for (number, (crossing, next)) in crossings.iter_mut().zip(&mut next).enumerate() {
            let (site, found) = (by.site(number), self.found_by(number));
            let block = by.block(pass, &found, site);
            let moved = by.moved(&found[number], &block, site);
            *next = match self.sabotage {
                CrossingsSabotage::LostMomentum => moved,
                _ => by.ahead(crossing, &moved, &block, site),
            };
            seen = seen.and(CrossingsSeen { step: moved.difference(crossing), clearance: block.clearance });
            *crossing = moved;
        }
        self.crossings = crossings;
        self.before = std::mem::replace(&mut self.found, next);
        Ok(seen)
    }

    fn read(&mut self, crossings: &mut [CrossingState]) -> Result<(), BackendError> {
        crossings.copy_from_slice(&self.crossings);
        Ok(())
    }
}
