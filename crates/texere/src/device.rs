//! Devices by name.

use texere_core::{Backend, BackendError, DeviceInfo};
use texere_cpu::{ParallelBackend, SerialBackend};

type Open = fn() -> Box<dyn Backend>;

/// Every device by the name that opens it, the best one first.
const DEVICES: [(&str, Open); 2] =
    [("cpu", || Box::new(ParallelBackend::new())), ("cpu-serial", || Box::new(SerialBackend::new()))];

/// Opens the device of that name: `cpu` (all cores), `cpu-serial` (the reference, one thread), or `auto`, the best one
/// there is.
///
/// ```
/// let device = texere::open("auto")?;
/// assert_eq!(device.info().name, "cpu");
/// # Ok::<(), texere::BackendError>(())
/// ```
///
/// **Errors**: [`BackendError::NoDevice`], which lists the names that would have worked.
pub fn open(name: &str) -> Result<Box<dyn Backend>, BackendError> {
    let wanted = if name == "auto" { DEVICES[0].0 } else { name };
    let names = DEVICES.iter().map(|(known, _)| (*known).to_owned());
    DEVICES.iter().find(|(known, _)| *known == wanted).map(|(_, open)| open()).ok_or_else(|| {
        BackendError::NoDevice { wanted: name.into(), found: names.chain(["auto".into()]).collect() }
    })
}

/// All devices that can be opened, the best one first.
///
/// ```
/// assert!(texere::devices().iter().any(|device| device.name == "cpu-serial"));
/// ```
#[must_use]
pub fn devices() -> Vec<DeviceInfo> {
    DEVICES.iter().map(|(_, open)| open().info().clone()).collect()
}
