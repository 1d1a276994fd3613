//! The shaders that pack vertices.

use texere_core::BackendError;
use texere_shaders::{PACKED, PACKED_CAPS, PACKED_ODD};

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// The compiled shaders that pack vertices.
#[derive(Debug)]
pub(crate) struct PackedKernels {
    /// The shader of tubes with an even number of sides.
    pub(crate) tubes: Kernel,
    pub(crate) tubes_odd: Kernel,
    pub(crate) caps: Kernel,
}

impl PackedKernels {
    /// Compiles the shaders for round yarns alone, or with `flattened` for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::DeviceLost`] for a lost device.
    pub(crate) fn new(gpu: &Gpu, flattened: bool) -> Result<Self, BackendError> {
        let kernel = |shader| Kernel::new(gpu, shader, flattened);
        Ok(Self { tubes: kernel(&PACKED)?, tubes_odd: kernel(&PACKED_ODD)?, caps: kernel(&PACKED_CAPS)? })
    }
}
