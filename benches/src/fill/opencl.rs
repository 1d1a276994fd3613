//! A fill through OpenCL.

use std::ffi::c_void;
use std::ptr;
use std::time::{Duration, Instant};

use opencl3::command_queue::{
    CL_BLOCKING, CL_NON_BLOCKING, CL_QUEUE_PROFILING_ENABLE, CommandQueue, enqueue_read_buffer,
    enqueue_write_buffer,
};
use opencl3::context::Context;
use opencl3::device::{CL_DEVICE_TYPE_ALL, Device};
use opencl3::error_codes::ClError;
use opencl3::event::Event;
use opencl3::kernel::Kernel;
use opencl3::memory::{Buffer, CL_MAP_READ, CL_MAP_WRITE, CL_MEM_ALLOC_HOST_PTR, CL_MEM_READ_WRITE, ClMem};
use opencl3::platform::get_platforms;
use opencl3::program::Program;
use texere::BackendError;

use super::COPY_BYTES;

const SOURCE: &str = "
__kernel void fill(__global uint4 *out, const ulong count) {
    size_t at = get_global_id(0);
    if (at < count) {
        out[at] = (uint4)((uint)at);
    }
}";

/// Buffers on an OpenCL device, and the kernel that fills them.
#[derive(Debug)]
pub(super) struct OpenClFill {
    queue: CommandQueue,
    kernel: Kernel,
    buffers: Vec<(Buffer<u8>, u64)>,
    /// Pinned memory of the host, which stays mapped.
    pinned: Buffer<u8>,
    mapped: *mut c_void,
    // The context is dropped last.
    _context: Context,
}

fn driver(call: &'static str) -> impl Fn(ClError) -> BackendError {
    move |error| BackendError::Driver { call, source: error.to_string().into() }
}

/// A context on device number `index` of all platforms.
pub(super) fn context(index: usize) -> Result<Context, BackendError> {
    let mut devices = Vec::new();
    for platform in get_platforms().map_err(driver("clGetPlatformIDs"))? {
        devices.extend(platform.get_devices(CL_DEVICE_TYPE_ALL).unwrap_or_default());
    }
    let device = devices
        .get(index)
        .copied()
        .ok_or_else(|| BackendError::NoDevice { wanted: format!("opencl:{index}"), found: Vec::new() })?;
    Context::from_device(&Device::new(device)).map_err(driver("clCreateContext"))
}

impl OpenClFill {
    pub(super) fn new(index: usize, bytes: &[u64]) -> Result<Self, BackendError> {
        let context = context(index)?;
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
        // SAFETY: no host memory is handed over.
        let pinned = unsafe {
            let flags = CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR;
            Buffer::create(&context, flags, COPY_BYTES as usize, ptr::null_mut())
        };
        let pinned = pinned.map_err(driver("clCreateBuffer"))?;
        let mut mapped = ptr::null_mut();
        // SAFETY: the whole buffer is mapped. It is of this context, and nothing reads it.
        unsafe {
            let flags = CL_MAP_READ | CL_MAP_WRITE;
            queue.enqueue_map_buffer(&pinned, CL_BLOCKING, flags, 0, COPY_BYTES as usize, &mut mapped, &[])
        }
        .map_err(driver("clEnqueueMapBuffer"))?;
        Ok(Self { queue, kernel, buffers, pinned, mapped, _context: context })
    }

    /// Calls `copy` for each range of each buffer, with queue, buffer, offset, bytes and pinned
    /// memory. Waits for all copies.
    fn copy(
        &self,
        copy: impl Fn(*mut c_void, *mut c_void, usize, usize, *mut c_void) -> Result<*mut c_void, i32>,
    ) -> Result<Duration, BackendError> {
        let start = Instant::now();
        for (buffer, count) in &self.buffers {
            for offset in (0..count * 16).step_by(COPY_BYTES as usize) {
                let bytes = COPY_BYTES.min(count * 16 - offset);
                copy(self.queue.get(), buffer.get(), offset as usize, bytes as usize, self.mapped)
                    .map(|event| drop(Event::new(event)))
                    .map_err(|code| driver("copying")(ClError(code)))?;
            }
        }
        self.queue.finish().map_err(driver("clFinish"))?;
        Ok(start.elapsed())
    }
}

impl Drop for OpenClFill {
    fn drop(&mut self) {
        // SAFETY: the memory was mapped once, and nothing uses it any more. An error can't be acted
        // on here.
        let _ = unsafe { self.queue.enqueue_unmap_mem_object(self.pinned.get(), self.mapped, &[]) };
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

    fn copy_to_host(&mut self) -> Result<Duration, BackendError> {
        // SAFETY: the pinned memory is as large as the largest range, and nothing reads it.
        self.copy(|queue, buffer, offset, bytes, host| unsafe {
            enqueue_read_buffer(queue, buffer, CL_NON_BLOCKING, offset, bytes, host, 0, ptr::null())
        })
    }

    fn copy_from_host(&mut self) -> Result<Option<Duration>, BackendError> {
        // SAFETY: the pinned memory is as large as the largest range, and may hold any bytes.
        self.copy(|queue, buffer, offset, bytes, host| unsafe {
            enqueue_write_buffer(queue, buffer, CL_NON_BLOCKING, offset, bytes, host, 0, ptr::null())
        })
        .map(Some)
    }
}
