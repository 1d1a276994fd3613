//! Devices by name, each opened once.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use texere::{Backend, BackendError};

/// A device that this machine has.
///
/// >>> [device.name for device in texere.devices()][-2:]
/// ['cpu', 'cpu-serial']
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Device {
    /// The name that calls take as their argument ``device``: ``cpu``, ``opencl:0``, ``wgpu:0``.
    ///
    /// >>> texere.devices()[-1].name
    /// 'cpu-serial'
    #[pyo3(get)]
    name: String,
    /// What the maker calls the device.
    ///
    /// >>> isinstance(texere.devices()[0].device, str)
    /// True
    #[pyo3(get)]
    device: String,
    /// Whether ``device="auto"`` stands for this one.
    ///
    /// >>> sum(device.is_auto for device in texere.devices())
    /// 1
    #[pyo3(get)]
    is_auto: bool,
}

#[pymethods]
impl Device {
    fn __repr__(&self) -> String {
        format!("<texere.Device {}: {}>", self.name, self.device)
    }
}

/// The devices of this machine. CPU devices come last.
///
/// >>> any(device.name == "cpu" for device in texere.devices())
/// True
#[pyfunction]
pub(crate) fn devices(py: Python<'_>) -> Vec<Device> {
    py.detach(|| {
        let devices = texere::devices();
        let auto = devices.auto().0;
        let found = devices.found.iter();
        found
            .map(|found| Device {
                name: found.name.clone(),
                device: found.device.clone(),
                is_auto: found.name == auto,
            })
            .collect()
    })
}

/// Opens the device of this name, or returns it if it is open already. Devices stay open, since
/// loading drivers and kernels takes longer than making a mesh.
pub(crate) fn open(name: &str) -> Result<Arc<dyn Backend>, BackendError> {
    static OPEN: Mutex<BTreeMap<String, Arc<dyn Backend>>> = Mutex::new(BTreeMap::new());
    let mut open = OPEN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(device) = open.get(name) {
        return Ok(device.clone());
    }
    let device: Arc<dyn Backend> = texere::open(name)?.into();
    open.insert(name.into(), device.clone());
    Ok(device)
}
