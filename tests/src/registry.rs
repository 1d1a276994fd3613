//! The backends that the suite runs on: one line each.

use std::sync::Arc;

use texere_core::{Backend, BackendError, Schedule};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_opencl::OpenClBackend;
use texere_wgpu::WgpuBackend;

use crate::DeferredBackend;

/// How a backend's devices are opened.
///
/// ```
/// use std::sync::Arc;
/// use texere_conformance::Entry;
/// use texere_cpu::ParallelBackend;
/// let entry = Entry::exact("cpu", || Ok(vec![Arc::new(ParallelBackend::new())]));
/// assert_eq!((entry.open)()?.len(), 1);
/// # Ok::<(), texere_core::BackendError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// What `TEXERE_REQUIRE` calls it.
    pub name: &'static str,
    /// Whether its output must equal the gold reference to the bit.
    pub exact: bool,
    /// Opens all devices that it has. An error, or no device, and the backend counts as missing.
    pub open: OpenAll,
}

/// Opens all devices of a backend.
pub type OpenAll = fn() -> Result<Vec<Arc<dyn Backend>>, BackendError>;

impl Entry {
    /// A backend whose output equals the gold reference to the bit.
    #[must_use]
    pub const fn exact(name: &'static str, open: OpenAll) -> Self {
        Self { name, exact: true, open }
    }

    /// A backend whose output equals it within the bounds of [`compare`](crate::compare).
    #[must_use]
    pub const fn near(name: &'static str, open: OpenAll) -> Self {
        Self { name, exact: false, open }
    }
}

/// The backends of this workspace.
pub const REGISTRY: &[Entry] = &[
    Entry::exact("cpu", || Ok(vec![Arc::new(SerialBackend::new()), Arc::new(ParallelBackend::new())])),
    Entry::exact("deferred", || Ok(vec![Arc::new(DeferredBackend::new())])),
    Entry::near("opencl", || open_each(OpenClBackend::devices()?.len(), OpenClBackend::open)),
    Entry::near("wgpu", || open_each(WgpuBackend::devices()?.len(), WgpuBackend::open)),
];

/// Opens devices 0 to `count`.
fn open_each<B: Backend + 'static>(
    count: usize,
    open: fn(usize, Schedule) -> Result<B, BackendError>,
) -> Result<Vec<Arc<dyn Backend>>, BackendError> {
    (0..count).map(|index| Ok(Arc::new(open(index, Schedule::PerRing)?) as Arc<dyn Backend>)).collect()
}
