//! The backend: how a device is opened.

use std::ffi::c_void;
use std::ptr;
use std::sync::Arc;

use opencl3::command_queue::{
    CL_QUEUE_CONTEXT, CL_QUEUE_DEVICE, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, CL_QUEUE_PROFILING_ENABLE,
    CL_QUEUE_PROPERTIES, create_command_queue, get_command_queue_info, retain_command_queue,
};
use opencl3::context::context::{create_context, retain_context};
use opencl3::device::Device;
use opencl3::error_codes::ClError;
use opencl3::platform::Platform;
use texere_core::backend::{Engine, Plan, Session};
use texere_core::crossings::{CrossingsPlan, CrossingsSettler};
use texere_core::settling::{Settler, SettlingPlan};
use texere_core::{Backend, BackendError, DeviceInfo, Limits};
use texere_gpu::device_name;

use crate::crossings::OpenClCrossings;
use crate::device::{self, listed};
use crate::faults::failed;
use crate::handles::Handle;
use crate::opened::Opened;
use crate::settling::OpenClSettler;
use crate::{OpenClEngine, OpenClSession, Schedule};

/// An OpenCL device, ready to start sessions.
///
/// ```no_run
/// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
/// use texere_opencl::{OpenClBackend, Schedule};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, x * x, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let device = OpenClBackend::open(0, Schedule::PerRing)?;
/// let mesh = Pipeline::new(&yarns).mesh(&device)?;
/// assert_eq!(mesh.vertices.len(), 30);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct OpenClBackend {
    info: DeviceInfo,
    pub(crate) opened: Arc<Opened>,
}

/// The number of lanes of the largest workgroup of any kernel.
const LARGEST_GROUP: usize = 256;

impl OpenClBackend {
    /// All devices of all platforms. The place in this list is the number that
    /// [`OpenClBackend::open`] takes. Nothing is opened.
    ///
    /// **Errors**: [`BackendError::Driver`] or [`BackendError::DeviceLost`], with an
    /// [`OpenClError`](crate::OpenClError) as the source, if there is no loader or no platform, or
    /// if a call of OpenCL fails.
    pub fn devices() -> Result<Vec<DeviceInfo>, BackendError> {
        Ok(listed(Schedule::PerRing)?.into_iter().map(|device| device.info).collect())
    }

    /// Opens device number `index` of [`OpenClBackend::devices`] and compiles the kernels of
    /// `schedule` for it.
    ///
    /// **Errors**: the errors of [`OpenClBackend::devices`]; [`BackendError::NoDevice`] past the
    /// last device; [`BackendError::Compile`] with the driver's log; [`BackendError::Unsupported`]
    /// for a device without workgroups of 256 lanes, and for [`Schedule::Serial`].
    pub fn open(index: usize, schedule: Schedule) -> Result<Self, BackendError> {
        let mut devices = listed(schedule)?;
        if index >= devices.len() {
            return Err(BackendError::NoDevice {
                wanted: device_name("opencl", Some(index), schedule),
                found: devices.into_iter().map(|device| device.info.name).collect(),
            });
        }
        let chosen = devices.swap_remove(index);
        let failed = |call| failed(&chosen.info.name, call);
        let context = Handle::context(create_context(&[chosen.id], ptr::null(), None, ptr::null_mut()))
            .map_err(failed("clCreateContext"))?;
        // SAFETY: the context is of this device.
        let queue = unsafe { create_command_queue(context.raw(), chosen.id, CL_QUEUE_PROFILING_ENABLE) };
        let queue = Handle::queue(queue).map_err(failed("clCreateCommandQueue"))?;
        Self::with(chosen.id, context, queue, chosen.info)
    }

    /// Opens the device of a caller's queue, and works on that queue and in its context. The
    /// device's name is `opencl` or `opencl/per-yarn`. Queue and context are retained while the
    /// backend or a session of it lives. Kernels and uploads go to the queue in the order of the
    /// calls. The tables of chunks are sent, and their results are read, through another queue.
    ///
    /// A queue without profiling does not time its commands. The host then waits for each stage,
    /// and times it by its own clock.
    ///
    /// **Errors**: [`BackendError::Unsupported`] for a queue that runs out of order; the errors of
    /// [`OpenClBackend::open`].
    ///
    /// # Safety
    ///
    /// `queue` is a valid `cl_command_queue`.
    pub unsafe fn on_queue(queue: *mut c_void, schedule: Schedule) -> Result<Self, BackendError> {
        let name = device_name("opencl", None, schedule);
        let ask = |what| get_command_queue_info(queue, what).map_err(failed(&name, "clGetCommandQueueInfo"));
        let properties = ask(CL_QUEUE_PROPERTIES)?.to_ulong();
        if properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE != 0 {
            return Err(BackendError::Unsupported {
                schedule: name,
                what: "queues that run out of order".into(),
            });
        }
        let context = ask(CL_QUEUE_CONTEXT)?.to_ptr() as *mut c_void;
        let id = ask(CL_QUEUE_DEVICE)?.to_ptr() as *mut c_void;
        // SAFETY: the queue is valid by this function's contract, and so is its context.
        let retained = unsafe { retain_context(context) };
        let context =
            Handle::context(retained.map(|()| context)).map_err(failed(&name, "clRetainContext"))?;
        // SAFETY: the queue is valid by this function's contract.
        let retained = unsafe { retain_command_queue(queue) };
        let queue = Handle::queue(retained.map(|()| queue)).map_err(failed(&name, "clRetainCommandQueue"))?;

        let known = listed(schedule)?.into_iter().find(|device| device.id == id);
        let info = match known {
            Some(device) => DeviceInfo { name, ..device.info },
            // The list has no sub-devices.
            None => {
                let part = Device::new(id);
                let platform =
                    part.platform().map_err(|ClError(code)| failed(&name, "clGetDeviceInfo")(code))?;
                device::info(&part, &Platform::new(platform), name, schedule)?
            }
        };
        let timed_by_device = properties & CL_QUEUE_PROFILING_ENABLE != 0;
        Self::with(id, context, queue, DeviceInfo { timed_by_device, ..info })
    }

    fn with(
        device: *mut c_void,
        context: Handle,
        queue: Handle,
        info: DeviceInfo,
    ) -> Result<Self, BackendError> {
        let failed = |call| failed(&info.name, call);
        let largest = Device::new(device)
            .max_work_group_size()
            .map_err(|ClError(code)| failed("clGetDeviceInfo")(code))?;
        if largest < LARGEST_GROUP {
            return Err(BackendError::Unsupported {
                schedule: info.name.clone(),
                what: format!("devices with workgroups of {largest}, fewer than {LARGEST_GROUP}"),
            });
        }
        // SAFETY: the context is of this device.
        let transfers = unsafe { create_command_queue(context.raw(), device, CL_QUEUE_PROFILING_ENABLE) };
        let transfers = Handle::queue(transfers).map_err(failed("clCreateCommandQueue"))?;
        let opened = Opened::new(device, context, [queue, transfers], &info)?;
        Ok(Self { info, opened: Arc::new(opened) })
    }

    /// This device with each of its limits lowered to that of `limits`, if that is lower.
    #[must_use]
    pub fn with_limits(mut self, limits: Limits) -> Self {
        self.info.limits = self.info.limits.min(&limits);
        self
    }

    /// Starts a session of `plan` that lends its device memory: see [`OpenClSession::device_mesh`].
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], also if the control points exceed one buffer;
    /// [`BackendError::Unsupported`] for a plan that [`Schedule::PerYarn`] can't make.
    pub fn lending_session(&self, plan: Arc<Plan>) -> Result<OpenClSession, BackendError> {
        let engine = OpenClEngine::new(self.opened.clone(), &self.info.limits, plan.clone())?;
        Ok(OpenClSession(Session::with_engine(Box::new(engine), self.info.limits, plan)))
    }
}

impl Backend for OpenClBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        Ok(Box::new(OpenClEngine::new(self.opened.clone(), &self.info.limits, plan)?))
    }

    /// Both schedules settle in the same way.
    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        Ok(Box::new(OpenClSettler::new(self.opened.clone(), &self.info.limits, plan)?))
    }

    fn crossings_settler(&self, plan: Arc<CrossingsPlan>) -> Result<Box<dyn CrossingsSettler>, BackendError> {
        Ok(Box::new(OpenClCrossings::new(self.opened.clone(), &self.info.limits, plan)?))
    }
}
