//! The schedule per-yarn: how long a lane may take.

use crate::gpu::Gpu;

/// Rounds that all loops of a lane together may make on a software device: after so many llvmpipe
/// ends them, and says nothing.
const SOFTWARE_ROUNDS: u32 = 65_535;

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
