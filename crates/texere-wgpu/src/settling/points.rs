//! Settled places turned into control points on the device, without going through the host.

use std::sync::Arc;

use texere_core::BackendError;
use texere_core::backend::Plan;
use texere_gpu::{BoundsRow, EXTENT_GROUPS, SettledParams, SettledRow};
use texere_shaders::Resource;
use wgpu::{BufferUsages, CommandEncoder, ComputePassDescriptor};

use super::{WgpuSettler, submit};
use crate::kernel::Kernel;
use crate::opened::Opened;
use crate::parameters::PARAMETERS;

impl WgpuSettler {
    /// Writes all control points, padded as `plan` says, to `points`. Returns whether they were
    /// written: `points` must belong to the settler's own open device, and fit one binding.
    pub(crate) fn write_points(
        &self,
        opened: &Arc<Opened>,
        plan: &Plan,
        points: &wgpu::Buffer,
    ) -> Result<bool, BackendError> {
        if !Arc::ptr_eq(opened, &self.opened) || points.size() > self.memory.binding_bytes() {
            return Ok(false);
        }
        let gpu = &opened.gpu;
        let rows = SettledRow::all(&self.plan, plan);
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let table = gpu.buffer("where control points belong", size_of_val(&rows[..]) as u64, usage)?;
        gpu.write(&table, 0, bytemuck::cast_slice(&rows))?;
        let params = self.settled_params()?;
        let groups = self.kernels.points.workgroups(self.params.places);
        submit(gpu, |encoder| {
            let buffers = [
                (Resource::SettledParams, &params),
                (Resource::SettledRows, &table),
                (Resource::Points, points),
            ];
            self.record_settled(encoder, &self.kernels.points, groups, &buffers);
        })?;
        Ok(true)
    }

    /// The least and the greatest coordinates of all control points, in whole units of the
    /// settling's scale.
    pub(super) fn find_bounds(&self) -> Result<[[i32; 3]; 2], BackendError> {
        let gpu = &self.opened.gpu;
        let groups = self.kernels.bounds.workgroups(self.params.places).min(EXTENT_GROUPS);
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let found = gpu.buffer("bounds", u64::from(groups) * size_of::<BoundsRow>() as u64, usage)?;
        let params = self.settled_params()?;
        let rows: Vec<BoundsRow> = self.answer.after(gpu, &found, (0, groups.into()), |encoder| {
            let buffers = [(Resource::SettledParams, &params), (Resource::Bounds, &found)];
            self.record_settled(encoder, &self.kernels.bounds, groups, &buffers);
        })?;
        Ok(BoundsRow::joined(&rows))
    }

    fn settled_params(&self) -> Result<wgpu::Buffer, BackendError> {
        let (gpu, params) = (&self.opened.gpu, SettledParams::new(&self.plan));
        let usage = PARAMETERS | BufferUsages::COPY_DST;
        let buffer = gpu.buffer("parameters", size_of::<SettledParams>() as u64, usage)?;
        gpu.write(&buffer, 0, bytemuck::bytes_of(&params))?;
        Ok(buffer)
    }

    /// Records a kernel that reads settled places, with `buffers` beside the settling's own.
    fn record_settled(
        &self,
        encoder: &mut CommandEncoder,
        kernel: &Kernel,
        workgroups: u32,
        buffers: &[(Resource, &wgpu::Buffer)],
    ) {
        let bound = kernel.bind(&self.opened.gpu, |resource| {
            let other = buffers.iter().find(|(other, _)| *other == resource);
            let other = other.map(|(_, buffer)| buffer.as_entire_binding());
            other.or_else(|| self.memory.resource(resource))
        });
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
        kernel.record(&mut pass, &bound, workgroups);
    }
}
