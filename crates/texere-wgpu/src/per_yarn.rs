//! The schedule per-yarn: what it does not do, and its table.

use texere_core::{BackendError, Block, Frame, Plan};

use crate::gpu::Gpu;

/// Refuses what the paper's algorithms don't do.
///
/// **Errors**: [`BackendError::Unsupported`], which names it.
pub(crate) fn check(plan: &Plan, schedule: &str) -> Result<(), BackendError> {
    let unsupported = |what: String| Err(BackendError::Unsupported { schedule: schedule.into(), what });
    if plan.settings().frame != Frame::Upright {
        return unsupported("rotation minimising frames".into());
    }
    if plan.settings().caps {
        return unsupported("caps".into());
    }
    for (number, yarn) in plan.layout().yarns().iter().enumerate() {
        if yarn.closed {
            return unsupported(format!("closed yarns, such as yarn {number}"));
        }
        if yarn.twist != 0.0 {
            return unsupported(format!("twist, such as that of yarn {number}"));
        }
    }
    Ok(())
}

/// Rounds that all loops of a lane together may make on a software device: after so many llvmpipe ends them, and says
/// nothing.
const SOFTWARE_ROUNDS: u32 = 65_535;

/// Most rings of a lane: a whole part, as the paper has it, wherever the device lets a lane take that long.
pub(crate) fn lane_rings(gpu: &Gpu, sides: u32) -> u32 {
    match gpu.device.adapter_info().device_type {
        // For each ring `mesh_per_yarn` goes round once a vertex, three times for its components, six times for its
        // indices, and once more to leave each loop.
        wgpu::DeviceType::Cpu => SOFTWARE_ROUNDS / (12 * (sides + 1)),
        _ => u32::MAX,
    }
}

/// One row a part, or a few where that has more than `most_rings`: consecutive blocks of a yarn as a single one, of more
/// rings than a block may have elsewhere.
pub(crate) fn part_rows(blocks: &[Block], most_rings: u32) -> Vec<Block> {
    let mut parts: Vec<Block> = Vec::new();
    for block in blocks {
        match parts.last_mut() {
            Some(part) if part.yarn == block.yarn && part.rings + block.rings <= most_rings => {
                part.rings += block.rings;
                part.quads += block.quads;
            }
            _ => parts.push(*block),
        }
    }
    parts
}
