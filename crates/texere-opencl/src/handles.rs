//! Owned OpenCL objects.
//!
//! opencl3's own types expect every release to succeed, so they panic after a lost device, perhaps
//! while unwinding. Here a release that fails is ignored, because nothing can be done about it.

use std::ffi::c_void;

use opencl3::{command_queue, context::context, event, kernel, memory, program};

/// A function that releases an object.
type Release = unsafe fn(*mut c_void) -> Result<(), i32>;

/// One reference to an OpenCL object, released on drop.
#[derive(Debug)]
pub(crate) struct Handle {
    raw: *mut c_void,
    release: Release,
}

// SAFETY: OpenCL objects may be used from any thread at any time. The one exception is setting the
// arguments of one kernel from two threads at once, and `Kernel::run` takes the kernel by `&mut`.
unsafe impl Send for Handle {}
// SAFETY: OpenCL objects may be used from several threads at once, apart from setting a kernel's
// arguments, for which `Kernel::run` takes the kernel by `&mut`.
unsafe impl Sync for Handle {}

impl Handle {
    /// Owns the reference that came with `raw`, and releases it by `release`.
    fn created(raw: Result<*mut c_void, i32>, release: Release) -> Result<Self, i32> {
        Ok(Self { raw: raw?, release })
    }

    pub(crate) fn context(raw: Result<*mut c_void, i32>) -> Result<Self, i32> {
        Self::created(raw, context::release_context)
    }

    pub(crate) fn queue(raw: Result<*mut c_void, i32>) -> Result<Self, i32> {
        Self::created(raw, command_queue::release_command_queue)
    }

    pub(crate) fn program(raw: Result<*mut c_void, i32>) -> Result<Self, i32> {
        Self::created(raw, program::release_program)
    }

    pub(crate) fn kernel(raw: Result<*mut c_void, i32>) -> Result<Self, i32> {
        Self::created(raw, kernel::release_kernel)
    }

    pub(crate) fn memory(raw: Result<*mut c_void, i32>) -> Result<Self, i32> {
        Self::created(raw, memory::release_mem_object)
    }

    pub(crate) fn event(raw: Result<*mut c_void, i32>) -> Result<Self, i32> {
        Self::created(raw, event::release_event)
    }

    /// The object itself, alive as long as this handle.
    pub(crate) fn raw(&self) -> *mut c_void {
        self.raw
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: `raw` came with one reference of the kind that `release` releases, and is not
        // used after this.
        let _ = unsafe { (self.release)(self.raw) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_release_that_fails_is_let_go() {
        unsafe fn refuse(_: *mut c_void) -> Result<(), i32> {
            Err(-36)
        }
        drop(Handle { raw: std::ptr::null_mut(), release: refuse });
    }
}
