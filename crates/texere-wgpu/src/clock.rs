//! The time of each stage, by the device's own clock if it can be read.

use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::time::{Duration, Instant};

use texere_core::BackendError;
use texere_core::backend::StageTimings;
use wgpu::{BufferUsages, ComputePassTimestampWrites, Features, MapMode, SubmissionIndex};

use crate::gpu::{Gpu, WAIT_LIMIT};

/// Whether the clock of a device with `features` can be read. If not, the host times a launch from
/// its submission to the moment when the host notices its end. If the previous launch ends only
/// after the submission, the time begins when the host notices the end of the previous launch.
/// Uploads and readbacks are always timed by the host.
pub(crate) fn has_clock(features: Features) -> bool {
    features.contains(Features::TIMESTAMP_QUERY)
}

/// A stage that runs on the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Timed {
    Scan,
    Trajectory,
    Mesh,
}

/// The number of launches that can be timed at once. A further launch waits for the first of them.
const STAMPS: u32 = 16;

/// The bytes of a stamp: the two ticks at which a launch began and ended.
const STAMP_BYTES: u64 = 2 * wgpu::QUERY_SIZE as u64;

/// Adds up the times of launches that are done.
#[derive(Debug)]
pub(crate) struct Clock {
    stamps: Option<Stamps>,
    pending: Vec<Pending>,
    /// The moment when the host noticed the end of the last launch.
    seen: Option<Instant>,
    totals: StageTimings,
}

/// A launch whose end the host has not yet noticed. `done` receives the moment of its end.
#[derive(Debug)]
struct Pending {
    timed: Timed,
    launched: Instant,
    submission: SubmissionIndex,
    done: Receiver<Instant>,
    stamp: Option<u32>,
}

/// The device's clock.
#[derive(Debug)]
struct Stamps {
    queries: wgpu::QuerySet,
    /// The ticks that queries are resolved to. A stamp begins at each multiple of
    /// [`wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT`] bytes.
    resolved: wgpu::Buffer,
    /// A buffer for each stamp, since a mapped buffer can't be copied to.
    mapped: Vec<wgpu::Buffer>,
    free: Vec<u32>,
    nanoseconds_per_tick: f64,
}

impl Clock {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        let stamps = if has_clock(gpu.device.features()) { Some(Stamps::new(gpu)?) } else { None };
        Ok(Self { stamps, pending: Vec::new(), seen: None, totals: StageTimings::default() })
    }

    /// Runs what `record` writes into a compute pass, and times it.
    pub(crate) fn run(
        &mut self,
        gpu: &Gpu,
        timed: Timed,
        record: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) -> Result<(), BackendError> {
        self.collect(gpu);
        if self.stamps.as_ref().is_some_and(|stamps| stamps.free.is_empty()) && !self.pending.is_empty() {
            let first = self.pending.remove(0);
            self.finish(gpu, first)?;
        }
        let Self { stamps, pending, .. } = self;
        let stamp = stamps.as_mut().and_then(|stamps| stamps.free.pop());
        let launched = Instant::now();
        let (note, done) = sync_channel(1);
        let submission = gpu.scoped("Queue::submit", || {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let stamped = stamps.as_ref().zip(stamp);
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: None,
                timestamp_writes: stamped.map(|(stamps, stamp)| stamps.writes(stamp)),
            });
            record(&mut pass);
            drop(pass);
            if let Some((stamps, stamp)) = stamped {
                stamps.resolve(&mut encoder, stamp);
            }
            let submission = gpu.queue.submit([encoder.finish()]);
            match stamped.and_then(|(stamps, stamp)| stamps.mapped.get(stamp as usize)) {
                Some(buffer) => buffer.map_async(MapMode::Read, .., move |answer| {
                    if answer.is_ok() {
                        let _ = note.send(Instant::now());
                    }
                }),
                None => gpu.queue.on_submitted_work_done(move || {
                    let _ = note.send(Instant::now());
                }),
            }
            submission
        })?;
        pending.push(Pending { timed, launched, submission, done, stamp });
        Ok(())
    }

    /// Adds the times of launches whose end was noticed.
    fn collect(&mut self, gpu: &Gpu) {
        for launch in std::mem::take(&mut self.pending) {
            match launch.done.try_recv() {
                Err(TryRecvError::Empty) => self.pending.push(launch),
                answer => self.add(gpu, &launch, answer.ok()),
            }
        }
    }

    /// Waits for a launch, and adds its time.
    fn finish(&mut self, gpu: &Gpu, launch: Pending) -> Result<(), BackendError> {
        let waited = gpu.wait(launch.submission.clone());
        // The poll of another thread may have noticed the end, and may not have reported it yet.
        let done = if waited.is_ok() { launch.done.recv_timeout(WAIT_LIMIT).ok() } else { None };
        self.add(gpu, &launch, done);
        waited
    }

    /// Adds the time of a launch whose end was noticed, or never will be.
    fn add(&mut self, gpu: &Gpu, launch: &Pending, done: Option<Instant>) {
        let time = match (&mut self.stamps, launch.stamp, done) {
            (Some(stamps), Some(stamp), _) => stamps.take(gpu, stamp),
            (_, _, Some(done)) => {
                // Launches follow one another on the queue, so no moment counts for two.
                let started = self.seen.map_or(launch.launched, |seen| seen.max(launch.launched));
                self.seen = Some(done);
                done.saturating_duration_since(started)
            }
            _ => Duration::ZERO,
        };
        let total = match launch.timed {
            Timed::Scan => &mut self.totals.scan,
            Timed::Trajectory => &mut self.totals.trajectory,
            Timed::Mesh => &mut self.totals.mesh,
        };
        *total += time;
    }

    /// Waits for all launches, and returns their times. If the device is lost, returns the times of
    /// the launches that ended before the loss.
    pub(crate) fn totals(&mut self, gpu: &Gpu) -> StageTimings {
        for launch in std::mem::take(&mut self.pending) {
            if self.finish(gpu, launch).is_err() {
                break;
            }
        }
        self.totals
    }
}

impl Stamps {
    fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        let step = wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT;
        let queries = gpu.scoped("Device::create_query_set", || {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2 * STAMPS,
            })
        })?;
        let mapped =
            || gpu.buffer("timestamps", STAMP_BYTES, BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        Ok(Self {
            queries,
            resolved: gpu.buffer(
                "timestamps",
                u64::from(STAMPS) * step,
                BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC,
            )?,
            mapped: (0..STAMPS).map(|_| mapped()).collect::<Result<_, _>>()?,
            free: (0..STAMPS).collect(),
            nanoseconds_per_tick: gpu.queue.get_timestamp_period().into(),
        })
    }

    fn writes(&self, stamp: u32) -> ComputePassTimestampWrites<'_> {
        ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * stamp),
            end_of_pass_write_index: Some(2 * stamp + 1),
        }
    }

    fn resolve(&self, encoder: &mut wgpu::CommandEncoder, stamp: u32) {
        let offset = u64::from(stamp) * wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT;
        encoder.resolve_query_set(&self.queries, 2 * stamp..2 * stamp + 2, &self.resolved, offset);
        if let Some(buffer) = self.mapped.get(stamp as usize) {
            encoder.copy_buffer_to_buffer(&self.resolved, offset, buffer, 0, STAMP_BYTES);
        }
    }

    /// The time of a stamp whose buffer is mapped, or zero if the device is lost. The stamp is then
    /// free again.
    fn take(&mut self, gpu: &Gpu, stamp: u32) -> Duration {
        self.free.push(stamp);
        let Some(buffer) = self.mapped.get(stamp as usize) else { return Duration::ZERO };
        let ticks = buffer.get_mapped_range(..).ok().and_then(|view| {
            let (start, end) = view.split_at_checked(STAMP_BYTES as usize / 2)?;
            let tick = |bytes: &[u8]| bytes.try_into().map(u64::from_ne_bytes).ok();
            tick(end)?.checked_sub(tick(start)?)
        });
        // An error here can't be returned. Without the scope it would panic.
        let _ = gpu.caught(|| buffer.unmap());
        Duration::from_nanos((ticks.unwrap_or(0) as f64 * self.nanoseconds_per_tick) as u64)
    }
}
