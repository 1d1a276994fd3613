//! The backends that the suite runs on: one line each.

use std::sync::Arc;

use texere_core::{Backend, BackendError, Schedule};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_opencl::OpenClBackend;
use texere_wgpu::WgpuBackend;

use crate::DeferredBackend;
use crate::cases::{self, Case};

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
    /// Opens all devices that it has, a schedule a device. An error, or no device, and the backend counts as missing.
    pub open: OpenAll,
    /// The cases that its devices get.
    pub cases: fn() -> Vec<Case>,
}

/// Opens all devices of a backend.
pub type OpenAll = fn() -> Result<Vec<Arc<dyn Backend>>, BackendError>;

impl Entry {
    /// A backend whose output equals the gold reference to the bit.
    #[must_use]
    pub const fn exact(name: &'static str, open: OpenAll) -> Self {
        Self { exact: true, ..Self::near(name, open) }
    }

    /// A backend whose output equals it within the bounds of [`compare`](crate::compare).
    #[must_use]
    pub const fn near(name: &'static str, open: OpenAll) -> Self {
        Self { name, exact: false, open, cases: cases::all }
    }

    /// The same backend with other cases than [`cases::all`].
    #[must_use]
    pub const fn with_cases(self, cases: fn() -> Vec<Case>) -> Self {
        Self { cases, ..self }
    }
}

/// The backends of this workspace.
pub const REGISTRY: &[Entry] = &[
    Entry::exact("cpu", || Ok(vec![Arc::new(SerialBackend::new()), Arc::new(ParallelBackend::new())])),
    Entry::exact("deferred", || Ok(vec![Arc::new(DeferredBackend::new())])),
    Entry::near("opencl", || open_each(OpenClBackend::devices()?.len(), OpenClBackend::open)),
    Entry::near("wgpu", || open_each(WgpuBackend::devices()?.len(), WgpuBackend::open)),
];

/// Opens devices 0 to `count`, each with either schedule.
fn open_each<B: Backend + 'static>(
    count: usize,
    open: fn(usize, Schedule) -> Result<B, BackendError>,
) -> Result<Vec<Arc<dyn Backend>>, BackendError> {
    (0..count)
        .flat_map(|index| [Schedule::PerRing, Schedule::PerYarn].map(|schedule| (index, schedule)))
        .map(|(index, schedule)| Ok(Arc::new(open(index, schedule)?) as Arc<dyn Backend>))
        .collect()
}
