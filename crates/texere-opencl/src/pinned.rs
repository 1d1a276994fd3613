//! Pinned host memory, through which everything crosses the bus.

use std::ffi::c_void;
use std::ptr;
use std::sync::Arc;

use bytemuck::Pod;
use opencl3::command_queue::{CL_BLOCKING, enqueue_map_buffer, enqueue_unmap_mem_object};
use opencl3::memory::{CL_MEM_ALLOC_HOST_PTR, CL_MEM_READ_WRITE, create_buffer};
use opencl3::types::cl_map_flags;
use texere_core::BackendError;

use crate::OpenClError;
use crate::faults::not_allocated;
use crate::handles::Handle;
use crate::opened::Opened;

/// Host memory that the device reads and writes at full speed. It stays mapped.
#[derive(Debug)]
pub(crate) struct Pinned {
    opened: Arc<Opened>,
    memory: Handle,
    start: *mut c_void,
    bytes: usize,
}

// SAFETY: the mapped memory belongs to this value alone, and OpenCL lets any thread use it.
unsafe impl Send for Pinned {}
// SAFETY: shared it tells where it is, and what it holds by unsafe functions alone.
unsafe impl Sync for Pinned {}

impl Pinned {
    /// Takes `bytes` for `what`, mapped for the host's `access`.
    pub(crate) fn new(
        opened: &Arc<Opened>,
        what: &'static str,
        access: cl_map_flags,
        bytes: usize,
    ) -> Result<Self, BackendError> {
        let refused = |call| not_allocated(&opened.name, call, what, bytes as u64);
        // SAFETY: no host memory is handed over.
        let memory = unsafe {
            let flags = CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR;
            create_buffer(opened.context.raw(), flags, bytes, ptr::null_mut())
        };
        let memory = Handle::memory(memory).map_err(refused("clCreateBuffer"))?;
        let mut start = ptr::null_mut();
        // SAFETY: the whole of a buffer of this context, and no event.
        let mapped = unsafe {
            let (queue, blocking) = (opened.transfers.raw(), CL_BLOCKING);
            enqueue_map_buffer(queue, memory.raw(), blocking, access, 0, bytes, &mut start, 0, ptr::null())
        };
        Handle::event(mapped).map_err(refused("clEnqueueMapBuffer"))?;
        Ok(Self { opened: opened.clone(), memory, start, bytes })
    }

    pub(crate) fn bytes(&self) -> usize {
        self.bytes
    }

    pub(crate) fn start(&self) -> *mut c_void {
        self.start
    }

    /// The first `count` values.
    ///
    /// # Safety
    ///
    /// No command that writes here is running, and `count` values fit.
    pub(crate) unsafe fn values<T: Pod>(&self, count: usize) -> Result<&[T], BackendError> {
        // SAFETY: aligned, mapped for as long as `self`, of a type that takes any bits; the rest is
        // the contract.
        Ok(unsafe { std::slice::from_raw_parts(self.aligned()?, count) })
    }

    /// The start as a pointer to values of type `T`, if they may lie there.
    pub(crate) fn aligned<T>(&self) -> Result<*mut T, BackendError> {
        let start = self.start.cast::<T>();
        if start.is_null() || !start.is_aligned() {
            let source = Box::new(OpenClError::Misaligned { needed: align_of::<T>() });
            return Err(BackendError::Driver { call: "clEnqueueMapBuffer", source });
        }
        Ok(start)
    }
}

impl Drop for Pinned {
    fn drop(&mut self) {
        // SAFETY: mapped once, in `new`, and no slice of it is left. In order, so after every read
        // into it; writes from it have ended, as its users see to.
        let unmapped = unsafe {
            enqueue_unmap_mem_object(
                self.opened.transfers.raw(),
                self.memory.raw(),
                self.start,
                0,
                ptr::null(),
            )
        };
        // Where even this fails the device is lost, and the memory with it.
        drop(Handle::event(unmapped));
    }
}
