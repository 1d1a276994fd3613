//! The memory of crossings.

use texere_core::crossings::{CrossingState, CrossingsPlan};
use texere_core::{BackendError, Limits};
use texere_gpu::{CROSSINGS_PASSES, CrossingSite, CrossingsParams, CrossingsSeenRow, ThreadRow};
use texere_shaders::{Resource, crossings};
use wgpu::{BindingResource, BufferBinding, BufferSize, BufferUsages};

use crate::gpu::Gpu;
use crate::parameters::PARAMETERS;
use crate::room::Room;

/// The bytes from the parameters of a pass to those of the next. Every device can bind uniforms
/// and storage at multiples of this number.
pub(super) const PARAMS_STEP: u64 = 256;

/// The buffers that the shaders read and write.
#[derive(Debug)]
pub(super) struct Memory {
    /// The parameters of each pass between two waits.
    pub(super) params: wgpu::Buffer,
    threads: wgpu::Buffer,
    sites: wgpu::Buffer,
    /// The lies (states of threads at crossings) after the last pass, without momentum.
    pub(super) crossings: wgpu::Buffer,
    /// Two buffers of lies with momentum added. Each pass reads one and writes the other, for the
    /// next pass.
    pub(super) found: wgpu::Buffer,
    pub(super) next: wgpu::Buffer,
    /// The measures of each workgroup, and of each pass since the last wait.
    group_rows: wgpu::Buffer,
    pub(super) pass_rows: wgpu::Buffer,
}

impl Memory {
    pub(super) fn new(gpu: &Gpu, limits: &Limits, plan: &CrossingsPlan) -> Result<Self, BackendError> {
        let mut room = Room::new(gpu, limits);
        let (passes, rows) = (u64::from(CROSSINGS_PASSES), size_of::<CrossingsSeenRow>() as u64);
        let crossings = plan.crossings() as u64;
        let bytes = size_of::<CrossingState>() as u64 * crossings;
        let groups = crossings.div_ceil(crossings::MOVE.workgroup.into());
        let parameters = PARAMETERS | BufferUsages::COPY_DST;
        Ok(Self {
            params: gpu.buffer("parameters", PARAMS_STEP * passes, parameters)?,
            threads: room.holding(gpu, "the thread table", &ThreadRow::all(plan))?,
            sites: room.holding(gpu, "the table of crossings", &CrossingSite::all(plan))?,
            crossings: room.take(gpu, "crossings", bytes)?,
            found: room.take(gpu, "crossings as others find them", bytes)?,
            next: room.take(gpu, "crossings as others will find them", bytes)?,
            group_rows: room.take(gpu, "what groups have seen", rows * groups)?,
            pass_rows: room.take(gpu, "what was seen", rows * passes)?,
        })
    }

    /// The binding of `resource` in pass number `number` since the last wait. Two buffers
    /// alternate: each pass reads what the pass before has written.
    pub(super) fn resource(&self, resource: Resource, number: u32) -> Option<BindingResource<'_>> {
        let [found, next] =
            if number.is_multiple_of(2) { [&self.found, &self.next] } else { [&self.next, &self.found] };
        let buffer = match resource {
            Resource::CrossingsParams => {
                return Some(BindingResource::Buffer(BufferBinding {
                    buffer: &self.params,
                    offset: PARAMS_STEP * u64::from(number),
                    size: BufferSize::new(size_of::<CrossingsParams>() as u64),
                }));
            }
            Resource::ThreadRows => &self.threads,
            Resource::Sites => &self.sites,
            Resource::FoundCrossings => found,
            Resource::Crossings => &self.crossings,
            Resource::NextCrossings => next,
            Resource::CrossingsGroupRows => &self.group_rows,
            Resource::CrossingsPassRows => &self.pass_rows,
            _ => return None,
        };
        Some(buffer.as_entire_binding())
    }
}
