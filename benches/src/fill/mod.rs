//! The floor of a device: the time to write a number of bytes and do nothing else.

mod gpu;
mod opencl;
mod wgpu;

use std::fmt::Debug;
use std::time::Duration;

use texere::BackendError;

pub use self::gpu::{Gpu, context};

/// Fills memory that lies on the device of a backend.
pub trait Fill: Debug {
    /// Writes all of its buffers once, and gives back the time that took on the device.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn run(&mut self) -> Result<Duration, BackendError>;

    /// Copies all of its buffers to memory of the host that the driver has pinned, and gives back
    /// the time that took by the host's clock: the bandwidth of the bus.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn copy_to_host(&mut self) -> Result<Duration, BackendError>;

    /// The same in the other direction, from such memory; none where a driver offers no memory that
    /// is certain to be the host's.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn copy_from_host(&mut self) -> Result<Option<Duration>, BackendError>;
}

/// Bytes of a copy over the bus: so many that its start-up time is negligible.
const COPY_BYTES: u64 = 256 << 20;
