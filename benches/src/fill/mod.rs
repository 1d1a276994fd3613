//! The floor of a device: how long it takes to write so many bytes and do nothing else.

mod opencl;
mod wgpu;

use std::fmt::Debug;
use std::time::Duration;

use texere::{Backend, BackendError};

pub use self::opencl::OpenClFill;
pub use self::wgpu::WgpuFill;

/// Fills memory that lies on the device of a backend.
pub trait Fill: Debug {
    /// Writes all of its buffers once, and gives back the time that took on the device.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn run(&mut self) -> Result<Duration, BackendError>;

    /// Copies all of its buffers to memory of the host that the driver has pinned, and gives back the time that took by
    /// the host's clock: the bandwidth of the bus.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn copy_to_host(&mut self) -> Result<Duration, BackendError>;

    /// Likewise from such memory; none where a driver gives no such memory that is sure to be the host's.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn copy_from_host(&mut self) -> Result<Option<Duration>, BackendError>;
}

/// Bytes of a copy over the bus: so many that its start does not count.
const COPY_BYTES: u64 = 256 << 20;

/// A device with what is needed to measure it: the backend, and its floor for buffers of `bytes`.
#[derive(Debug)]
pub struct Rig {
    /// The device, as texere uses it.
    pub backend: Box<dyn Backend>,
    /// A fill of buffers as large as asked for.
    pub fill: Box<dyn Fill>,
}

/// Opens a GPU device by a name such as `opencl:1` or `wgpu:0`, and buffers of `bytes` each beside it.
///
/// **Errors**: [`BackendError`] where there is no such device, or no room on it.
pub fn rig(name: &str, bytes: &[u64]) -> Result<Rig, BackendError> {
    let none = || BackendError::NoDevice { wanted: name.into(), found: Vec::new() };
    let (family, index) = name.split_once(':').ok_or_else(none)?;
    let index = index.parse().map_err(|_| none())?;
    match family {
        "opencl" => {
            let (backend, fill) = opencl::rig(index, bytes)?;
            Ok(Rig { backend: Box::new(backend), fill: Box::new(fill) })
        }
        "wgpu" => {
            let (backend, fill) = wgpu::rig(index, bytes)?;
            Ok(Rig { backend: Box::new(backend), fill: Box::new(fill) })
        }
        _ => Err(none()),
    }
}
