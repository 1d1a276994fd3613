//! Memory that stays on the device as long as its engine: control points, the plan's tables and the
//! rolls.

use std::ops::Range;

use texere_core::backend::Plan;
use texere_core::definitions::index_pattern;
use texere_core::{ArcLength, BackendError};
use texere_gpu::{Params, YarnRow, cap_pattern, lean_count, lean_rows};
use wgpu::BufferUsages;

use crate::buffer::Buffer;
use crate::gpu::Gpu;
use crate::parameters::PARAMETERS;

/// The plan's tables, which all chunks read, and the rolls.
#[derive(Debug)]
pub(crate) struct Tables {
    /// All control points, padded. A chunk binds its window.
    pub(crate) points: wgpu::Buffer,
    pub(crate) yarns: Buffer,
    pub(crate) rolls: Buffer,
    /// For each block, the length of its yarn up to the block's first ring. Empty until attributes
    /// are asked for.
    pub(crate) lengths: Buffer,
    pub(crate) outlines: Buffer,
    pub(crate) pattern: Buffer,
    pub(crate) cap_pattern: Buffer,
    /// The parameters of the launches over yarns, which make rolls or measure yarns.
    pub(crate) of_yarns: Buffer,
}

impl Tables {
    /// Sends the plan's tables.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub(crate) fn new(gpu: &Gpu, plan: &Plan) -> Result<Self, BackendError> {
        let input = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let table = |what, bytes: &[u8]| {
            let mut table = Buffer::new(gpu, what, input)?;
            table.write(gpu, bytes)?;
            Ok::<_, BackendError>(table)
        };
        let mut tables = Self {
            // The buffer is read back if a part of settled points is edited.
            points: gpu.buffer("control points", plan.resident_bytes(), input | BufferUsages::COPY_SRC)?,
            yarns: table("yarns", bytemuck::cast_slice(&YarnRow::all(plan)))?,
            rolls: Buffer::new(gpu, "rolls", input)?,
            lengths: Buffer::new(gpu, "lengths along yarns", BufferUsages::STORAGE)?,
            outlines: table("outlines", bytemuck::cast_slice(plan.outlines()))?,
            pattern: table("the index pattern", bytemuck::cast_slice(&index_pattern(plan.settings().sides)))?,
            cap_pattern: table("the cap pattern", bytemuck::cast_slice(&cap_pattern(plan)))?,
            of_yarns: Buffer::new(gpu, "parameters", PARAMETERS | BufferUsages::COPY_DST)?,
        };
        tables.reserve_rolls(gpu, plan)?;
        tables.set_leans(gpu, plan, 0..plan.layout().yarns().len())?;
        Ok(tables)
    }

    /// Makes room for rolls if any yarn turns.
    pub(crate) fn reserve_rolls(&mut self, gpu: &Gpu, plan: &Plan) -> Result<(), BackendError> {
        if plan.needs_scan() {
            // Behind the rolls of blocks lie the leans of rings.
            self.rolls.reserve(gpu, 4 * (Self::rolls_before_leans(plan) + lean_count(plan)))?;
        }
        Ok(())
    }

    /// Sends the leans of `yarns`.
    pub(crate) fn set_leans(&self, gpu: &Gpu, plan: &Plan, yarns: Range<usize>) -> Result<(), BackendError> {
        let (first, leans) = lean_rows(plan, yarns);
        if leans.is_empty() {
            return Ok(());
        }
        let place = 4 * (Self::rolls_before_leans(plan) + first);
        gpu.write(self.rolls.buffer(), place, bytemuck::cast_slice(&leans))
    }

    /// The number of values before the leans: the total turns of yarns and the rolls of blocks.
    fn rolls_before_leans(plan: &Plan) -> u64 {
        plan.layout().yarns().len() as u64 + plan.block_count()
    }

    /// Makes room for the lengths along yarns.
    pub(crate) fn reserve_lengths(&mut self, gpu: &Gpu, plan: &Plan) -> Result<(), BackendError> {
        self.lengths.reserve(gpu, plan.block_count() * size_of::<ArcLength>() as u64)?;
        Ok(())
    }

    /// Sets the yarns of the next launch over yarns.
    pub(crate) fn set_yarns(&mut self, gpu: &Gpu, params: &Params) -> Result<(), BackendError> {
        self.of_yarns.write(gpu, bytemuck::bytes_of(params))
    }
}

impl Tables {
    /// The bytes of all tables.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { points, yarns, rolls, lengths, outlines, pattern, cap_pattern, of_yarns: _ } = self;
        points.size()
            + [yarns, rolls, lengths, outlines, pattern, cap_pattern].map(Buffer::bytes).iter().sum::<u64>()
    }
}
