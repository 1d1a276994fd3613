//! The conformance suite's pairwise cases on a caller's queue without profiling.

use std::process::ExitCode;
use std::sync::Arc;

use opencl3::command_queue::CommandQueue;
use opencl3::context::Context;
use opencl3::device::{CL_DEVICE_TYPE_ALL, Device};
use opencl3::error_codes::{CL_DEVICE_NOT_FOUND, ClError};
use opencl3::platform::get_platforms;
use texere_conformance::{Entry, cases, run};
use texere_core::{Backend, BackendError};
use texere_opencl::{OpenClBackend, Schedule};

fn main() -> ExitCode {
    run(std::env::args_os(), &[Entry::near("opencl", || vec![open()]).with_cases(cases::pairwise)], "opencl")
}

fn open() -> Result<Arc<dyn Backend>, BackendError> {
    // The backend lists the devices first, because the first calls of OpenCL must come from one
    // thread alone.
    OpenClBackend::devices()?;
    let queue = callers_queue().map_err(|source| BackendError::Driver {
        call: "opening the caller's queue",
        source: source.into(),
    })?;
    // SAFETY: the queue is valid, and the backend retains it.
    Ok(Arc::new(unsafe { OpenClBackend::on_queue(queue.get(), Schedule::PerRing) }?))
}

fn callers_queue() -> Result<CommandQueue, ClError> {
    let devices = get_platforms()?.into_iter().map(|platform| platform.get_devices(CL_DEVICE_TYPE_ALL));
    let first = devices.flatten().flatten().next().ok_or(ClError(CL_DEVICE_NOT_FOUND))?;
    let context = Context::from_device(&Device::new(first))?;
    #[allow(deprecated, reason = "OpenCL 1.2, as the backend itself")]
    CommandQueue::create_default(&context, 0)
}
