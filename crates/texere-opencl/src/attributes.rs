//! Attributes of vertices: their kernels, and the lengths along yarns.

use std::ops::Range;

use bytemuck::bytes_of;
use texere_core::backend::{Chunk, Plan, Schedule};
use texere_core::{ArcLength, BackendError};
use texere_gpu::Params;
use texere_kernels::{ATTRIBUTES_OF_CAPS, ATTRIBUTES_OF_TUBES, BLOCK_LENGTHS, YARN_LENGTHS};

use crate::buffer::Buffer;
use crate::chunk_memory::ChunkMemory;
use crate::kernel::{Arg, Kernel, in_memory};
use crate::opened::Opened;
use crate::work::{Launches, Work};

/// The kernels and the memory that an engine needs if attributes are asked for.
#[derive(Debug)]
pub(crate) struct Attributes {
    block_lengths: Kernel,
    yarn_lengths: Kernel,
    of_tubes: Kernel,
    of_caps: Kernel,
    /// For each block, the length of its yarn up to the block's first ring.
    pub(crate) lengths: Buffer,
}

impl Attributes {
    /// Allocates memory, and compiles the kernels unless an engine has done so before.
    ///
    /// **Errors**: [`BackendError::NoAttributes`] in the schedule per-yarn,
    /// [`BackendError::OutOfMemory`], [`BackendError::Compile`], and [`BackendError::Driver`] or
    /// [`BackendError::DeviceLost`] if another call of OpenCL fails.
    pub(crate) fn new(opened: &Opened, plan: &Plan) -> Result<Self, BackendError> {
        if opened.schedule != Schedule::PerRing {
            return Err(BackendError::NoAttributes);
        }
        let program = opened.attributes()?;
        let bytes = plan.block_count() * size_of::<ArcLength>() as u64;
        Ok(Self {
            block_lengths: Kernel::of(opened, program, BLOCK_LENGTHS)?,
            yarn_lengths: Kernel::of(opened, program, YARN_LENGTHS)?,
            of_tubes: Kernel::of(opened, program, ATTRIBUTES_OF_TUBES)?,
            of_caps: Kernel::of(opened, program, ATTRIBUTES_OF_CAPS)?,
            lengths: Buffer::new(opened, "lengths along yarns", bytes)?,
        })
    }

    /// The first half of measuring: the length of each block of the chunk.
    pub(crate) fn block_lengths(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let (params, window) = (Params::new(work.plan, chunk), chunk.window().start);
        let args = [&work.inputs(&params, &window, memory)[..5], &[Arg::Memory(&self.lengths)]].concat();
        // SAFETY: the arguments are those of `block_lengths`. A group reads its row of the chunk's
        // table and what the row names, and writes its block's length. There is a length for each
        // block of the plan. A row for a repeated ring writes 0 for the next chunk's first block,
        // whose length the next chunk's row writes later.
        unsafe { self.block_lengths.run(work.opened, &args, 0..memory.rows, memory.ready.as_deref()) }
    }

    /// The second half of measuring: the lengths of `yarns` up to each of their blocks' starts.
    pub(crate) fn yarn_lengths(
        &mut self,
        work: Work<'_>,
        yarns: Range<usize>,
    ) -> Result<Launches, BackendError> {
        let args = in_memory([&work.tables.yarns, &self.lengths]);
        // SAFETY: the arguments are those of `yarn_lengths`. A group reads its yarn's row, and
        // reads and writes the lengths of the yarn's blocks. There is a length for each block of
        // the plan.
        unsafe { self.yarn_lengths.run(work.opened, &args, yarns, None) }
    }

    /// Makes the attributes of the chunk's vertices. `memory` has room for all of them.
    pub(crate) fn make(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, .. } = work;
        let (params, window) = (Params::new(plan, chunk), chunk.window().start);
        let outputs = in_memory([&self.lengths, &memory.attributes]);
        let args = [&work.inputs(&params, &window, memory)[..5], &outputs].concat();
        // SAFETY: the arguments are those of `attributes`. A group reads its row of the chunk's
        // table and what the row names, and writes the attributes of the row's vertices, for all of
        // which there is room.
        let tubes = unsafe { self.of_tubes.run(opened, &args, 0..memory.rows, memory.ready.as_deref()) }?;
        let caps = in_memory([&memory.caps, &memory.attributes]);
        let args = [&[Arg::Value(bytes_of(&params))][..], &caps].concat();
        let lanes = params.caps as usize * params.sides as usize;
        // SAFETY: the arguments are those of `cap_attributes`. A lane reads its cap's row and an
        // attribute of the ring that the row names, and writes one attribute, for all of which
        // there is room. Lanes past the last do nothing.
        let caps = unsafe { self.of_caps.run(opened, &args, 0..lanes.div_ceil(self.of_caps.group()), None) }?;
        Ok([tubes, caps].concat())
    }
}
