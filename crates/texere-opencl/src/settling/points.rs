//! Settled places turned into control points on the device, without going through the host.

use bytemuck::bytes_of;
use texere_core::BackendError;
use texere_core::backend::Plan;
use texere_core::settling::SettlingPlan;
use texere_gpu::{BoundsRow, EXTENT_GROUPS, SettledParams, SettledRow};
use texere_kernels::{EntryPoint, SETTLING_BOUNDS, SETTLING_POINTS};

use super::memory::Memory;
use crate::buffer::Buffer;
use crate::kernel::{Arg, Kernel, in_memory, start};
use crate::opened::Opened;

/// The kernels that read settled places.
#[derive(Debug)]
pub(super) struct PointKernels {
    points: Kernel,
    bounds: Kernel,
}

impl PointKernels {
    pub(super) fn new(
        kernel: &impl Fn(EntryPoint) -> Result<Kernel, BackendError>,
    ) -> Result<Self, BackendError> {
        Ok(Self { points: kernel(SETTLING_POINTS)?, bounds: kernel(SETTLING_BOUNDS)? })
    }

    /// Writes all control points, padded as `plan` says, to `points`, which has room for them.
    pub(super) fn write(
        &mut self,
        opened: &Opened,
        (settling, memory): (&SettlingPlan, &Memory),
        plan: &Plan,
        points: &Buffer,
    ) -> Result<(), BackendError> {
        let params = SettledParams::new(settling);
        let rows = Buffer::holding(opened, "where control points belong", &SettledRow::all(settling, plan))?;
        let value = [Arg::Value(bytes_of(&params))];
        let args = [&value[..], &in_memory([&memory.place_rows, &rows, &memory.places, points])].concat();
        // SAFETY: the arguments are those of `settling_points`. A lane reads its place, the places
        // beside it and its yarn's row, and writes its control point and virtual ends at their
        // positions in `plan`. Both plans have the same yarns.
        unsafe { start(&mut self.points, opened, &args, params.places) }
    }

    /// The least and the greatest coordinates of all control points, in whole units of the
    /// settling's scale.
    pub(super) fn bounds(
        &mut self,
        opened: &Opened,
        settling: &SettlingPlan,
        memory: &Memory,
    ) -> Result<[[i32; 3]; 2], BackendError> {
        let params = SettledParams::new(settling);
        let group = self.bounds.group() as u32;
        let groups = params.places.div_ceil(group).min(EXTENT_GROUPS);
        let mut rows = vec![BoundsRow::default(); groups as usize];
        let found = Buffer::holding(opened, "bounds", &rows)?;
        let value = [Arg::Value(bytes_of(&params))];
        let args = [&value[..], &in_memory([&memory.place_rows, &memory.places, &found])].concat();
        // SAFETY: the arguments are those of `settling_bounds`. Lanes read places and their rows,
        // and a group writes its row.
        unsafe { start(&mut self.bounds, opened, &args, groups * group) }?;
        found.read_now(opened, 0, &mut rows)?;
        Ok(BoundsRow::joined(&rows))
    }
}
