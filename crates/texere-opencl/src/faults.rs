//! Errors from OpenCL's status numbers.

use opencl3::error_codes::{
    CL_CONTEXT_TERMINATED_KHR, CL_DEVICE_NOT_AVAILABLE, CL_INVALID_BUFFER_SIZE, CL_INVALID_COMMAND_QUEUE,
    CL_INVALID_CONTEXT, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_HOST_MEMORY, CL_OUT_OF_RESOURCES,
    CL_PLATFORM_NOT_FOUND_KHR, ClError, DLOPEN_RUNTIME_LOAD_FAILED,
};
use texere_core::{BackendError, OutOfMemory};
use thiserror::Error;

/// An error that OpenCL reported. It is the `source` of a [`BackendError::Driver`] or
/// [`BackendError::DeviceLost`].
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum OpenClError {
    /// The loader could not be loaded. Install the package `ocl-icd-libopencl1`, or your GPU's
    /// driver.
    #[error("no OpenCL loader (libOpenCL) is installed")]
    NoLoader,
    /// The loader knows no platform. Install your GPU's driver, or `pocl-opencl-icd` to run on the
    /// CPU.
    #[error("no OpenCL platform is installed")]
    NoPlatform,
    /// Memory was mapped at an address that is not aligned for its values.
    #[error("memory mapped at an address that is not a multiple of {needed} bytes")]
    Misaligned {
        /// The alignment that the address needs, bytes.
        needed: usize,
    },
    /// OpenCL returned another status.
    #[error("{name} ({code})")]
    Status {
        /// OpenCL's name of the status.
        name: String,
        /// OpenCL's number of the status.
        code: i32,
    },
}

impl OpenClError {
    fn new(code: i32) -> Self {
        match code {
            DLOPEN_RUNTIME_LOAD_FAILED => Self::NoLoader,
            CL_PLATFORM_NOT_FOUND_KHR => Self::NoPlatform,
            _ => Self::Status { name: ClError(code).to_string(), code },
        }
    }
}

/// NVIDIA's status after a kernel has read or written memory that is not its own. The context can't
/// be used any more.
const ILLEGAL_ACCESS: i32 = -9999;

/// The error of `call` on `device`, from OpenCL's status.
pub(crate) fn failed(device: &str, call: &'static str) -> impl Fn(i32) -> BackendError {
    move |code| {
        let source = Box::new(OpenClError::new(code));
        match code {
            CL_DEVICE_NOT_AVAILABLE
            | CL_CONTEXT_TERMINATED_KHR
            | CL_INVALID_COMMAND_QUEUE
            | CL_INVALID_CONTEXT
            | ILLEGAL_ACCESS => BackendError::DeviceLost { device: device.into(), source: Some(source) },
            _ => BackendError::Driver { call, source },
        }
    }
}

/// The error of allocating `bytes` for `what`, from OpenCL's status.
pub(crate) fn not_allocated(
    device: &str,
    call: &'static str,
    what: &'static str,
    bytes: u64,
) -> impl Fn(i32) -> BackendError {
    move |code| match code {
        CL_MEM_OBJECT_ALLOCATION_FAILURE
        | CL_OUT_OF_RESOURCES
        | CL_OUT_OF_HOST_MEMORY
        | CL_INVALID_BUFFER_SIZE => BackendError::OutOfMemory(OutOfMemory { what, bytes }),
        _ => failed(device, call)(code),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statuses_become_errors_with_a_name() {
        let text = |error: BackendError| {
            let source = std::error::Error::source(&error).map(ToString::to_string);
            (error.to_string(), source)
        };
        assert_eq!(
            text(failed("opencl:0", "clGetPlatformIDs")(-2000)),
            ("clGetPlatformIDs failed".into(), Some("no OpenCL loader (libOpenCL) is installed".into()))
        );
        assert_eq!(
            text(failed("opencl:0", "clFinish")(-36)),
            ("device opencl:0 is lost".into(), Some("CL_INVALID_COMMAND_QUEUE (-36)".into()))
        );
        assert_eq!(
            text(failed("opencl:0", "clFinish")(-5)),
            ("clFinish failed".into(), Some("CL_OUT_OF_RESOURCES (-5)".into()))
        );
        assert_eq!(
            text(not_allocated("opencl:0", "clCreateBuffer", "vertices", 24)(-61)),
            ("out of memory: 24 bytes for vertices".into(), None)
        );
    }
}
