//! What plans and tables are known by.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Identifies the offsets of a plan within the process, which never change: its clones have the
/// same identity, resized ones, and those of a region of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlanId(u64);

impl PlanId {
    pub(super) fn next() -> Self {
        static PLANS: AtomicU64 = AtomicU64::new(0);
        Self(PLANS.fetch_add(1, Ordering::Relaxed))
    }
}

/// Identifies the tables of a chunk within its plan: chunks of one plan with the same identity have
/// the same tables, and differ at most in their place in the whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TablesId {
    pub(super) blocks: Range<u64>,
    /// 0 for a chunk as the plan cuts it. A patch, and a chunk that was cut again, has a number
    /// that no other has.
    pub(super) edit: u64,
}

impl TablesId {
    pub(super) fn next(blocks: Range<u64>) -> Self {
        static EDITS: AtomicU64 = AtomicU64::new(1);
        Self { blocks, edit: EDITS.fetch_add(1, Ordering::Relaxed) }
    }
}
