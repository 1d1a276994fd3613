//! The schedule per-yarn, the paper's: a lane makes a yarn, or as much of it as a device lets it.

use texere_core::BackendError;
use texere_shaders::{MESH_PER_YARN, TRAJECTORY_PER_YARN};

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// Rounds that all loops of a lane together may make on a software device: after so many llvmpipe
/// ends them, and says nothing.
const SOFTWARE_ROUNDS: u32 = 65_535;

/// The compiled shaders of the schedule.
#[derive(Debug)]
pub(crate) struct PerYarn {
    pub(crate) trajectory: Kernel,
    pub(crate) mesh: Kernel,
}

impl PerYarn {
    /// The shaders for round yarns alone, or for all.
    ///
    /// **Errors**: [`BackendError::Compile`].
    pub(crate) fn new(gpu: &Gpu, flattened: bool) -> Result<Self, BackendError> {
        Ok(Self {
            trajectory: Kernel::new(gpu, &TRAJECTORY_PER_YARN, flattened)?,
            mesh: Kernel::new(gpu, &MESH_PER_YARN, flattened)?,
        })
    }
}

/// Most rings of a lane: a whole part, as the paper has it, wherever the device lets a lane take
/// that long.
pub(crate) fn lane_rings(gpu: &Gpu, sides: u32) -> u32 {
    match gpu.device.adapter_info().device_type {
        // For each ring `mesh_per_yarn` goes round once a vertex, three times for its components,
        // six times for its indices, and once more to leave each loop.
        wgpu::DeviceType::Cpu => SOFTWARE_ROUNDS / (12 * (sides + 1)),
        _ => u32::MAX,
    }
}
