//! The memory of a device that may still be allocated.

use bytemuck::Pod;
use texere_core::{BackendError, Limits, OutOfMemory};

use crate::buffer::Buffer;
use crate::opened::Opened;

/// The memory of a device that a settler may still allocate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Room {
    pub(crate) binding_bytes: u64,
    pub(crate) memory_bytes: u64,
}

impl Room {
    pub(crate) fn new(limits: &Limits) -> Self {
        Self { binding_bytes: limits.binding_bytes, memory_bytes: limits.memory_bytes }
    }

    /// Subtracts `bytes` for `what` from the memory that may still be allocated.
    fn take(&mut self, what: &'static str, bytes: u64) -> Result<u64, BackendError> {
        if bytes > self.binding_bytes || bytes > self.memory_bytes {
            return Err(BackendError::OutOfMemory(OutOfMemory { what, bytes }));
        }
        self.memory_bytes -= bytes;
        Ok(bytes)
    }

    /// A buffer of `bytes` of zeros for `what`.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], also if one buffer, or all buffers together,
    /// would have more than the device's limits allow.
    pub(crate) fn zeroed(
        &mut self,
        opened: &Opened,
        what: &'static str,
        bytes: u64,
    ) -> Result<Buffer, BackendError> {
        Buffer::zeroed(opened, what, self.take(what, bytes)?)
    }

    /// A buffer that holds `data`, for `what`.
    pub(crate) fn holding<T: Pod>(
        &mut self,
        opened: &Opened,
        what: &'static str,
        data: &[T],
    ) -> Result<Buffer, BackendError> {
        self.take(what, size_of_val(data) as u64)?;
        Buffer::holding(opened, what, data)
    }
}
