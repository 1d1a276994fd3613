//! Rolls: how far sections are turned about their yarn, at the starts of blocks and from there to
//! each ring.

use texere_core::backend::{BLOCK_RINGS, Block, Plan};
use texere_core::definitions::Turn;

/// The result of a scan.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rolls {
    /// The roll at the first ring of each block. For a closed yarn, `closed_up` still has to take
    /// away each ring's share of the yarn's total turn. Empty if no yarn turns.
    pub(crate) at_block: Vec<Turn>,
    /// For each ring, the sum of the steps to it from the first ring of its block. The rings of a
    /// yarn follow those of the yarn before. The rings are none if no yarn turns. The serial
    /// functions don't use these sums.
    pub(crate) in_block: Sums,
    /// For each yarn, the sum of all its steps: the turn of its section from the first ring to the
    /// last. Empty if no yarn turns.
    pub(crate) whole: Vec<Turn>,
}

/// The sums of the steps inside blocks, for each ring of a plan.
#[derive(Debug, Clone)]
pub(crate) enum Sums {
    /// The sums of all rings so far.
    Kept(Vec<Turn>),
    /// The sums are not kept. A stage works out those of the rings that it makes.
    MadeAgain,
}

impl Default for Sums {
    fn default() -> Self {
        Self::Kept(Vec::new())
    }
}

impl Rolls {
    /// The roll at the first ring of block `block`, counted over all yarns.
    pub(crate) fn at_block(&self, block: u64) -> Turn {
        self.at_block.get(block as usize).copied().unwrap_or(Turn::ZERO)
    }

    /// The roll of ring `ring` of `yarn`, if the steps up to it add up to `sum`. In a closed yarn
    /// each ring loses its share of the yarn's total turn, so that the last ring has the roll of
    /// the first.
    pub(crate) fn closed_up(&self, plan: &Plan, yarn: usize, ring: u32, sum: Turn) -> Turn {
        if !plan.yarn(yarn).closed {
            return sum;
        }
        let steps = plan.rings(yarn) - 1;
        if ring == steps {
            return Turn::ZERO;
        }
        let whole = self.whole.get(yarn).copied().unwrap_or(Turn::ZERO);
        sum - whole.share(ring, steps)
    }
}

/// The number of the block that `row` describes, counted over all yarns.
pub(crate) fn block_number(plan: &Plan, row: &Block) -> u64 {
    plan.block_offsets()[row.yarn as usize] + u64::from(row.first_ring / BLOCK_RINGS)
}
