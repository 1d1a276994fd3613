//! The kernels of packed vertices.

use texere_core::BackendError;
use texere_core::backend::{Chunk, Plan, Schedule};
use texere_gpu::Params;
use texere_kernels::{PACKED, PACKED_CAPS, PACKED_ODD};

use crate::chunk_memory::ChunkMemory;
use crate::kernel::{Arg, Kernel};
use crate::opened::Opened;
use crate::work::{Launches, Work};

/// The kernels that an engine needs if packed vertices are asked for.
#[derive(Debug)]
pub(crate) struct Packed {
    tubes: Kernel,
    caps: Kernel,
}

impl Packed {
    /// Compiles the kernels for round yarns alone, or, with `flattened`, for all yarns, unless an
    /// engine has done so before.
    ///
    /// **Errors**: [`BackendError::NoPacking`] in the schedule per-yarn, [`BackendError::Compile`],
    /// and [`BackendError::Driver`] or [`BackendError::DeviceLost`] if another call of OpenCL
    /// fails.
    pub(crate) fn new(opened: &Opened, plan: &Plan, flattened: bool) -> Result<Self, BackendError> {
        if opened.schedule != Schedule::PerRing {
            return Err(BackendError::NoPacking);
        }
        let program = opened.packing(flattened)?;
        let tubes = if plan.settings().sides.is_multiple_of(2) { PACKED } else { PACKED_ODD };
        Ok(Self {
            tubes: Kernel::of(opened, program, tubes)?,
            caps: Kernel::of(opened, program, PACKED_CAPS)?,
        })
    }

    /// Makes the packed vertices of the chunk. `memory` has room for all of them.
    pub(crate) fn make(
        &mut self,
        work: Work<'_>,
        chunk: &Chunk,
        memory: &ChunkMemory,
    ) -> Result<Launches, BackendError> {
        let Work { opened, plan, tables } = work;
        let (params, window) = (Params::new(plan, chunk), chunk.window().start);
        let inputs = work.inputs(&params, &window, memory);
        let outputs = [Arg::Memory(&tables.outlines), Arg::Memory(&memory.packed)];
        let args = [&inputs[..], &outputs].concat();
        // SAFETY: the arguments are those of `packed`. A group reads its row of the chunk's table
        // and what the row names, and writes the row's packed vertices, for all of which there is
        // room.
        let tubes = unsafe { self.tubes.run(opened, &args, 0..memory.rows, memory.ready.as_deref()) }?;
        let args = [&inputs[..3], &[Arg::Memory(&memory.caps), Arg::Memory(&memory.packed)]].concat();
        let lanes = params.caps as usize * params.sides as usize;
        // SAFETY: the arguments are those of `packed_caps`. A lane reads its cap's row, what the
        // row names and a packed vertex of the ring, and writes one packed vertex, for all of which
        // there is room. Lanes past the last do nothing.
        let caps = unsafe { self.caps.run(opened, &args, 0..lanes.div_ceil(self.caps.group()), None) }?;
        Ok([tubes, caps].concat())
    }
}
