//! Answers, which are a few numbers that a device returns after its work.

use bytemuck::Pod;
use texere_core::BackendError;
use wgpu::{BufferUsages, CommandEncoder, MapMode};

use crate::gpu::Gpu;
use crate::mapped::Mapped;

/// A small buffer through which the host reads.
#[derive(Debug)]
pub(crate) struct Answer {
    buffer: wgpu::Buffer,
}

impl Answer {
    /// A buffer for answers of up to `bytes`.
    pub(crate) fn new(gpu: &Gpu, bytes: u64) -> Result<Self, BackendError> {
        Ok(Self { buffer: gpu.buffer("readback", bytes, BufferUsages::MAP_READ | BufferUsages::COPY_DST)? })
    }

    /// Submits what `record` records, and waits until it is done. Returns the `count` numbers of
    /// `source` from number `first` on, after that work.
    pub(crate) fn after<T: Pod>(
        &self,
        gpu: &Gpu,
        source: &wgpu::Buffer,
        (first, count): (u64, u64),
        record: impl FnOnce(&mut CommandEncoder),
    ) -> Result<Vec<T>, BackendError> {
        let (each, call) = (size_of::<T>() as u64, "BufferSlice::get_mapped_range");
        let bytes = each * count;
        let mapped = Mapped::submit(gpu, &self.buffer, MapMode::Read, bytes, |encoder| {
            record(encoder);
            encoder.copy_buffer_to_buffer(source, each * first, &self.buffer, 0, bytes);
        })?;
        let waited = mapped.wait(gpu);
        let read = gpu.scoped(call, || {
            let values =
                self.buffer.get_mapped_range(..bytes).map(|view| bytemuck::pod_collect_to_vec(&view));
            self.buffer.unmap();
            values
        });
        waited?;
        read?.map_err(|source| BackendError::Driver { call, source: source.into() })
    }
}
