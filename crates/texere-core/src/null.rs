//! The backend that does nothing: for tests of what happens before a device is reached, and as a pattern to copy.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::{
    Backend, BackendError, Chunk, ControlPoint, DeviceInfo, DeviceKind, Limits, MeshPiece, Plan, Ring,
    Session, StageTimings, Traffic,
};

/// A backend that checks what it is asked, and writes nothing: outputs stay as they were.
///
/// ```
/// use texere_core::{Backend, NullBackend};
/// assert_eq!(NullBackend::default().info().name, "null");
/// ```
#[derive(Debug)]
pub struct NullBackend {
    info: DeviceInfo,
}

impl NullBackend {
    /// A null backend whose chunks are cut to `limits`.
    #[must_use]
    pub fn new(limits: Limits) -> Self {
        Self {
            info: DeviceInfo {
                name: "null".into(),
                device: "none".into(),
                driver: concat!("texere ", env!("CARGO_PKG_VERSION")).into(),
                schedule: "none".into(),
                kind: DeviceKind::Other,
                memory_bytes: None,
                limits,
                timed_by_device: false,
            },
        }
    }
}

impl Default for NullBackend {
    fn default() -> Self {
        Self::new(Limits::NONE)
    }
}

impl Backend for NullBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn session(&self, plan: Arc<Plan>) -> Result<Box<dyn Session>, BackendError> {
        Ok(Box::new(NullSession { plan, scanned: false, in_flight: None }))
    }
}

#[derive(Debug)]
struct NullSession {
    plan: Arc<Plan>,
    scanned: bool,
    in_flight: Option<u64>,
}

impl NullSession {
    fn launch(&mut self, call: &'static str, chunk: &Chunk) -> Result<(), BackendError> {
        if self.plan.needs_scan() && !self.scanned {
            return Err(BackendError::OutOfOrder { call, needed: "scan" });
        }
        self.in_flight = Some(chunk.index);
        Ok(())
    }

    fn wait(&self, chunk: &Chunk) -> Result<ControlFlow<()>, BackendError> {
        if self.in_flight == Some(chunk.index) {
            Ok(ControlFlow::Continue(()))
        } else {
            Err(BackendError::NotInFlight { chunk: chunk.index })
        }
    }
}

impl Session for NullSession {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), BackendError> {
        let (end, total) = (first.saturating_add(points.len() as u64), self.plan.layout().point_count());
        self.scanned = false;
        if end > total { Err(BackendError::UploadRange { first, end, points: total }) } else { Ok(()) }
    }

    fn scan(&mut self) -> Result<(), BackendError> {
        self.scanned = true;
        Ok(())
    }

    fn trajectory(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.launch("trajectory", chunk)
    }

    fn mesh(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.launch("mesh", chunk)
    }

    fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        _sink: &mut dyn FnMut(&[Ring]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        self.wait(chunk)
    }

    fn read_mesh(
        &mut self,
        chunk: &Chunk,
        _sink: &mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        self.wait(chunk)
    }

    fn timings(&self) -> StageTimings {
        StageTimings::default()
    }

    fn traffic(&self) -> Traffic {
        Traffic::default()
    }
}
