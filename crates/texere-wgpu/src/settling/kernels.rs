//! The compiled shaders that bring yarns to rest.

use texere_core::BackendError;
use texere_core::settling::Form;
use texere_shaders::settling;

use crate::gpu::Gpu;
use crate::kernel::Kernel;

/// The shaders of a settling, for round yarns alone or for all yarns.
#[derive(Debug)]
pub(crate) struct SettlingKernels {
    pub(super) chords: Kernel,
    pub(super) extent: Kernel,
    pub(super) cell_count: Kernel,
    pub(super) cell_fill: Kernel,
    pub(super) scan: Kernel,
    pub(super) scan_add: Kernel,
    pub(super) count: Kernel,
    pub(super) fill: Kernel,
    weighted: [Kernel; 2],
    block: [Kernel; 2],
    pub(super) ends: Kernel,
    pub(super) seen: Kernel,
    pub(super) points: Kernel,
    pub(super) bounds: Kernel,
}

impl SettlingKernels {
    /// **Errors**: [`BackendError::Compile`], and [`BackendError::DeviceLost`] for a lost device.
    pub(crate) fn new(gpu: &Gpu, flattened: bool) -> Result<Self, BackendError> {
        let kernel = |shader| Kernel::new(gpu, shader, flattened);
        Ok(Self {
            chords: kernel(&settling::CHORDS)?,
            extent: kernel(&settling::EXTENT)?,
            cell_count: kernel(&settling::CELL_COUNT)?,
            cell_fill: kernel(&settling::CELL_FILL)?,
            scan: kernel(&settling::SCAN)?,
            scan_add: kernel(&settling::SCAN_ADD)?,
            count: kernel(&settling::COUNT)?,
            fill: kernel(&settling::FILL)?,
            weighted: [kernel(&settling::PULL_WEIGHTED)?, kernel(&settling::STEP_WEIGHTED)?],
            block: [kernel(&settling::PULL_BLOCK)?, kernel(&settling::STEP_BLOCK)?],
            ends: kernel(&settling::ENDS)?,
            seen: kernel(&settling::SEEN)?,
            points: kernel(&settling::POINTS)?,
            bounds: kernel(&settling::BOUNDS)?,
        })
    }

    /// The two shaders of a form: first the pulls of intervals, then the steps of control points.
    pub(super) fn form(&self, form: Form) -> &[Kernel; 2] {
        match form {
            Form::Weighted => &self.weighted,
            Form::Block => &self.block,
        }
    }
}
