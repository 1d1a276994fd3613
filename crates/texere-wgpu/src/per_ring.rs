//! The schedule per-ring, in which a lane makes a ring.

use texere_core::BackendError;
use texere_shaders::{BLOCK_TURNS, CAPS, MESH, MESH_ODD, TRAJECTORY, YARN_ROLLS};

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// The compiled shaders of the schedule.
#[derive(Debug)]
pub(crate) struct PerRing {
    pub(crate) block_turns: Kernel,
    pub(crate) yarn_rolls: Kernel,
    pub(crate) trajectory: Kernel,
    /// The shader of tubes with an even number of sides.
    pub(crate) mesh: Kernel,
    pub(crate) mesh_odd: Kernel,
    pub(crate) caps: Kernel,
}

impl PerRing {
    /// Compiles the shaders for round yarns alone, or with `flattened` for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::DeviceLost`] for a lost device.
    pub(crate) fn new(gpu: &Gpu, flattened: bool) -> Result<Self, BackendError> {
        let kernel = |shader| Kernel::new(gpu, shader, flattened);
        Ok(Self {
            block_turns: kernel(&BLOCK_TURNS)?,
            yarn_rolls: kernel(&YARN_ROLLS)?,
            trajectory: kernel(&TRAJECTORY)?,
            mesh: kernel(&MESH)?,
            mesh_odd: kernel(&MESH_ODD)?,
            caps: kernel(&CAPS)?,
        })
    }
}
