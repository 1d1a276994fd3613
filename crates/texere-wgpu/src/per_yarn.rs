//! The paper's schedule, per-yarn. A lane makes a yarn, or as much of a yarn as a device allows.

use texere_core::BackendError;
use texere_shaders::{MESH_PER_YARN, TRAJECTORY_PER_YARN};

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// The most rounds that all loops of a lane together may make on a software device. llvmpipe ends
/// longer loops silently.
const SOFTWARE_ROUNDS: u32 = 65_535;

/// The compiled shaders of the schedule.
#[derive(Debug)]
pub(crate) struct PerYarn {
    pub(crate) trajectory: Kernel,
    pub(crate) mesh: Kernel,
}

impl PerYarn {
    /// Compiles the shaders for round yarns alone, or with `flattened` for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::DeviceLost`] for a lost device.
    pub(crate) fn new(gpu: &Gpu, flattened: bool) -> Result<Self, BackendError> {
        Ok(Self {
            trajectory: Kernel::new(gpu, &TRAJECTORY_PER_YARN, flattened)?,
            mesh: Kernel::new(gpu, &MESH_PER_YARN, flattened)?,
        })
    }
}

/// The most rings that a lane makes. The paper gives a lane a whole yarn. This schedule does the
/// same on devices that let a lane run for so long.
pub(crate) fn lane_rings(gpu: &Gpu, sides: u32) -> u32 {
    match gpu.device.adapter_info().device_type {
        // For each vertex of a ring, the loops of `mesh_per_yarn` make one round for the vertex,
        // three for its components and six for its indices. Each loop also makes one round to end.
        wgpu::DeviceType::Cpu => SOFTWARE_ROUNDS / (12 * (sides + 1)),
        _ => u32::MAX,
    }
}
