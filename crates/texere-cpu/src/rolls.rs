//! Rolls at block starts: all that a block needs to know of the yarn before it.

use texere_core::backend::{BLOCK_RINGS, Block, Plan};
use texere_core::definitions::Turn;

/// The result of a scan.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rolls {
    /// The roll at each block's first ring, before a closed yarn's whole turn is spread. Empty
    /// where no yarn turns.
    pub(crate) at_block: Vec<Turn>,
    /// The steps from a block's first ring to each ring, added up, yarn after yarn. Empty where no
    /// yarn turns, and where the stages add them up again.
    pub(crate) in_block: Vec<Turn>,
    /// The whole turn of each yarn. Empty where no yarn turns.
    pub(crate) whole: Vec<Turn>,
}

impl Rolls {
    /// The roll at the first ring of block `block`, counted over all yarns.
    pub(crate) fn at_block(&self, block: u64) -> Turn {
        self.at_block.get(block as usize).copied().unwrap_or(Turn::ZERO)
    }

    /// The roll of ring `ring` of `yarn`, where steps up to it add up to `sum`. Along a closed yarn
    /// the whole turn is taken away bit by bit, so that its last ring meets its first.
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
