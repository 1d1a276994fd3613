//! Device memory.

use std::ffi::c_void;
use std::ptr;
use std::sync::Arc;

use bytemuck::Pod;
use opencl3::command_queue::{
    CL_BLOCKING, enqueue_copy_buffer, enqueue_fill_buffer, enqueue_read_buffer, enqueue_write_buffer,
};
use opencl3::memory::{CL_MEM_READ_WRITE, create_buffer};
use texere_core::{BackendError, OutOfMemory};

use crate::clock::{Clock, Stage};
use crate::faults::not_allocated;
use crate::handles::Handle;
use crate::opened::Opened;

/// A buffer in device memory. An empty buffer has no memory.
#[derive(Debug, Default)]
pub(crate) struct Buffer {
    memory: Option<Handle>,
    bytes: u64,
}

impl Buffer {
    /// A buffer of `bytes` for `what`. Its first word is 0, and the rest is undefined.
    pub(crate) fn new(opened: &Opened, what: &'static str, bytes: u64) -> Result<Self, BackendError> {
        if bytes == 0 {
            return Ok(Self::default());
        }
        let refused = |call| not_allocated(&opened.name, call, what, bytes);
        let size =
            usize::try_from(bytes).map_err(|_| BackendError::OutOfMemory(OutOfMemory { what, bytes }))?;
        // SAFETY: no host memory is handed over.
        let memory = unsafe { create_buffer(opened.context.raw(), CL_MEM_READ_WRITE, size, ptr::null_mut()) };
        let memory = Handle::memory(memory).map_err(refused("clCreateBuffer"))?;
        let mut buffer = Self { memory: Some(memory), bytes };
        // Some drivers allocate only at the first use. With this write they report a lack of memory
        // now. clEnqueueMigrateMemObjects was tried for this, but NVIDIA's driver (580) crashes if
        // two threads call it on one queue. SAFETY: the write is blocking, so the word is borrowed
        // until it is copied.
        let claimed = unsafe { buffer.enqueue_write(&opened.transfers, CL_BLOCKING, 0, &[0u32], None) };
        claimed.map_err(refused("clEnqueueWriteBuffer"))?;
        Ok(buffer)
    }

    /// `bytes` of zeros for `what`.
    pub(crate) fn zeroed(opened: &Opened, what: &'static str, bytes: u64) -> Result<Self, BackendError> {
        let mut buffer = Self::new(opened, what, bytes)?;
        buffer.clear(opened)?;
        Ok(buffer)
    }

    /// Fills the buffer with zeros, after what is in the queue of the kernels.
    pub(crate) fn clear(&mut self, opened: &Opened) -> Result<(), BackendError> {
        if self.bytes > 0 {
            let zero = 0u32;
            // SAFETY: the pattern is a u32 that the call copies. `bytes`, a multiple of 4, is the
            // whole length of the buffer.
            let filled = unsafe {
                let (queue, pattern) = (opened.queue.raw(), (&raw const zero).cast());
                enqueue_fill_buffer(queue, self.raw(), pattern, 4, 0, self.bytes as usize, 0, ptr::null())
            };
            Handle::event(filled).map_err(opened.failed("clEnqueueFillBuffer"))?;
        }
        Ok(())
    }

    /// Copies `other`, a buffer of the same size, after what is in the queue of the kernels.
    pub(crate) fn copy(&mut self, opened: &Opened, other: &Self) -> Result<(), BackendError> {
        debug_assert_eq!(self.bytes, other.bytes, "a copy of all of it");
        if self.bytes > 0 {
            // SAFETY: a range past either buffer's end comes back as an error.
            let copied = unsafe {
                let (queue, bytes) = (opened.queue.raw(), self.bytes as usize);
                enqueue_copy_buffer(queue, other.raw(), self.raw(), 0, 0, bytes, 0, ptr::null())
            };
            Handle::event(copied).map_err(opened.failed("clEnqueueCopyBuffer"))?;
        }
        Ok(())
    }

    /// Waits for what is in the queue of the kernels, and reads from byte `offset` into `out`.
    pub(crate) fn read_now<T: Pod>(
        &self,
        opened: &Opened,
        offset: u64,
        out: &mut [T],
    ) -> Result<(), BackendError> {
        if out.is_empty() {
            return Ok(());
        }
        let (offset, bytes, start) = (offset as usize, size_of_val(out), out.as_mut_ptr().cast());
        // SAFETY: `out` is borrowed during the whole blocking read, may hold any bits, and is
        // `bytes` long.
        unsafe { self.enqueue_read(opened, &opened.queue, CL_BLOCKING, offset, bytes, start, None) }?;
        Ok(())
    }

    /// A buffer that holds `data`.
    pub(crate) fn holding<T: Pod>(
        opened: &Opened,
        what: &'static str,
        data: &[T],
    ) -> Result<Self, BackendError> {
        let mut buffer = Self::new(opened, what, size_of_val(data) as u64)?;
        buffer.write(opened, &opened.queue, 0, data, None)?;
        Ok(buffer)
    }

    /// Makes the buffer at least `bytes` long. If it has to grow, its contents are lost. Commands
    /// that still use the smaller memory keep that memory until they end.
    pub(crate) fn reserve(
        &mut self,
        opened: &Opened,
        what: &'static str,
        bytes: u64,
    ) -> Result<(), BackendError> {
        if bytes > self.bytes {
            // The old memory is released first. So old and new memory need room together only while
            // commands still use the old one.
            *self = Self::default();
            *self = Self::new(opened, what, bytes)?;
        }
        Ok(())
    }

    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The `cl_mem`, or null if there is no memory.
    pub(crate) fn raw(&self) -> *mut c_void {
        self.memory.as_ref().map_or(ptr::null_mut(), Handle::raw)
    }

    /// Sends `data` to byte `offset` through `queue`, after `after`, and waits until `data` may
    /// change again. Returns the event, or none if there is nothing to send.
    pub(crate) fn write<T: Pod>(
        &mut self,
        opened: &Opened,
        queue: &Handle,
        offset: u64,
        data: &[T],
        after: Option<&Handle>,
    ) -> Result<Option<Arc<Handle>>, BackendError> {
        if data.is_empty() {
            return Ok(None);
        }
        debug_assert!(offset + size_of_val(data) as u64 <= self.bytes, "a write stays in its buffer");
        // SAFETY: a blocking write keeps `data` borrowed until it is copied.
        let event = unsafe { self.enqueue_write(queue, CL_BLOCKING, offset, data, after) };
        Ok(Some(Arc::new(event.map_err(opened.failed("clEnqueueWriteBuffer"))?)))
    }

    /// Sends `data`, which is not empty, as [`Buffer::write`] does, but waits only if `blocking`.
    /// The error is OpenCL's status.
    ///
    /// # Safety
    ///
    /// `data` does not change until the command has ended.
    pub(crate) unsafe fn enqueue_write<T: Pod>(
        &mut self,
        queue: &Handle,
        blocking: u32,
        offset: u64,
        data: &[T],
        after: Option<&Handle>,
    ) -> Result<Handle, i32> {
        let after = after.map(Handle::raw);
        let (events, list) = after.as_ref().map_or((0, ptr::null()), |event| (1, ptr::from_ref(event)));
        // SAFETY: the pointer and the size are those of `data`, which does not change by this
        // function's contract. A range past the buffer's end comes back as an error.
        Handle::event(unsafe {
            enqueue_write_buffer(
                queue.raw(),
                self.raw(),
                blocking,
                offset as usize,
                size_of_val(data),
                data.as_ptr().cast(),
                events,
                list,
            )
        })
    }

    /// Reads from the buffer's start into `out`, after `after`, and waits until it is read.
    pub(crate) fn read_into<T: Pod>(
        &self,
        opened: &Opened,
        out: &mut [T],
        after: Option<&Handle>,
        clock: &mut Clock,
    ) -> Result<(), BackendError> {
        if out.is_empty() {
            return Ok(());
        }
        // SAFETY: `out` is borrowed during the whole blocking read, may hold any bits, and is as
        // long as what is read.
        let event = unsafe {
            self.enqueue_read(
                opened,
                &opened.transfers,
                CL_BLOCKING,
                0,
                size_of_val(out),
                out.as_mut_ptr().cast(),
                after,
            )
        }?;
        clock.note(Stage::Readback, &event);
        Ok(())
    }

    /// Starts a read of `bytes` bytes from byte `offset` into `out`, after `after`, and waits for
    /// its end only if `blocking`. Returns the event.
    ///
    /// # Safety
    ///
    /// `out` points at `bytes` bytes of writable memory, which nothing else uses until the command
    /// has ended.
    #[allow(clippy::too_many_arguments, reason = "as many as clEnqueueReadBuffer has")]
    pub(crate) unsafe fn enqueue_read(
        &self,
        opened: &Opened,
        queue: &Handle,
        blocking: u32,
        offset: usize,
        bytes: usize,
        out: *mut c_void,
        after: Option<&Handle>,
    ) -> Result<Arc<Handle>, BackendError> {
        let after = after.map(Handle::raw);
        let (events, list) = after.as_ref().map_or((0, ptr::null()), |event| (1, ptr::from_ref(event)));
        // SAFETY: `out` is valid by this function's contract. A range past the buffer's end comes
        // back as an error.
        let event = unsafe {
            enqueue_read_buffer(queue.raw(), self.raw(), blocking, offset, bytes, out, events, list)
        };
        Ok(Arc::new(Handle::event(event).map_err(opened.failed("clEnqueueReadBuffer"))?))
    }
}
