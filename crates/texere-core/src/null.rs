//! A backend that does nothing, for tests that need no device.

use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use crate::backend::{
    AttributeSink, Chunk, Engine, MeshSink, PackedSink, Plan, RingSink, ScanChunks, Schedule, Slot,
    StageTimings,
};
use crate::{Backend, BackendError, Capabilities, ControlPoint, DeviceInfo, DeviceKind, Limits};

/// A backend that writes nothing, so that outputs keep their contents.
///
/// It takes every call that a session or a live mesh makes, so that tests of the two need no
/// device. A small backend that makes meshes is explained in docs/BACKENDS.md.
///
/// ```
/// use texere_core::backend::NullBackend;
/// use texere_core::Backend;
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
                schedule: Schedule::Serial,
                kind: DeviceKind::Other,
                memory_bytes: None,
                limits,
                can: Capabilities { edit: true, attributes: true, pack: true, ..Capabilities::default() },
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

    fn engine(&self, _plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        Ok(Box::new(NullEngine))
    }
}

#[derive(Debug)]
struct NullEngine;

impl Engine for NullEngine {
    fn upload(&mut self, _first: u64, _points: &[ControlPoint]) -> Result<u64, BackendError> {
        Ok(0)
    }

    fn is_editable(&self) -> bool {
        true
    }

    fn replan(&mut self, _plan: Arc<Plan>, _yarns: Range<usize>) -> Result<(), BackendError> {
        Ok(())
    }

    fn scan(&mut self, _chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        Ok(())
    }

    fn load(&mut self, _slot: Slot, _chunk: &Chunk) -> Result<(), BackendError> {
        Ok(())
    }

    fn trajectory(&mut self, _slot: Slot, _chunk: &Chunk) -> Result<(), BackendError> {
        Ok(())
    }

    fn mesh(&mut self, _slot: Slot, _chunk: &Chunk) -> Result<(), BackendError> {
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        _slot: Slot,
        _chunk: &Chunk,
        _sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(ControlFlow::Continue(()))
    }

    fn read_mesh(
        &mut self,
        _slot: Slot,
        _chunk: &Chunk,
        _sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(ControlFlow::Continue(()))
    }

    fn measure(&mut self, _chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        Ok(())
    }

    fn attributes(&mut self, _slot: Slot, _chunk: &Chunk) -> Result<(), BackendError> {
        Ok(())
    }

    fn read_attributes(
        &mut self,
        _slot: Slot,
        _chunk: &Chunk,
        _sink: AttributeSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(ControlFlow::Continue(()))
    }

    fn packed(&mut self, _slot: Slot, _chunk: &Chunk) -> Result<(), BackendError> {
        Ok(())
    }

    fn read_packed(
        &mut self,
        _slot: Slot,
        _chunk: &Chunk,
        _sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        Ok(ControlFlow::Continue(()))
    }

    fn lends_its_own(&self) -> bool {
        true
    }

    fn timings(&mut self) -> StageTimings {
        StageTimings::default()
    }
}
