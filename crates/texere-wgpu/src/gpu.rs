//! A device with its queue. All calls of wgpu go through it, and their errors are returned, so that
//! no call can panic or hang.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use texere_core::{BackendError, OutOfMemory};
use wgpu::{BufferUsages, ErrorFilter, PollError, PollType, SubmissionIndex};

/// The time after which the wait for a submission ends with an error. A chunk takes milliseconds on
/// a GPU and seconds on a software device. A chunk that takes two minutes is considered to hang.
pub(crate) const WAIT_LIMIT: Duration = Duration::from_secs(120);

/// The time between two questions to the caller whether a wait should go on.
const ASKED: Duration = Duration::from_millis(10);

/// The shortest sleep of a wait that the caller may end. Later sleeps are an eighth of the time
/// waited, so that a wait is at most an eighth too long.
const SLEEP_LEAST: Duration = Duration::from_micros(20);

/// Every buffer's length is a multiple of this number of bytes, which is the size of the widest
/// vector in a shader's array.
const BUFFER_STEP: u64 = 16;

/// A device and its queue.
#[derive(Debug)]
pub(crate) struct Gpu {
    /// The name of the device in `DeviceInfo`.
    pub(crate) name: String,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    /// The reason why the device was lost, or none. On a caller's device it stays empty, because
    /// the callbacks are the caller's.
    lost: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// A caller's device.
    pub(crate) fn borrowed(name: String, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self { name, device, queue, lost: Arc::default() }
    }

    /// A device that this crate has opened. Errors outside a scope do not panic, and the device's
    /// loss is noted.
    pub(crate) fn owned(name: String, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let gpu = Self::borrowed(name, device, queue);
        let note = |lost: &Mutex<Option<String>>, reason: String| {
            lost.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(reason);
        };
        let lost = gpu.lost.clone();
        gpu.device.set_device_lost_callback(move |_, reason| note(&lost, reason));
        let lost = gpu.lost.clone();
        // Every call here is in a scope, so an error outside one comes from the device itself.
        gpu.device.on_uncaptured_error(Arc::new(move |error| note(&lost, error.to_string())));
        gpu
    }

    /// **Errors**: [`BackendError::DeviceLost`].
    pub(crate) fn check_alive(&self) -> Result<(), BackendError> {
        match &*self.lost.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(reason) => Err(self.lost(reason.clone())),
            None => Ok(()),
        }
    }

    /// Asks the device whether it is still there. Calls of wgpu on a lost device do not fail, but a
    /// lost device can't map a new buffer.
    ///
    /// **Errors**: [`BackendError::DeviceLost`].
    pub(crate) fn probe(&self) -> Result<(), BackendError> {
        self.check_alive()?;
        let descriptor = wgpu::BufferDescriptor {
            label: Some("probe"),
            size: BUFFER_STEP,
            usage: BufferUsages::COPY_SRC,
            mapped_at_creation: true,
        };
        let answer = self.caught(|| self.device.create_buffer(&descriptor).get_mapped_range(..).map(|_| ()));
        self.check_alive()?;
        match answer {
            Ok(Err(source)) => Err(self.lost(source)),
            // A device that has too little memory is not lost.
            Ok(Ok(())) | Err(_) => Ok(()),
        }
    }

    pub(crate) fn lost(&self, source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> BackendError {
        BackendError::DeviceLost { device: self.name.clone(), source: Some(source.into()) }
    }

    /// Runs `work` within error scopes. If memory was lacking, that error is returned, and not the
    /// errors that followed from it.
    pub(crate) fn caught<T>(&self, work: impl FnOnce() -> T) -> Result<T, wgpu::Error> {
        let scopes = [ErrorFilter::Validation, ErrorFilter::Internal, ErrorFilter::OutOfMemory]
            .map(|filter| self.device.push_error_scope(filter));
        let result = work();
        // The innermost scope ends first. On every platform but the web its result is available at
        // once.
        let errors = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop()));
        errors.reduce(|first, _| first).map_or(Ok(result), Err)
    }

    /// Runs `work` within error scopes. `call` is the name of the work in an error.
    ///
    /// **Errors**: [`BackendError::DeviceLost`], [`BackendError::Driver`].
    pub(crate) fn scoped<T>(&self, call: &'static str, work: impl FnOnce() -> T) -> Result<T, BackendError> {
        self.check_alive()?;
        let result = self.caught(work);
        self.check_alive()?;
        result.map_err(|source| match self.probe() {
            // A lost device causes other errors as well.
            Err(lost) => lost,
            Ok(()) => BackendError::Driver { call, source: source.into() },
        })
    }

    /// A buffer of at least `bytes`, rounded up to a multiple of [`BUFFER_STEP`]. It is never
    /// empty, since wgpu can't bind an empty buffer.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], also for more than the device's largest buffer;
    /// [`BackendError::Driver`]; [`BackendError::DeviceLost`]. Whether the buffer fits a binding is
    /// not checked.
    pub(crate) fn buffer(
        &self,
        what: &'static str,
        bytes: u64,
        usage: BufferUsages,
    ) -> Result<wgpu::Buffer, BackendError> {
        self.check_alive()?;
        let size = bytes.max(1).next_multiple_of(BUFFER_STEP);
        if size > self.device.limits().max_buffer_size {
            return Err(BackendError::OutOfMemory(OutOfMemory { what, bytes }));
        }
        let descriptor = wgpu::BufferDescriptor { label: Some(what), size, usage, mapped_at_creation: false };
        let buffer = self.caught(|| self.device.create_buffer(&descriptor)).map_err(|error| match error {
            wgpu::Error::OutOfMemory { .. } => BackendError::OutOfMemory(OutOfMemory { what, bytes }),
            source => BackendError::Driver { call: "Device::create_buffer", source: source.into() },
        });
        self.check_alive()?;
        buffer
    }

    /// Sends `bytes` to `buffer`. They arrive before any later launch.
    pub(crate) fn write(&self, buffer: &wgpu::Buffer, offset: u64, bytes: &[u8]) -> Result<(), BackendError> {
        if bytes.is_empty() {
            return Ok(());
        }
        self.scoped("Queue::write_buffer", || self.queue.write_buffer(buffer, offset, bytes))
    }

    /// Waits until `submission` is done, and runs the callbacks of all submissions that are done.
    ///
    /// **Errors**: [`BackendError::DeviceLost`]; [`BackendError::Driver`] after two minutes.
    pub(crate) fn wait(&self, submission: SubmissionIndex) -> Result<(), BackendError> {
        if self.waits(submission, WAIT_LIMIT)? {
            return Ok(());
        }
        Err(too_long())
    }

    /// Waits until `submission` is done, or until `goes_on` returns false. `goes_on` is called
    /// every ten milliseconds. Returns whether the submission is done.
    ///
    /// **Errors**: [`BackendError::DeviceLost`]; [`BackendError::Driver`] after two minutes.
    pub(crate) fn wait_while(
        &self,
        submission: &SubmissionIndex,
        mut goes_on: impl FnMut() -> bool,
    ) -> Result<bool, BackendError> {
        let (start, mut asked) = (Instant::now(), Duration::ZERO);
        // The driver is only asked whether the submission is done, and this thread sleeps in
        // between. When lavapipe (Mesa 22.3) was asked to wait for up to ten milliseconds, it now
        // and then reported a lost device.
        while !self.waits(submission.clone(), Duration::ZERO)? {
            let waited = start.elapsed();
            if waited > WAIT_LIMIT {
                return Err(too_long());
            }
            if waited > asked + ASKED {
                asked = waited;
                if !goes_on() {
                    return Ok(false);
                }
            }
            std::thread::sleep((waited / 8).clamp(SLEEP_LEAST, ASKED));
        }
        Ok(true)
    }

    /// Waits until `submission` is done, but no longer than `limit`. Returns whether it is done.
    fn waits(&self, submission: SubmissionIndex, limit: Duration) -> Result<bool, BackendError> {
        self.check_alive()?;
        let poll = PollType::Wait { submission_index: Some(submission), timeout: Some(limit) };
        // wgpu 30 panics in `poll` if the driver reports that the device is lost, and there is no
        // other way to wait.
        let answer = catch_unwind(AssertUnwindSafe(|| self.device.poll(poll)));
        self.check_alive()?;
        match answer {
            Ok(Ok(_)) => Ok(true),
            Ok(Err(PollError::Timeout)) => Ok(false),
            // The device never received the submission: submitting failed because the device was
            // lost.
            Ok(Err(source)) => Err(self.lost(source)),
            Err(panic) => {
                let said = panic.downcast_ref::<String>().map_or("no reason", String::as_str);
                Err(self.lost(format!("the driver reported it while its work was waited for: {said}")))
            }
        }
    }
}

/// The error of work that took longer than [`WAIT_LIMIT`].
fn too_long() -> BackendError {
    BackendError::Driver { call: "Device::poll", source: PollError::Timeout.into() }
}
