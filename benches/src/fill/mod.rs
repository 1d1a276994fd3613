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
    /// Writes all buffers once, and returns the time on the device.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn run(&mut self) -> Result<Duration, BackendError>;

    /// Copies all buffers to pinned memory of the host, and returns the time by the host's clock.
    /// This time shows the bandwidth of the bus.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn copy_to_host(&mut self) -> Result<Duration, BackendError>;

    /// Copies from pinned memory of the host to all buffers, and returns the time by the host's
    /// clock. None if a driver offers no memory that is certain to be the host's.
    ///
    /// **Errors**: [`BackendError`] from the device.
    fn copy_from_host(&mut self) -> Result<Option<Duration>, BackendError>;
}

/// The bytes of a copy over the bus, enough to make its start-up time negligible.
const COPY_BYTES: u64 = 256 << 20;
