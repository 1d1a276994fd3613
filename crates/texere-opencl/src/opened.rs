//! An open device, which all sessions of a backend share.

use std::ffi::{CString, c_void};
use std::ptr;
use std::sync::OnceLock;

use opencl3::command_queue::{CL_QUEUE_DEVICE, get_command_queue_info};
use opencl3::error_codes::{CL_BUILD_PROGRAM_FAILURE, ClError};
use opencl3::event::wait_for_events;
use opencl3::program::{
    CL_PROGRAM_BUILD_LOG, build_program, create_program_with_source, get_program_build_info,
};
use texere_core::backend::Schedule;
use texere_core::{BackendError, DeviceInfo};
use texere_gpu::{Language, prelude, serial_unsupported};
use texere_kernels::{ATTRIBUTES, CROSSINGS, KernelProgram, PACKING, PER_RING, PER_YARN, SETTLING};

use crate::faults::failed;
use crate::handles::Handle;

/// A device with its context, its queues and its compiled programs.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) name: String,
    pub(crate) schedule: Schedule,
    pub(crate) context: Handle,
    /// The queue of kernels and of uploads of control points. It runs its commands in the order of
    /// the calls.
    pub(crate) queue: Handle,
    /// Whether `queue` times its commands.
    pub(crate) profiled: bool,
    /// The queue that sends a chunk's tables to the device and its results to the host, while the
    /// kernels of another chunk run.
    pub(crate) transfers: Handle,
    /// The program for round yarns alone.
    round: Handle,
    /// The program for all yarns, compiled at its first use.
    flattened: OnceLock<Handle>,
    /// The program of attributes, compiled at its first use.
    attributes: OnceLock<Handle>,
    /// The programs of packed vertices for round yarns alone and for all yarns, each compiled at
    /// its first use.
    packing: [OnceLock<Handle>; 2],
    /// The programs of settlings for round yarns alone and for all yarns, each compiled at its
    /// first use.
    settling: [OnceLock<Handle>; 2],
    /// The program of crossings, compiled at its first use.
    crossings: OnceLock<Handle>,
}

impl Opened {
    /// Compiles the program for round yarns.
    pub(crate) fn new(
        device: *mut c_void,
        context: Handle,
        queues: [Handle; 2],
        info: &DeviceInfo,
    ) -> Result<Self, BackendError> {
        let program = program(info.schedule, &info.name)?;
        let round = build(device, &context, &info.name, program, false)?;
        let [queue, transfers] = queues;
        Ok(Self {
            name: info.name.clone(),
            schedule: info.schedule,
            context,
            queue,
            profiled: info.timed_by_device,
            transfers,
            round,
            flattened: OnceLock::new(),
            attributes: OnceLock::new(),
            packing: Default::default(),
            settling: Default::default(),
            crossings: OnceLock::new(),
        })
    }

    /// The program for round yarns alone, or, with `flattened`, for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::Driver`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn program(&self, flattened: bool) -> Result<&Handle, BackendError> {
        if !flattened {
            return Ok(&self.round);
        }
        self.compiled(&self.flattened, program(self.schedule, &self.name)?, true)
    }

    /// The program of attributes.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::Driver`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn attributes(&self) -> Result<&Handle, BackendError> {
        // Attributes do not depend on half widths and half heights.
        self.compiled(&self.attributes, ATTRIBUTES, false)
    }

    /// The program of packed vertices for round yarns alone, or, with `flattened`, for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::Driver`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn packing(&self, flattened: bool) -> Result<&Handle, BackendError> {
        self.compiled(&self.packing[usize::from(flattened)], PACKING, flattened)
    }

    /// The program of settlings for round yarns alone, or, with `flattened`, for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::Driver`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn settling(&self, flattened: bool) -> Result<&Handle, BackendError> {
        self.compiled(&self.settling[usize::from(flattened)], SETTLING, flattened)
    }

    /// The program of crossings.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::Driver`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn crossings(&self) -> Result<&Handle, BackendError> {
        // Threads at crossings have half widths and half heights of their own, so the program for
        // flattened yarns is compiled.
        self.compiled(&self.crossings, CROSSINGS, true)
    }

    /// The compiled `program`, from `held`. It is compiled if `held` is empty.
    fn compiled<'a>(
        &self,
        held: &'a OnceLock<Handle>,
        program: KernelProgram,
        flattened: bool,
    ) -> Result<&'a Handle, BackendError> {
        if let Some(compiled) = held.get() {
            return Ok(compiled);
        }
        let device = get_command_queue_info(self.queue.raw(), CL_QUEUE_DEVICE);
        let device = device.map_err(self.failed("clGetCommandQueueInfo"))?.to_ptr() as *mut c_void;
        let compiled = build(device, &self.context, &self.name, program, flattened)?;
        // Another engine or settler may have compiled the program meanwhile.
        Ok(held.get_or_init(|| compiled))
    }

    /// Waits until `event`'s command has ended.
    pub(crate) fn wait(&self, event: &Handle) -> Result<(), BackendError> {
        wait_for_events(&[event.raw()]).map_err(self.failed("clWaitForEvents"))
    }

    /// The error of `call`, from OpenCL's status.
    pub(crate) fn failed(&self, call: &'static str) -> impl Fn(i32) -> BackendError {
        failed(&self.name, call)
    }
}

/// The program of `schedule`. `name` is the device's name, for the error.
fn program(schedule: Schedule, name: &str) -> Result<KernelProgram, BackendError> {
    match schedule {
        Schedule::PerRing => Ok(PER_RING),
        Schedule::PerYarn => Ok(PER_YARN),
        Schedule::Serial => Err(serial_unsupported(name)),
    }
}

/// Compiles `program` for `device`.
fn build(
    device: *mut c_void,
    context: &Handle,
    name: &str,
    program: KernelProgram,
    flattened: bool,
) -> Result<Handle, BackendError> {
    // The source is passed as one string, because cl3 0.13 passes several strings as if slices were
    // pointers.
    let source = prelude(Language::OpenClC, flattened) + &program.sources.concat();
    let built = Handle::program(create_program_with_source(context.raw(), &[&source]))
        .map_err(failed(name, "clCreateProgramWithSource"))?;
    let options = CString::from(c"-cl-std=CL1.2");
    match build_program(built.raw(), &[device], &options, None, ptr::null_mut()) {
        Ok(()) => Ok(built),
        Err(CL_BUILD_PROGRAM_FAILURE) => Err(BackendError::Compile {
            kernel: program.name,
            log: get_program_build_info(built.raw(), device, CL_PROGRAM_BUILD_LOG)
                .map_or_else(|code| ClError(code).to_string(), |log| log.to_string()),
        }),
        Err(code) => Err(failed(name, "clBuildProgram")(code)),
    }
}

#[cfg(test)]
mod tests {
    use opencl3::context::context::create_context;

    use crate::device::listed;

    use super::*;

    #[test]
    fn a_kernel_that_does_not_compile_comes_with_the_drivers_log() {
        let chosen = listed(Schedule::PerRing).unwrap().swap_remove(0);
        let context = create_context(&[chosen.id], ptr::null(), None, ptr::null_mut());
        let context = Handle::context(context).unwrap();
        let broken = KernelProgram {
            name: "broken",
            sources: &["__kernel void broken() { undeclared(); }"],
            entries: &[],
        };
        match build(chosen.id, &context, &chosen.info.name, broken, false) {
            Err(BackendError::Compile { kernel: "broken", log }) => {
                assert!(log.contains("undeclared"), "{log}")
            }
            other => panic!("{other:?}"),
        }
    }
}
