//! The kernels of a schedule.

use texere_core::BackendError;
use texere_core::backend::Schedule;
use texere_gpu::serial_unsupported;

use crate::gpu::Gpu;
use crate::per_ring::PerRing;
use crate::per_yarn::PerYarn;

/// The shaders of a schedule.
#[derive(Debug)]
pub(crate) enum Kernels {
    /// The schedule in which a lane makes a ring.
    PerRing(Box<PerRing>),
    /// The paper's schedule, in which a lane makes a yarn, or a part of a yarn.
    PerYarn(Box<PerYarn>),
}

impl Kernels {
    /// Compiles the shaders of `schedule` for round yarns alone, or, with `flattened`, for all
    /// yarns.
    ///
    /// **Errors**: [`BackendError::Compile`]; [`BackendError::DeviceLost`];
    /// [`BackendError::Unsupported`] for [`Schedule::Serial`].
    pub(crate) fn new(gpu: &Gpu, schedule: Schedule, flattened: bool) -> Result<Self, BackendError> {
        Ok(match schedule {
            Schedule::PerRing => Self::PerRing(Box::new(PerRing::new(gpu, flattened)?)),
            Schedule::PerYarn => Self::PerYarn(Box::new(PerYarn::new(gpu, flattened)?)),
            Schedule::Serial => return Err(serial_unsupported(&gpu.name)),
        })
    }
}
