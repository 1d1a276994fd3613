//! Device memory that grows.

use texere_core::{BackendError, OutOfMemory};
use wgpu::BufferUsages;

use crate::gpu::Gpu;

/// A buffer in device memory that grows with what it has to hold.
#[derive(Debug)]
pub(crate) struct Buffer {
    what: &'static str,
    usage: BufferUsages,
    buffer: wgpu::Buffer,
    /// Whether room for anything was ever asked for. There is a `wgpu::Buffer` even before that,
    /// because wgpu can't bind an empty buffer.
    used: bool,
}

impl Buffer {
    pub(crate) fn new(gpu: &Gpu, what: &'static str, usage: BufferUsages) -> Result<Self, BackendError> {
        Ok(Self { what, usage, buffer: gpu.buffer(what, 0, usage)?, used: false })
    }

    /// Makes the buffer at least `bytes` long. If it has to grow, its contents are lost.
    pub(crate) fn reserve(&mut self, gpu: &Gpu, bytes: u64) -> Result<&wgpu::Buffer, BackendError> {
        self.used |= bytes > 0;
        if self.buffer.size() < bytes {
            if self.usage.contains(BufferUsages::STORAGE)
                && bytes > gpu.device.limits().max_storage_buffer_binding_size
            {
                return Err(BackendError::OutOfMemory(OutOfMemory { what: self.what, bytes }));
            }
            self.buffer = gpu.buffer(self.what, bytes, self.usage)?;
        }
        Ok(&self.buffer)
    }

    pub(crate) fn write(&mut self, gpu: &Gpu, bytes: &[u8]) -> Result<(), BackendError> {
        gpu.write(self.reserve(gpu, bytes.len() as u64)?, 0, bytes)
    }

    pub(crate) const fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    pub(crate) fn bytes(&self) -> u64 {
        if self.used { self.buffer.size() } else { 0 }
    }
}
