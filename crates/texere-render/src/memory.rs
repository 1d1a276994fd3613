//! Buffers of a renderer's device, and what binds them.

use texere_core::BackendError;
use wgpu::{BindingResource, BufferUsages};

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

    /// A buffer of at least `bytes`, never empty, that can be written.
    pub(crate) fn buffer(
        &self,
        what: &'static str,
        bytes: u64,
        usage: BufferUsages,
    ) -> Result<wgpu::Buffer, BackendError> {
        self.device.buffer(what, bytes, usage | BufferUsages::COPY_DST)
    }

    /// Writes `bytes` to the start of `buffer`.
    pub(crate) fn write(&self, buffer: &wgpu::Buffer, bytes: &[u8]) -> Result<(), BackendError> {
        self.device.scoped("Queue::write_buffer", || self.device.queue().write_buffer(buffer, 0, bytes))
    }

    /// Binds `resources` in the order of their numbers.
    pub(crate) fn bind(
        &self,
        layout: &wgpu::BindGroupLayout,
        resources: &[BindingResource<'_>],
    ) -> Result<wgpu::BindGroup, BackendError> {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        let device = &self.device;
        device.scoped("Device::create_bind_group", || {
            let descriptor = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
            device.device().create_bind_group(&descriptor)
        })
    }
}
