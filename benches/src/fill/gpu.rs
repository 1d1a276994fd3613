//! A GPU that is named, and the fill on it.

use std::time::{Duration, Instant};

use texere::backend::Schedule;
use texere::{Backend, BackendError};
use texere_opencl::OpenClBackend;
use texere_wgpu::WgpuBackend;

use super::opencl::OpenClFill;
use super::wgpu::WgpuFill;
use super::{Fill, opencl, wgpu};

/// An open GPU to measure.
#[derive(Debug)]
pub enum Gpu {
    /// An OpenCL device, with its number among those of OpenCL.
    OpenCl(OpenClBackend, usize),
    /// A wgpu device.
    Wgpu(WgpuBackend),
}

impl Gpu {
    /// Opens a GPU device by a name such as `opencl:1` or `wgpu:0`.
    ///
    /// **Errors**: [`BackendError`] if there is no such device.
    pub fn open(name: &str) -> Result<Self, BackendError> {
        match numbered(name) {
            Some(("opencl", index)) => {
                Ok(Self::OpenCl(OpenClBackend::open(index, Schedule::PerRing)?, index))
            }
            Some(("wgpu", index)) => Ok(Self::Wgpu(WgpuBackend::open(index, Schedule::PerRing)?)),
            _ => Err(BackendError::NoDevice { wanted: name.into(), found: Vec::new() }),
        }
    }

    /// The device's backend.
    #[must_use]
    pub fn backend(&self) -> &dyn Backend {
        match self {
            Self::OpenCl(backend, _) => backend,
            Self::Wgpu(backend) => backend,
        }
    }

    /// A fill of buffers of `bytes` each on the same device.
    ///
    /// **Errors**: [`BackendError`] if OpenCL has no room for the buffers, or its driver fails.
    pub fn fill(&self, bytes: &[u64]) -> Result<Box<dyn Fill>, BackendError> {
        Ok(match self {
            Self::OpenCl(_, index) => Box::new(OpenClFill::new(*index, bytes)?),
            Self::Wgpu(backend) => Box::new(WgpuFill::new(backend.device(), backend.queue(), bytes)),
        })
    }
}

/// Makes an empty context of a GPU, and returns the time by the host's clock. The first context of
/// a process also loads the driver. None for a device of neither OpenCL nor wgpu.
///
/// **Errors**: [`BackendError`] if there is no such device.
pub fn context(name: &str) -> Result<Option<Duration>, BackendError> {
    let start = Instant::now();
    match numbered(name) {
        Some(("opencl", index)) => drop(opencl::context(index)?),
        Some(("wgpu", index)) => drop(wgpu::context(index)?),
        _ => return Ok(None),
    }
    Ok(Some(start.elapsed()))
}

/// The interface and the number in a device's name, whatever the name's schedule.
fn numbered(name: &str) -> Option<(&str, usize)> {
    let (family, rest) = name.split_once(':')?;
    let (index, _) = rest.split_once('/').unwrap_or((rest, ""));
    Some((family, index.parse().ok()?))
}
