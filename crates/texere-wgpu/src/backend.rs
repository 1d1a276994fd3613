//! The backend: how a device is opened.

use std::sync::{Arc, Mutex, PoisonError};

use texere_core::backend::{Engine, Plan, Session};
use texere_core::crossings::{CrossingsPlan, CrossingsSettler};
use texere_core::settling::{Settler, SettlingPlan};
use texere_core::{Backend, BackendError, DeviceInfo, Limits};
use texere_gpu::device_name;
use wgpu::Features;

use crate::Schedule;
use crate::clock::has_clock;
use crate::crossings::WgpuCrossings;
use crate::device::{LONG_ATOMICS, adapters, describe, none};
use crate::engine::WgpuEngine;
use crate::gpu::Gpu;
use crate::opened::Opened;
use crate::session::WgpuSession;
use crate::settling::WgpuSettler;

/// A wgpu device, ready to start sessions.
///
/// ```no_run
/// use texere_core::Backend;
/// use texere_wgpu::{Schedule, WgpuBackend};
/// for device in WgpuBackend::devices()? {
///     println!("{}: {} ({})", device.name, device.device, device.kind);
/// }
/// let backend = WgpuBackend::open_named("llvmpipe", Schedule::PerRing)?;
/// assert!(backend.info().device.contains("llvmpipe"));
/// # Ok::<(), texere_core::BackendError>(())
/// ```
///
/// Clones share the open device.
#[derive(Debug, Clone)]
pub struct WgpuBackend {
    info: DeviceInfo,
    pub(crate) opened: Arc<Opened>,
}

impl WgpuBackend {
    /// All devices. The place in this list is the number that [`WgpuBackend::open`] takes;
    /// [`DeviceInfo::name`] is `wgpu:0` and so on. Devices are listed once in a process.
    ///
    /// **Errors**: [`BackendError::NoDevice`] if there is no device or no driver.
    pub fn devices() -> Result<Vec<DeviceInfo>, BackendError> {
        let described = Self::describe(adapters());
        if described.is_empty() { Err(none("wgpu".into(), &[])) } else { Ok(described) }
    }

    /// The information that [`WgpuBackend::devices`] gives, about a program's own adapters, such as
    /// those that can draw into its window.
    #[must_use]
    pub fn describe(adapters: &[wgpu::Adapter]) -> Vec<DeviceInfo> {
        let describe = |(index, adapter): (usize, &wgpu::Adapter)| {
            let name = device_name("wgpu", Some(index), Schedule::PerRing);
            let timed = has_clock(adapter.features());
            describe(name, &adapter.get_info(), &adapter.limits(), timed, Schedule::PerRing)
        };
        adapters.iter().enumerate().map(describe).collect()
    }

    /// The features and limits that [`WgpuBackend::open`] requests: the adapter's limits, and
    /// timestamp queries and [`LONG_ATOMICS`] if it offers them. A program that opens a device
    /// itself uses this descriptor before [`WgpuBackend::from_device`].
    #[must_use]
    pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        wgpu::DeviceDescriptor {
            label: Some("texere"),
            required_features: adapter.features() & Features::TIMESTAMP_QUERY.union(LONG_ATOMICS),
            required_limits: adapter.limits(),
            ..Default::default()
        }
    }

    /// Opens device number `index` of [`WgpuBackend::devices`], with timestamp queries and
    /// [`LONG_ATOMICS`] if it has them.
    ///
    /// **Errors**: [`BackendError::NoDevice`], which lists the devices that exist;
    /// [`BackendError::Driver`] if the device can't be opened; [`BackendError::Compile`];
    /// [`BackendError::DeviceLost`]; [`BackendError::Unsupported`] for [`Schedule::Serial`].
    pub fn open(index: usize, schedule: Schedule) -> Result<Self, BackendError> {
        let adapters = adapters();
        let adapter =
            adapters.get(index).ok_or_else(|| none(device_name("wgpu", Some(index), schedule), adapters))?;
        // Devices are opened one at a time, for the reason that [`adapters`] gives.
        static OPENING: Mutex<()> = Mutex::new(());
        let opening = OPENING.lock().unwrap_or_else(PoisonError::into_inner);
        let (device, queue) =
            pollster::block_on(adapter.request_device(&Self::descriptor(adapter))).map_err(|source| {
                BackendError::Driver { call: "Adapter::request_device", source: source.into() }
            })?;
        drop(opening);
        Self::new(Gpu::owned(device_name("wgpu", Some(index), schedule), device, queue), schedule)
    }

    /// Opens the first device whose [`DeviceInfo::device`] contains `part`, in upper or lower case.
    ///
    /// **Errors**: the errors of [`WgpuBackend::open`].
    pub fn open_named(part: &str, schedule: Schedule) -> Result<Self, BackendError> {
        let (adapters, wanted) = (adapters(), part.to_lowercase());
        let index = adapters
            .iter()
            .position(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted))
            .ok_or_else(|| none(part.into(), adapters))?;
        Self::open(index, schedule)
    }

    /// A backend on a caller's device, such as a viewer's. The backend's name is `wgpu`.
    ///
    /// All calls are made within error scopes, and the device's callbacks remain the caller's. No
    /// feature is needed. `TIMESTAMP_QUERY` makes timings exact, and [`LONG_ATOMICS`] make pictures
    /// faster. With wgpu's default limits a chunk has up to 128 MiB of vertices.
    /// [`Schedule::PerRing`] is the fast and complete schedule; [`Schedule::PerYarn`] is the
    /// paper's, for comparison.
    ///
    /// ```no_run
    /// use texere_wgpu::{Schedule, WgpuBackend, wgpu};
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// # pollster::block_on(async {
    /// let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    /// let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await?;
    /// let (device, queue) = adapter.request_device(&wgpu::DeviceDescriptor::default()).await?;
    /// let backend = WgpuBackend::from_device(device.clone(), queue.clone(), Schedule::PerRing)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// # })?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`BackendError::Compile`], also if the device's limits are below WebGPU's
    /// defaults; [`BackendError::Unsupported`] for [`Schedule::Serial`].
    pub fn from_device(
        device: wgpu::Device,
        queue: wgpu::Queue,
        schedule: Schedule,
    ) -> Result<Self, BackendError> {
        Self::new(Gpu::borrowed(device_name("wgpu", None, schedule), device, queue), schedule)
    }

    fn new(gpu: Gpu, schedule: Schedule) -> Result<Self, BackendError> {
        let (adapter, timed) = (gpu.device.adapter_info(), has_clock(gpu.device.features()));
        let info = describe(gpu.name.clone(), &adapter, &gpu.device.limits(), timed, schedule);
        Ok(Self { info, opened: Arc::new(Opened::new(gpu, schedule)?) })
    }

    /// This device with each of its limits lowered to that of `limits`, if that is lower. Use it
    /// for a device with less memory than its bindings could hold, or to test with many small
    /// chunks.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        let info = DeviceInfo { limits: self.info.limits.min(&limits), ..self.info };
        Self { info, ..self }
    }

    /// Starts a session of `plan` that lends its buffers.
    ///
    /// **Errors**: the errors of [`Backend::engine`].
    pub fn lending_session(&self, plan: Arc<Plan>) -> Result<WgpuSession, BackendError> {
        let engine = WgpuEngine::new(self.opened.clone(), plan.clone())?;
        Ok(WgpuSession(Session::with_engine(Box::new(engine), self.info.limits, plan)))
    }

    /// The device, for buffers and pipelines that work together with a session's.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.opened.gpu.device
    }

    /// The queue that sessions submit their work to.
    #[must_use]
    pub fn queue(&self) -> &wgpu::Queue {
        &self.opened.gpu.queue
    }

    /// Runs `work`, a caller's own calls on the device and its queue, so that a fault in `work`
    /// becomes an error and not a panic. `call` is the name of the work in the error.
    ///
    /// **Errors**: [`BackendError::DeviceLost`], [`BackendError::Driver`].
    pub fn scoped<T>(&self, call: &'static str, work: impl FnOnce() -> T) -> Result<T, BackendError> {
        self.opened.gpu.scoped(call, work)
    }

    /// A buffer of at least `bytes`, rounded up to a multiple of 16. It is never empty, since wgpu
    /// can't bind an empty buffer.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`]; the errors of [`WgpuBackend::scoped`].
    pub fn buffer(
        &self,
        what: &'static str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, BackendError> {
        self.opened.gpu.buffer(what, bytes, usage)
    }

    /// Waits until `submission` is done, and runs the callbacks of all submissions that are done.
    ///
    /// **Errors**: [`BackendError::DeviceLost`]; [`BackendError::Driver`] after two minutes.
    pub fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), BackendError> {
        self.opened.gpu.wait(submission)
    }

    /// Waits until `submission` is done, or until `goes_on` returns false. `goes_on` is called
    /// every ten milliseconds. Returns whether the submission is done. If it is not, the device
    /// goes on with it.
    ///
    /// **Errors**: [`BackendError::DeviceLost`]; [`BackendError::Driver`] after four minutes. In
    /// the last two of these minutes `goes_on` is not called.
    pub fn wait_while(
        &self,
        submission: &wgpu::SubmissionIndex,
        goes_on: impl FnMut() -> bool,
    ) -> Result<bool, BackendError> {
        self.opened.gpu.wait_while(submission, goes_on)
    }
}

impl Backend for WgpuBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        Ok(Box::new(WgpuEngine::new(self.opened.clone(), plan)?))
    }

    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        Ok(Box::new(WgpuSettler::new(self.opened.clone(), &self.info.limits, plan)?))
    }

    fn crossings_settler(&self, plan: Arc<CrossingsPlan>) -> Result<Box<dyn CrossingsSettler>, BackendError> {
        Ok(Box::new(WgpuCrossings::new(self.opened.clone(), &self.info.limits, plan)?))
    }
}
