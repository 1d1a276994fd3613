//! Buffers of a renderer's device.

use texere_core::BackendError;
use wgpu::BufferUsages;

use crate::Renderer;

impl Renderer {
    /// A buffer that holds `bytes`, and can be written again.
    pub(crate) fn filled(
        &self,
        what: &'static str,
        bytes: &[u8],
        usage: BufferUsages,
    ) -> Result<wgpu::Buffer, BackendError> {
        let buffer = self.buffer(what, bytes.len() as u64, usage)?;
        self.write(&buffer, bytes)?;
        Ok(buffer)
    }

    /// A buffer of at least `bytes`, which is never empty and can be written.
    pub(crate) fn buffer(
        &self,
        what: &'static str,
        bytes: u64,
        usage: BufferUsages,
    ) -> Result<wgpu::Buffer, BackendError> {
        self.device.buffer(what, bytes, usage | BufferUsages::COPY_DST)
    }

    /// Makes `buffer` at least `bytes` long. If it has to grow, its contents are lost.
    pub(crate) fn reserve(&self, buffer: &mut wgpu::Buffer, bytes: u64) -> Result<(), BackendError> {
        if buffer.size() < bytes {
            *buffer = self.buffer("a picture's buffer", bytes, buffer.usage())?;
        }
        Ok(())
    }

    /// Writes `bytes` to the start of `buffer`.
    pub(crate) fn write(&self, buffer: &wgpu::Buffer, bytes: &[u8]) -> Result<(), BackendError> {
        self.device.scoped("Queue::write_buffer", || self.device.queue().write_buffer(buffer, 0, bytes))
    }
}
