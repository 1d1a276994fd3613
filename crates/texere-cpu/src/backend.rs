//! The two backends as a caller opens them.

use std::sync::Arc;

use texere_core::{Backend, BackendError, DeviceInfo, DeviceKind, Engine, Limits, Plan, Schedule};

use crate::engine::CpuEngine;
use crate::parallel::{Parallel, Path};
use crate::serial::Serial;

/// One thread, one yarn after the other: the reference.
#[derive(Debug)]
pub struct SerialBackend {
    info: DeviceInfo,
}

/// All cores, equal ranges of rings: the backend to use where there is no GPU.
#[derive(Debug)]
pub struct ParallelBackend {
    info: DeviceInfo,
    path: Path,
}

fn info(name: &str, schedule: Schedule, threads: usize) -> DeviceInfo {
    DeviceInfo {
        name: name.into(),
        device: format!(
            "{} processor, {threads} thread{}",
            std::env::consts::ARCH,
            if threads == 1 { "" } else { "s" }
        ),
        driver: concat!("texere ", env!("CARGO_PKG_VERSION")).into(),
        schedule,
        kind: DeviceKind::Cpu,
        memory_bytes: None,
        limits: Limits::NONE,
        timed_by_device: false,
    }
}

impl SerialBackend {
    /// Opens the serial backend.
    #[must_use]
    pub fn new() -> Self {
        Self { info: info("cpu-serial", Schedule::Serial, 1) }
    }
}

impl ParallelBackend {
    /// Opens the parallel backend, which works on rayon's global pool, with the widest vectors that the processor has, or
    /// those that the environment variable `TEXERE_SIMD` names.
    #[must_use]
    pub fn new() -> Self {
        Self::with("cpu", Path::detect())
    }

    /// Opens it once for each kind of vectors that the processor has, the widest ones last, for tests that none differs
    /// from the others. Each one's name says which: `cpu/portable`, `cpu/avx2`, `cpu/avx512`.
    ///
    /// ```
    /// use texere_core::Backend;
    /// use texere_cpu::ParallelBackend;
    /// assert_eq!(ParallelBackend::each()[0].info().name, "cpu/portable");
    /// ```
    #[must_use]
    pub fn each() -> Vec<Self> {
        let named = |path: Path| Self::with(&format!("cpu/{}", path.name()), path);
        Path::available().into_iter().map(named).collect()
    }

    fn with(name: &str, path: Path) -> Self {
        Self { info: info(name, Schedule::PerRing, rayon::current_num_threads()), path }
    }
}

impl Default for SerialBackend {
    fn default() -> Self {
        Self::new()
    }
}

impl Default for ParallelBackend {
    fn default() -> Self {
        Self::new()
    }
}

impl Backend for SerialBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        Ok(Box::new(CpuEngine::new(Serial, plan)?))
    }
}

impl Backend for ParallelBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        Ok(Box::new(CpuEngine::new(Parallel(self.path), plan)?))
    }
}
