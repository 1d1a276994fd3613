//! The memory of a device that may still be allocated.

use bytemuck::Pod;
use texere_core::{BackendError, Limits, OutOfMemory};
use wgpu::BufferUsages;

use crate::gpu::Gpu;

/// The memory of a device that a settler may still allocate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Room {
    pub(crate) binding_bytes: u64,
    pub(crate) memory_bytes: u64,
}

impl Room {
    pub(crate) fn new(gpu: &Gpu, limits: &Limits) -> Self {
        let binding_bytes = gpu.device.limits().max_storage_buffer_binding_size;
        Self { binding_bytes: limits.binding_bytes.min(binding_bytes), memory_bytes: limits.memory_bytes }
    }

    /// A buffer of `bytes` for `what`.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], also if one buffer, or all buffers together,
    /// would have more than the device's limits allow.
    pub(crate) fn take(
        &mut self,
        gpu: &Gpu,
        what: &'static str,
        bytes: u64,
    ) -> Result<wgpu::Buffer, BackendError> {
        if bytes > self.binding_bytes || bytes > self.memory_bytes {
            return Err(BackendError::OutOfMemory(OutOfMemory { what, bytes }));
        }
        self.memory_bytes -= bytes;
        gpu.buffer(what, bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC)
    }

    /// A buffer that holds `data`, for `what`.
    pub(crate) fn holding<T: Pod>(
        &mut self,
        gpu: &Gpu,
        what: &'static str,
        data: &[T],
    ) -> Result<wgpu::Buffer, BackendError> {
        let buffer = self.take(gpu, what, size_of_val(data) as u64)?;
        gpu.write(&buffer, 0, bytemuck::cast_slice(data))?;
        Ok(buffer)
    }
}
