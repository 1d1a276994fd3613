//! The time that a device takes for the stages of one fabric.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::backend::Plan;
use texere::mesh::{Limits, PlanError};
use texere::{Backend, Settings, Yarns};
use texere_core::backend::{Chunk, Session, SessionError, StageTimings};
use thiserror::Error;

use crate::median;

/// The errors that keep a fabric from being measured.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// The settings are not allowed, or the yarns have too many rings.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The device failed.
    #[error(transparent)]
    Session(#[from] SessionError),
}

/// A fabric on a device, ready to be meshed repeatedly.
#[derive(Debug)]
pub struct Bench {
    /// The plan of the fabric's mesh.
    pub plan: Arc<Plan>,
    chunks: Vec<Chunk>,
    session: Session,
    yarns: Yarns,
    /// The time of allocating memory and sending tables, by the host's clock.
    pub creation: Duration,
    /// The time of sending the control points, by the host's clock.
    pub upload: Duration,
}

impl Bench {
    /// Uploads `yarns` to `device`.
    ///
    /// **Errors**: [`MeasureError`].
    pub fn new(device: &dyn Backend, yarns: Yarns, settings: Settings) -> Result<Self, MeasureError> {
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let limits = device.info().limits.min(&Limits { memory_bytes: HOST_SHARE, ..Limits::NONE });
        let chunks = plan.chunks(&limits)?.collect();
        let start = Instant::now();
        let mut session = Session::new(device, plan.clone())?;
        let creation = start.elapsed();
        let start = Instant::now();
        session.upload(0, yarns.points())?;
        // Timings wait until the work has ended.
        session.timings();
        let upload = start.elapsed();
        Ok(Self { plan, chunks, session, yarns, creation, upload })
    }

    /// Runs the scan once, and then makes the mesh. Returns the times of this run alone. Stage 1
    /// (trajectory) and stage 2 (mesh) are fused if the device fuses them.
    ///
    /// **Errors**: [`SessionError`] from the device.
    pub fn fused(&mut self) -> Result<StageTimings, SessionError> {
        self.run(|session, chunk| session.mesh(chunk))
    }

    /// Runs the scan and makes packed vertices once, and returns the times of this run alone.
    ///
    /// **Errors**: [`SessionError`] from the device.
    pub fn packed(&mut self) -> Result<StageTimings, SessionError> {
        self.run(|session, chunk| session.packed(chunk))
    }

    /// Runs the scan, and then stage 1 and stage 2 one after the other for each chunk. Returns the
    /// times of this run alone. A device that always fuses both stages makes stage 1 twice.
    ///
    /// **Errors**: [`SessionError`] from the device.
    pub fn staged(&mut self) -> Result<StageTimings, SessionError> {
        self.run(|session, chunk| {
            session.trajectory(chunk)?;
            session.mesh(chunk)
        })
    }

    fn run(
        &mut self,
        stages: impl Fn(&mut Session, &Chunk) -> Result<(), SessionError>,
    ) -> Result<StageTimings, SessionError> {
        // After an upload the session computes its results again. Only one point is uploaded, which
        // takes negligible time.
        self.session.upload(0, &self.yarns.points()[..1])?;
        let before = self.session.timings();
        self.session.scan()?;
        for chunk in &self.chunks {
            stages(&mut self.session, chunk)?;
        }
        let after = self.session.timings();
        Ok(StageTimings {
            upload: Duration::ZERO,
            scan: after.scan - before.scan,
            trajectory: after.trajectory - before.trajectory,
            mesh: after.mesh - before.mesh,
            readback: Duration::ZERO,
        })
    }

    /// Sends all control points again, and returns the time by the host's clock until they have
    /// arrived. The session's timings wait for their arrival.
    ///
    /// **Errors**: [`SessionError`] from the device.
    pub fn send(&mut self) -> Result<Duration, SessionError> {
        let start = Instant::now();
        self.session.upload(0, self.yarns.points())?;
        self.session.timings();
        Ok(start.elapsed())
    }

    /// Reads the whole mesh, piece by piece, and returns the time by the host's clock. The session
    /// lends the bytes where the driver has written them, and the benchmark does not look at them.
    ///
    /// **Errors**: [`SessionError`] from the device.
    pub fn read(&mut self) -> Result<Duration, SessionError> {
        let mut time = Duration::ZERO;
        for chunk in &self.chunks {
            self.session.mesh(chunk)?;
            self.session.timings();
            let start = Instant::now();
            let _ = self.session.read_mesh(chunk, &mut |_| ControlFlow::Continue(()))?;
            time += start.elapsed();
        }
        Ok(time)
    }

    /// Frees all memory, and returns the time by the host's clock.
    #[must_use]
    pub fn clean_up(self) -> Duration {
        let Self { session, .. } = self;
        let start = Instant::now();
        drop(session);
        start.elapsed()
    }
}

/// The bytes that all control points and two chunks may take together. Without this limit, the
/// cloths of the tables would leave no memory for the rest on a device whose memory is the host's.
const HOST_SHARE: u64 = 12 << 30;

/// The median of some times.
#[must_use]
pub fn median_time(times: &[Duration]) -> Duration {
    // The median of no times is NaN, which becomes zero here.
    Duration::try_from_secs_f64(median(times.iter().map(Duration::as_secs_f64).collect())).unwrap_or_default()
}
