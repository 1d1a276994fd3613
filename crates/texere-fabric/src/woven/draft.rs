//! The draft: a weaver's plan of a weave, and the drawdown that the loom makes of it.

use std::collections::HashMap;

use texere_core::backend::zeroed;

use super::drawdown::{CROSSINGS_MAX, WORD};
use crate::{Drawdown, FabricError, WovenError};

/// The most shafts or treadles of a loom that readers of drafts take: enough for a Jacquard machine
/// with a hook for each end.
pub const LOOM_MAX: u32 = 100_000;

/// A weaver's draft: which shafts carry each end, and which shafts each pick lifts.
///
/// Shafts and treadles are counted from 1, as weavers write them. 0 stands for none, and a list may
/// be empty.
///
/// ```
/// use texere_fabric::{Draft, Shedding};
/// // A 2/2 twill on four shafts, straight draft.
/// let straight: Vec<_> = (0..8).map(|thread| vec![thread % 4 + 1]).collect();
/// let draft = Draft {
///     threading: straight.clone(),
///     shedding: Shedding::TieUp {
///         tie_up: vec![vec![1, 2], vec![2, 3], vec![3, 4], vec![4, 1]],
///         treadling: straight,
///     },
///     rising_shed: true,
/// };
/// let drawdown = draft.drawdown()?;
/// assert!(drawdown.up(0, 0) && drawdown.up(1, 0) && !drawdown.up(2, 0) && !drawdown.up(3, 0));
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draft {
    /// The shafts that carry each end.
    pub threading: Vec<Vec<u32>>,
    /// The shafts or treadles of each pick.
    pub shedding: Shedding,
    /// Whether lifted shafts carry the warp to the face. With a sinking shed (`false`) the drawdown
    /// is inverted.
    pub rising_shed: bool,
}

/// How the picks of a draft lift their shafts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Shedding {
    /// Each pick presses treadles, which lift the shafts that are tied to them.
    TieUp {
        /// The shafts that are tied to each treadle. A treadle past the last one lifts nothing.
        tie_up: Vec<Vec<u32>>,
        /// The treadles that each pick presses.
        treadling: Vec<Vec<u32>>,
    },
    /// The shafts that each pick lifts directly, as on a dobby loom.
    LiftPlan(Vec<Vec<u32>>),
}

impl Shedding {
    /// One list for each pick: treadles or shafts.
    fn picks(&self) -> &[Vec<u32>] {
        match self {
            Self::TieUp { treadling, .. } => treadling,
            Self::LiftPlan(lifts) => lifts,
        }
    }
}

impl Draft {
    /// Number of ends.
    #[must_use]
    pub fn ends(&self) -> usize {
        self.threading.len()
    }

    /// Number of picks.
    #[must_use]
    pub fn picks(&self) -> usize {
        self.shedding.picks().len()
    }

    /// The drawdown that this draft weaves. The warp is up where the pick lifts one of the end's
    /// shafts.
    ///
    /// **Errors**: the errors of [`Drawdown::new`], and [`WovenError::TieUp`] if treadles times
    /// ends exceed 2³².
    pub fn drawdown(&self) -> Result<Drawdown, FabricError> {
        let mut drawdown = Drawdown::new(self.ends(), self.picks())?;
        let shafts = self.shafts()?;
        let lifts = match &self.shedding {
            Shedding::TieUp { tie_up, .. } => self.treadles(tie_up, &shafts)?,
            Shedding::LiftPlan(_) => shafts,
        };
        // Most picks repeat an earlier one, and are copied from it.
        let mut woven: HashMap<&[u32], usize> = HashMap::new();
        for (pick, list) in self.shedding.picks().iter().enumerate() {
            if let Some(&same) = woven.get(list.as_slice()) {
                drawdown.copy_pick(same, pick);
                continue;
            }
            woven.insert(list, pick);
            let row = drawdown.row_mut(pick);
            list.iter().filter_map(|number| lifts.get(number)).for_each(|lift| lift.raise(row));
        }
        if !self.rising_shed {
            drawdown.invert();
        }
        Ok(drawdown)
    }

    /// The ends on each shaft, by the number of the shaft.
    fn shafts(&self) -> Result<HashMap<u32, Lift>, FabricError> {
        let mut shafts: HashMap<u32, Vec<u32>> = HashMap::new();
        for (end, carried_by) in (0..).zip(&self.threading) {
            for &shaft in carried_by.iter().filter(|&&shaft| shaft > 0) {
                shafts.entry(shaft).or_default().push(end);
            }
        }
        let words = self.ends().div_ceil(WORD);
        shafts.into_iter().map(|(shaft, ends)| Ok((shaft, Lift::new(ends, words)?))).collect()
    }

    /// The ends that each treadle lifts, by the number of the treadle.
    fn treadles(
        &self,
        tie_up: &[Vec<u32>],
        shafts: &HashMap<u32, Lift>,
    ) -> Result<HashMap<u32, Lift>, FabricError> {
        let (treadles, ends) = (tie_up.len(), self.ends());
        if treadles as u64 > CROSSINGS_MAX / ends.max(1) as u64 {
            return Err(WovenError::TieUp { treadles, ends, limit: CROSSINGS_MAX }.into());
        }
        let row = |tied: &[u32]| {
            let mut row = zeroed("a tie-up", ends.div_ceil(WORD) as u64)?;
            tied.iter().filter_map(|shaft| shafts.get(shaft)).for_each(|lift| lift.raise(&mut row));
            Ok::<_, FabricError>(Lift::Many(row))
        };
        let tied = (1..).zip(tie_up).filter(|(_, tied)| !tied.is_empty());
        tied.map(|(treadle, tied)| Ok((treadle, row(tied)?))).collect()
    }
}

/// The ends that a shaft or a treadle lifts, in the form that takes less time to add to a row.
enum Lift {
    /// A list of ends.
    Few(Vec<u32>),
    /// A row of a drawdown.
    Many(Vec<u64>),
}

impl Lift {
    /// The lift of `ends`, in a cloth whose rows have `words` words. A list with one end for each
    /// word of a row takes as long to add as the row.
    fn new(ends: Vec<u32>, words: usize) -> Result<Self, FabricError> {
        let many = ends.len() > words;
        let few = Self::Few(ends);
        if !many {
            return Ok(few);
        }
        let mut row = zeroed("a threading", words as u64)?;
        few.raise(&mut row);
        Ok(Self::Many(row))
    }

    /// Puts these ends up in a row that is long enough for them.
    fn raise(&self, row: &mut [u64]) {
        match self {
            Self::Few(ends) => {
                for &end in ends {
                    row[end as usize / WORD] |= 1 << (end as usize % WORD);
                }
            }
            Self::Many(other) => {
                for (word, other) in row.iter_mut().zip(other) {
                    *word |= other;
                }
            }
        }
    }
}
