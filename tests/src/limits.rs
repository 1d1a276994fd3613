//! Tight limits, which cut a plan into several chunks.

use texere_core::backend::Plan;
use texere_core::{Limits, PlanError};

/// A limit of blocks cuts a plan into about this many chunks at most, because more chunks would
/// take a long time.
const CUTS: u64 = 40;

/// The limit that chunks are cut to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tight {
    /// No limit: one chunk, if the device takes it.
    Nothing,
    /// A limit of the blocks of a launch.
    Blocks,
    /// A limit of the bytes of the largest buffer.
    Binding,
    /// A limit of the bytes of all memory.
    Memory,
}

impl Tight {
    /// Limits with room for `room` times the largest block of `plan`, and for the ring that a cut
    /// repeats. A limit of blocks has more room if `plan` has very many blocks.
    #[must_use]
    pub fn limits(self, plan: &Plan, room: u64) -> Limits {
        let by_binding = |binding_bytes| Limits { binding_bytes, ..Limits::NONE };
        let by_memory = |memory_bytes| Limits { memory_bytes, ..Limits::NONE };
        match self {
            Self::Nothing => Limits::NONE,
            Self::Blocks => Limits { blocks: (room + 1).max(plan.block_count() / CUTS), ..Limits::NONE },
            Self::Binding => by_binding(room * least(plan, by_binding)),
            Self::Memory => {
                let resident = plan.resident_bytes();
                by_memory(resident + room * (least(plan, by_memory) - resident))
            }
        }
    }
}

/// The least value of a limit that holds the largest block of `plan`. It is found from the errors
/// of smaller values.
///
/// # Panics
///
/// If a refusal names another limit than the given one, or asks for no more than it.
#[must_use]
pub fn least(plan: &Plan, limits: impl Fn(u64) -> Limits) -> u64 {
    let mut limit = 0;
    while let Err(
        PlanError::BlockTooLarge { needed, limit: refused, .. }
        | PlanError::BlockOverCount { needed, limit: refused, .. },
    ) = plan.chunks(&limits(limit))
    {
        assert!(refused == limit && needed > limit);
        limit = needed;
    }
    limit
}
