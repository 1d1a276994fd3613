//! The backends that the suite runs on.

use std::sync::{Arc, OnceLock};

use texere_core::backend::Schedule;
use texere_core::{Backend, BackendError, DeviceInfo};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_opencl::OpenClBackend;
use texere_wgpu::WgpuBackend;

use crate::DeferredBackend;
use crate::cases::{self, Case};

/// All devices on which yarns of a mesh can be edited, and the reason for each device that does not
/// open.
#[must_use]
pub fn editing_devices() -> (Vec<Arc<dyn Backend>>, Vec<String>) {
    let (devices, missing): (Vec<_>, Vec<_>) = REGISTRY.iter().map(Entry::devices).unzip();
    let devices = devices.into_iter().flatten().filter(|device| device.info().can.edit);
    (devices.collect(), missing.concat())
}

/// A backend, and how its devices are opened.
///
/// ```
/// use std::sync::Arc;
/// use texere_conformance::Entry;
/// use texere_cpu::ParallelBackend;
/// let entry = Entry::exact("cpu", || vec![ParallelBackend::open().map(|cpu| Arc::new(cpu) as _)]);
/// let (devices, missing) = entry.devices();
/// assert_eq!((devices.len(), missing.len()), (1, 0));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The backend's name in `TEXERE_REQUIRE`.
    pub name: &'static str,
    /// Whether the backend's output has to equal the gold reference to the bit.
    pub exact: bool,
    /// Opens all devices of the backend, once for every schedule. A device that does not open
    /// counts as missing, and a backend without devices does, too.
    pub open: OpenAll,
    /// The cases that the backend's devices run.
    pub cases: fn() -> Vec<Case>,
}

/// Opens all devices of a backend, and gives an error for each that does not open.
pub type OpenAll = fn() -> Vec<Result<Arc<dyn Backend>, BackendError>>;

impl Entry {
    /// A backend whose output equals the gold reference to the bit.
    #[must_use]
    pub const fn exact(name: &'static str, open: OpenAll) -> Self {
        Self { exact: true, ..Self::near(name, open) }
    }

    /// A backend whose output equals the gold reference within the bounds of
    /// [`compare`](crate::compare).
    #[must_use]
    pub const fn near(name: &'static str, open: OpenAll) -> Self {
        Self { name, exact: false, open, cases: cases::all }
    }

    /// Replaces the cases, which are [`cases::all`] otherwise.
    #[must_use]
    pub const fn with_cases(self, cases: fn() -> Vec<Case>) -> Self {
        Self { cases, ..self }
    }

    /// The devices that open, and the reason for each device that does not. A backend without
    /// devices has a reason, too.
    #[must_use]
    pub fn devices(&self) -> (Vec<Arc<dyn Backend>>, Vec<String>) {
        let (mut devices, mut missing) = (Vec::new(), Vec::new());
        let opened = (self.open)();
        let count = opened.len();
        for (number, device) in (1..).zip(opened) {
            match device {
                Ok(device) => devices.push(device),
                Err(error) => missing.push(format!("device {number} of {count}: {}", chain(&error))),
            }
        }
        if count == 0 {
            missing.push("it has no device".into());
        }
        (devices, missing)
    }
}

/// The backends of this workspace.
pub const REGISTRY: &[Entry] = &[
    Entry::exact("cpu", || {
        let each = ParallelBackend::each().into_iter().map(|parallel| Ok(Arc::new(parallel) as _));
        std::iter::once(Ok(Arc::new(SerialBackend::new()) as _)).chain(each).collect()
    }),
    Entry::exact("deferred", || vec![Ok(Arc::new(DeferredBackend::new()))]),
    Entry::near("opencl", || open_each(OpenClBackend::devices(), OpenClBackend::open)),
    Entry::near("wgpu", || open_each(WgpuBackend::devices(), WgpuBackend::open)),
];

/// All devices of [`REGISTRY`] that need not equal the bits of `cpu-serial`. They are opened on the
/// first call. Each is there once, in its schedule per ring, because the schedules differ only in
/// how meshes are made.
///
/// **Panics** if a backend in `TEXERE_REQUIRE` has no device, or one that does not open.
#[must_use]
pub fn near_devices() -> &'static [Arc<dyn Backend>] {
    static DEVICES: OnceLock<Vec<Arc<dyn Backend>>> = OnceLock::new();
    DEVICES.get_or_init(|| {
        let required = std::env::var("TEXERE_REQUIRE").unwrap_or_default();
        let near = REGISTRY.iter().filter(|entry| !entry.exact);
        let devices = near.flat_map(|entry| {
            let (devices, missing) = entry.devices();
            assert!(
                missing.is_empty() || names(&required).all(|name| name != entry.name),
                "{}: {missing:?}",
                entry.name
            );
            devices
        });
        devices.filter(|device| device.info().schedule == Schedule::PerRing).collect()
    })
}

/// Opens each device of `listed` with both schedules.
fn open_each<B: Backend + 'static>(
    listed: Result<Vec<DeviceInfo>, BackendError>,
    open: fn(usize, Schedule) -> Result<B, BackendError>,
) -> Vec<Result<Arc<dyn Backend>, BackendError>> {
    let count = match listed {
        Ok(devices) => devices.len(),
        Err(error) => return vec![Err(error)],
    };
    (0..count)
        .flat_map(|index| [Schedule::PerRing, Schedule::PerYarn].map(|schedule| (index, schedule)))
        .map(|(index, schedule)| Ok(Arc::new(open(index, schedule)?) as Arc<dyn Backend>))
        .collect()
}

/// An error with all its causes, on one line.
pub(crate) fn chain(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

/// The names in a comma-separated list.
pub(crate) fn names(list: &str) -> impl Iterator<Item = &str> {
    list.split(',').map(str::trim).filter(|name| !name.is_empty())
}
