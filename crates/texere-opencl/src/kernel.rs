//! One kernel: its arguments and its launch.

use std::ffi::{CString, c_void};
use std::ops::Range;
use std::ptr;
use std::sync::Arc;

use opencl3::command_queue::enqueue_nd_range_kernel;
use opencl3::error_codes::CL_INVALID_KERNEL_NAME;
use opencl3::kernel::{create_kernel, set_kernel_arg};
use texere_core::BackendError;
use texere_kernels::EntryPoint;

use crate::buffer::Buffer;
use crate::handles::Handle;
use crate::opened::Opened;

/// A kernel of a program. OpenCL keeps arguments in it, so each engine and each settler has kernels
/// of its own.
#[derive(Debug)]
pub(crate) struct Kernel {
    handle: Handle,
    group: usize,
}

/// An argument of a kernel.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Arg<'a> {
    /// A `__global` pointer, or null if the buffer is empty.
    Memory(&'a Buffer),
    /// A value, byte for byte.
    Value(&'a [u8]),
}

/// The most workgroups of one launch: 16 million rings, a few milliseconds on a GPU. Launches of
/// this size end before a driver's watchdog stops them.
pub(crate) const LAUNCH_GROUPS: usize = 1 << 18;

impl Kernel {
    /// The kernel `entry` of the schedule's program for round yarns, or, with `flattened`, of the
    /// program for all yarns.
    pub(crate) fn new(opened: &Opened, entry: EntryPoint, flattened: bool) -> Result<Self, BackendError> {
        Self::of(opened, opened.program(flattened)?, entry)
    }

    /// The kernel `entry` of `program`.
    pub(crate) fn of(opened: &Opened, program: &Handle, entry: EntryPoint) -> Result<Self, BackendError> {
        let failed = opened.failed("clCreateKernel");
        let name = CString::new(entry.name).map_err(|_| failed(CL_INVALID_KERNEL_NAME))?;
        let handle = Handle::kernel(create_kernel(program.raw(), &name)).map_err(failed)?;
        Ok(Self { handle, group: entry.group })
    }

    /// The number of lanes in a workgroup.
    pub(crate) fn group(&self) -> usize {
        self.group
    }

    /// Sets all arguments, in the order of the source, and launches the workgroups `groups` after
    /// what is in the queue and after `after`. More than [`LAUNCH_GROUPS`] workgroups take several
    /// launches. Returns the launches' events, in order.
    ///
    /// # Safety
    ///
    /// `args` are those of the kernel's source, in order, and every buffer among them is large
    /// enough for all that the workgroups `groups` read and write.
    pub(crate) unsafe fn run(
        &mut self,
        opened: &Opened,
        args: &[Arg<'_>],
        groups: Range<usize>,
        after: Option<&Handle>,
    ) -> Result<Vec<Arc<Handle>>, BackendError> {
        for (number, arg) in args.iter().enumerate() {
            let memory;
            let (bytes, value) = match arg {
                Arg::Memory(buffer) => {
                    memory = buffer.raw();
                    (size_of::<*mut c_void>(), (&raw const memory).cast::<c_void>())
                }
                Arg::Value(value) => (value.len(), value.as_ptr().cast()),
            };
            // SAFETY: `value` points at `bytes` bytes, which the call copies. They suit the
            // parameter by this function's contract.
            unsafe { set_kernel_arg(self.handle.raw(), number as u32, bytes, value) }
                .map_err(opened.failed("clSetKernelArg"))?;
        }
        let after = after.map(Handle::raw);
        let (events, list) = after.as_ref().map_or((0, ptr::null()), |event| (1, ptr::from_ref(event)));
        let mut launches = Vec::with_capacity(groups.len().div_ceil(LAUNCH_GROUPS));
        for first in groups.clone().step_by(LAUNCH_GROUPS) {
            let offset = first * self.group;
            let lanes = (groups.end - first).min(LAUNCH_GROUPS) * self.group;
            // SAFETY: the launch has one dimension, and each pointer is to one value. The event is
            // alive. The arguments suit the kernel by this function's contract.
            let event = unsafe {
                enqueue_nd_range_kernel(
                    opened.queue.raw(),
                    self.handle.raw(),
                    1,
                    &raw const offset,
                    &raw const lanes,
                    &raw const self.group,
                    events,
                    list,
                )
            };
            launches.push(Arc::new(Handle::event(event).map_err(opened.failed("clEnqueueNDRangeKernel"))?));
        }
        Ok(launches)
    }
}

/// Launches a kernel with at least `lanes` lanes, in whole workgroups, after what is in the queue.
///
/// # Safety
///
/// The contract of [`Kernel::run`].
pub(crate) unsafe fn start(
    kernel: &mut Kernel,
    opened: &Opened,
    args: &[Arg<'_>],
    lanes: u32,
) -> Result<(), BackendError> {
    let groups = (lanes as usize).div_ceil(kernel.group());
    // SAFETY: the arguments suit the kernel by this function's contract.
    unsafe { kernel.run(opened, args, 0..groups, None) }?;
    Ok(())
}

/// The arguments for `buffers`.
pub(crate) fn in_memory<'a, const COUNT: usize>(buffers: [&'a Buffer; COUNT]) -> [Arg<'a>; COUNT] {
    buffers.map(Arg::Memory)
}
