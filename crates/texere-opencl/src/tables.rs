//! Memory that stays on the device as long as its engine: control points, the plan's tables and the
//! rolls.

use std::ops::Range;

use texere_core::backend::Plan;
use texere_core::definitions::{Turn, index_pattern};
use texere_core::{BackendError, Limits, OutOfMemory};
use texere_gpu::{YarnRow, cap_pattern, lean_count, lean_rows};

use crate::buffer::Buffer;
use crate::opened::Opened;

/// The plan's tables, which all chunks read, and the rolls.
#[derive(Debug)]
pub(crate) struct Tables {
    pub(crate) points: Buffer,
    pub(crate) yarns: Buffer,
    pub(crate) outlines: Buffer,
    /// The indices of a ring's quads.
    pub(crate) pattern: Buffer,
    pub(crate) cap_pattern: Buffer,
    /// The roll at each block's start, and behind them, if any yarn leans, the leans of all rings.
    /// Empty if no yarn turns.
    pub(crate) rolls: Buffer,
    /// The total turn of each yarn. Empty if no yarn turns.
    pub(crate) yarn_turns: Buffer,
}

impl Tables {
    /// **Errors**: [`BackendError::OutOfMemory`], also if the control points exceed one buffer.
    pub(crate) fn new(opened: &Opened, limits: &Limits, plan: &Plan) -> Result<Self, BackendError> {
        let (what, bytes) = ("control points, all in one buffer", plan.resident_bytes());
        // Kernels number points by `u32`.
        let points = plan.padded_offsets().last().copied().unwrap_or(0);
        if bytes > limits.binding_bytes || points > u64::from(u32::MAX) {
            return Err(BackendError::OutOfMemory(OutOfMemory { what, bytes }));
        }
        let mut tables = Self {
            // Points are zeros until they are uploaded, as on every backend.
            points: Buffer::zeroed(opened, what, bytes)?,
            yarns: Buffer::holding(opened, "the yarn table", &YarnRow::all(plan))?,
            outlines: Buffer::holding(opened, "outlines", plan.outlines())?,
            pattern: Buffer::holding(opened, "the index pattern", &index_pattern(plan.settings().sides))?,
            cap_pattern: Buffer::holding(opened, "the caps' index pattern", &cap_pattern(plan))?,
            rolls: Buffer::default(),
            yarn_turns: Buffer::default(),
        };
        tables.reserve_rolls(opened, plan)?;
        tables.set_leans(opened, plan, 0..plan.layout().yarns().len())?;
        Ok(tables)
    }

    /// Makes room for rolls if any yarn turns.
    pub(crate) fn reserve_rolls(&mut self, opened: &Opened, plan: &Plan) -> Result<(), BackendError> {
        if plan.needs_scan() {
            let turns = |count: u64| count * size_of::<Turn>() as u64;
            // Behind the rolls of blocks lie the leans of rings.
            self.rolls.reserve(opened, "rolls", turns(plan.block_count() + lean_count(plan)))?;
            self.yarn_turns.reserve(opened, "whole turns", turns(plan.counts().yarns))?;
        }
        Ok(())
    }

    /// Sends the leans of `yarns`.
    pub(crate) fn set_leans(
        &mut self,
        opened: &Opened,
        plan: &Plan,
        yarns: Range<usize>,
    ) -> Result<(), BackendError> {
        let (first, leans) = lean_rows(plan, yarns);
        let place = (plan.block_count() + first) * size_of::<Turn>() as u64;
        self.rolls.write(opened, &opened.queue, place, &leans, None)?;
        Ok(())
    }

    /// The bytes of all tables.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { points, yarns, outlines, pattern, cap_pattern, rolls, yarn_turns } = self;
        [points, yarns, outlines, pattern, cap_pattern, rolls, yarn_turns].map(Buffer::bytes).iter().sum()
    }
}
