//! Pinned host memory, through which large transfers go.

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
// SAFETY: a shared value gives its address, and gives its contents only by unsafe functions.
unsafe impl Sync for Pinned {}

impl Pinned {
    /// Memory of `bytes` for `what`, mapped for the host's `access`.
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
        // SAFETY: the whole buffer is mapped. It is of this context, and no event is waited for.
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
    /// No command that writes to this memory is running, and `count` values fit in it.
    pub(crate) unsafe fn values<T: Pod>(&self, count: usize) -> Result<&[T], BackendError> {
        // SAFETY: the memory is aligned and is mapped for as long as `self` lives, and the type may
        // hold any bits. The rest is this function's contract.
        Ok(unsafe { std::slice::from_raw_parts(self.aligned()?, count) })
    }

    /// The start as a pointer to values of type `T`, or an error if the memory is not aligned for
    /// them.
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
        // SAFETY: the memory was mapped once, in `new`, and no slice of it is left. The queue runs
        // in order, so every read into the memory has ended before. Users wait for commands that
        // read from the memory before they drop it.
        let unmapped = unsafe {
            enqueue_unmap_mem_object(
                self.opened.transfers.raw(),
                self.memory.raw(),
                self.start,
                0,
                ptr::null(),
            )
        };
        // If even this fails, the device is lost, and the memory with it.
        drop(Handle::event(unmapped));
    }
}
