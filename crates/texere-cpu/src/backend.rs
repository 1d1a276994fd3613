//! The two backends, and how a caller opens them.

use std::sync::Arc;

use texere_core::backend::{Engine, Plan, Schedule};
use texere_core::crossings::{CrossingsPlan, CrossingsSettler};
use texere_core::relaxation::{RelaxationPlan, Relaxer};
use texere_core::settling::{Settler, SettlingPlan};
use texere_core::{Backend, BackendError, Capabilities, DeviceInfo, DeviceKind, Limits};

use crate::crossings::CrossingsMemory;
use crate::engine::CpuEngine;
use crate::parallel::{Parallel, ParallelCrossings, ParallelRelaxer, ParallelSettler};
use crate::relaxation::RelaxationMemory;
use crate::serial::{Serial, SerialCrossings, SerialRelaxer, SerialSettler};

/// The reference backend: one thread makes one yarn after the other.
#[derive(Debug)]
pub struct SerialBackend {
    info: DeviceInfo,
}

/// The parallel backend: all cores make short ranges of rings. Use it if there is no GPU.
#[derive(Debug)]
pub struct ParallelBackend {
    info: DeviceInfo,
    parallel: Parallel,
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
        can: Capabilities {
            settle: true,
            settle_crossings: true,
            relax: true,
            edit: true,
            attributes: true,
            pack: true,
            draw: false,
        },
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
    /// Opens the parallel backend, which works on rayon's global pool. The environment variable
    /// `TEXERE_SIMD` (`portable`, `avx2` or `avx512`) names the vector instructions to use. If the
    /// variable is not set, the backend uses the widest vectors that the processor has.
    ///
    /// ```
    /// use texere_core::Backend;
    /// use texere_cpu::ParallelBackend;
    /// assert_eq!(ParallelBackend::open()?.info().name, "cpu");
    /// # Ok::<(), texere_core::BackendError>(())
    /// ```
    ///
    /// **Errors**: [`BackendError::NoInstructionSet`] if `TEXERE_SIMD` is set, but names no vector
    /// instructions that this processor has.
    pub fn open() -> Result<Self, BackendError> {
        Ok(Self::with("cpu", Parallel::new()?))
    }

    /// Opens the backend once for each kind of vectors that the processor has, the widest last,
    /// whatever `TEXERE_SIMD` says. Tests use it to check that all kinds give the same bits. The
    /// name of each backend says its kind: `cpu/portable`, `cpu/avx2`, `cpu/avx512`.
    ///
    /// ```
    /// use texere_core::Backend;
    /// use texere_cpu::ParallelBackend;
    /// assert_eq!(ParallelBackend::each()[0].info().name, "cpu/portable");
    /// ```
    #[must_use]
    pub fn each() -> Vec<Self> {
        Parallel::each()
            .map(|parallel| Self::with(&format!("cpu/{}", parallel.vectors()), parallel))
            .collect()
    }

    fn with(name: &str, parallel: Parallel) -> Self {
        Self { info: info(name, Schedule::PerRing, rayon::current_num_threads()), parallel }
    }
}

impl Default for SerialBackend {
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

    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        Ok(Box::new(SerialSettler::new(plan)))
    }

    fn crossings_settler(&self, plan: Arc<CrossingsPlan>) -> Result<Box<dyn CrossingsSettler>, BackendError> {
        Ok(Box::new(SerialCrossings(CrossingsMemory::new(plan)?)))
    }

    fn relaxer(&self, plan: Arc<RelaxationPlan>) -> Result<Box<dyn Relaxer>, BackendError> {
        Ok(Box::new(SerialRelaxer(RelaxationMemory::new(plan)?)))
    }
}

impl Backend for ParallelBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        Ok(Box::new(CpuEngine::new(self.parallel, plan)?))
    }

    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        Ok(Box::new(ParallelSettler::new(self.parallel, plan)))
    }

    fn crossings_settler(&self, plan: Arc<CrossingsPlan>) -> Result<Box<dyn CrossingsSettler>, BackendError> {
        Ok(Box::new(ParallelCrossings(CrossingsMemory::new(plan)?)))
    }

    fn relaxer(&self, plan: Arc<RelaxationPlan>) -> Result<Box<dyn Relaxer>, BackendError> {
        Ok(Box::new(ParallelRelaxer(RelaxationMemory::new(plan)?)))
    }
}
