//! The shaders that make attributes of vertices.

use texere_core::BackendError;
use texere_shaders::{ATTRIBUTES_OF_CAPS, ATTRIBUTES_OF_TUBES, BLOCK_LENGTHS, YARN_LENGTHS};

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// The compiled shaders that make attributes.
#[derive(Debug)]
pub(crate) struct AttributeKernels {
    pub(crate) block_lengths: Kernel,
    pub(crate) yarn_lengths: Kernel,
    pub(crate) of_tubes: Kernel,
    pub(crate) of_caps: Kernel,
}

impl AttributeKernels {
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::DeviceLost`] for a lost device.
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        // Attributes do not depend on half widths and half heights.
        let kernel = |shader| Kernel::new(gpu, shader, false);
        Ok(Self {
            block_lengths: kernel(&BLOCK_LENGTHS)?,
            yarn_lengths: kernel(&YARN_LENGTHS)?,
            of_tubes: kernel(&ATTRIBUTES_OF_TUBES)?,
            of_caps: kernel(&ATTRIBUTES_OF_CAPS)?,
        })
    }
}
