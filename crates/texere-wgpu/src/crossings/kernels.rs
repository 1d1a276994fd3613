//! The kernels that bring crossings to rest.

use texere_core::BackendError;
use texere_shaders::crossings;

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// The two compiled shaders of a pass.
#[derive(Debug)]
pub(crate) struct CrossingsKernels {
    pub(super) step: Kernel,
    pub(super) seen: Kernel,
}

impl CrossingsKernels {
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::DeviceLost`] for a lost device.
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        // Threads at crossings have half widths and half heights of their own, so the program for
        // flattened yarns is compiled.
        let kernel = |shader| Kernel::new(gpu, shader, true);
        Ok(Self { step: kernel(&crossings::MOVE)?, seen: kernel(&crossings::SEEN)? })
    }
}
