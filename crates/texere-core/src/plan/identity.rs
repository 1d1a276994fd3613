//! Identities of plans and of chunks' tables.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Identifies the offsets of a plan within the process. Offsets never change, so clones, edited
/// plans and plans of a region share the identity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlanId(u64);

impl PlanId {
    pub(super) fn next() -> Self {
        static PLANS: AtomicU64 = AtomicU64::new(0);
        Self(PLANS.fetch_add(1, Ordering::Relaxed))
    }
}

/// Identifies the tables of a chunk within its plan. Chunks of one plan whose identities are equal
/// have equal tables, and differ at most in their place in the whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TablesId {
    pub(super) blocks: Range<u64>,
    /// 0 for a chunk that the whole plan is cut into. Regions, patches, and chunks cut again after
    /// an edit, have numbers of their own.
    pub(super) edit: u64,
}

impl TablesId {
    pub(super) fn next(blocks: Range<u64>) -> Self {
        static EDITS: AtomicU64 = AtomicU64::new(1);
        Self { blocks, edit: EDITS.fetch_add(1, Ordering::Relaxed) }
    }
}
