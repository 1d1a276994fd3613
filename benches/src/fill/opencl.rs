//! A fill through OpenCL.

use std::ptr;
use std::time::Duration;

use opencl3::command_queue::{CL_QUEUE_PROFILING_ENABLE, CommandQueue};
use opencl3::context::Context;
use opencl3::device::{CL_DEVICE_TYPE_ALL, Device};
use opencl3::error_codes::ClError;
use opencl3::kernel::Kernel;
use opencl3::memory::{Buffer, CL_MEM_READ_WRITE, ClMem};
use opencl3::platform::get_platforms;
use opencl3::program::Program;
use texere::BackendError;
use texere_opencl::{OpenClBackend, Schedule};

const SOURCE: &str = "
__kernel void fill(__global uint4 *out, const ulong count) {
    size_t at = get_global_id(0);
    if (at < count) {
        out[at] = (uint4)((uint)at);
    }
}";

/// Buffers on an OpenCL device, and the kernel that fills them.
#[derive(Debug)]
pub struct OpenClFill {
    queue: CommandQueue,
    kernel: Kernel,
    buffers: Vec<(Buffer<u8>, u64)>,
    // Dropped last.
    _context: Context,
}

fn driver(call: &'static str) -> impl Fn(ClError) -> BackendError {
    move |error| BackendError::Driver { call, source: error.to_string().into() }
}

pub(super) fn rig(index: usize, bytes: &[u64]) -> Result<(OpenClBackend, OpenClFill), BackendError> {
    // The backend first: it minds that a loader's first calls are for one thread alone.
    let backend = OpenClBackend::open(index, Schedule::PerRing)?;
    Ok((backend, OpenClFill::new(index, bytes)?))
}

impl OpenClFill {
    fn new(index: usize, bytes: &[u64]) -> Result<Self, BackendError> {
        let mut devices = Vec::new();
        for platform in get_platforms().map_err(driver("clGetPlatformIDs"))? {
            devices.extend(platform.get_devices(CL_DEVICE_TYPE_ALL).unwrap_or_default());
        }
        let device = devices
            .get(index)
            .copied()
            .ok_or_else(|| BackendError::NoDevice { wanted: format!("opencl:{index}"), found: Vec::new() })?;
        let context = Context::from_device(&Device::new(device)).map_err(driver("clCreateContext"))?;
        #[allow(deprecated, reason = "OpenCL 1.2, as the backend itself")]
        let queue = CommandQueue::create_default(&context, CL_QUEUE_PROFILING_ENABLE)
            .map_err(driver("clCreateCommandQueue"))?;
        let program = Program::create_and_build_from_source(&context, SOURCE, "")
            .map_err(|log| BackendError::Compile { kernel: "fill", log: log.to_string() })?;
        let kernel = Kernel::create(&program, "fill").map_err(driver("clCreateKernel"))?;
        let buffer = |bytes: u64| {
            let size = bytes.next_multiple_of(16);
            // SAFETY: no host memory is handed over.
            let buffer =
                unsafe { Buffer::create(&context, CL_MEM_READ_WRITE, size as usize, ptr::null_mut()) };
            Ok((buffer.map_err(driver("clCreateBuffer"))?, size / 16))
        };
        let buffers = bytes.iter().copied().map(buffer).collect::<Result<_, BackendError>>()?;
        Ok(Self { queue, kernel, buffers, _context: context })
    }
}

impl super::Fill for OpenClFill {
    fn run(&mut self) -> Result<Duration, BackendError> {
        let mut time = 0;
        for (buffer, count) in &self.buffers {
            let lanes = count.next_multiple_of(256) as usize;
            // SAFETY: the arguments are those of `fill`, which checks its bounds.
            let event = unsafe {
                self.kernel.set_arg(0, &buffer.get()).map_err(driver("clSetKernelArg"))?;
                self.kernel.set_arg(1, count).map_err(driver("clSetKernelArg"))?;
                let (lanes, group) = ([lanes], [256]);
                self.queue.enqueue_nd_range_kernel(
                    self.kernel.get(),
                    1,
                    ptr::null(),
                    lanes.as_ptr(),
                    group.as_ptr(),
                    &[],
                )
            }
            .map_err(driver("clEnqueueNDRangeKernel"))?;
            event.wait().map_err(driver("clWaitForEvents"))?;
            let start = event.profiling_command_start().map_err(driver("clGetEventProfilingInfo"))?;
            let end = event.profiling_command_end().map_err(driver("clGetEventProfilingInfo"))?;
            time += end - start;
        }
        Ok(Duration::from_nanos(time))
    }
}
