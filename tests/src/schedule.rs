//! The cases that a schedule leaves out. They are decided here from the case alone, so that a
//! backend can't leave out more.

use std::sync::Arc;

use libtest_mimic::Failed;
use texere_core::backend::{Plan, Schedule};
use texere_core::{Backend, BackendError, DeviceInfo, Frame, Settings, Yarns};

use crate::REGISTRY;
use crate::registry::names;

/// Whether `device` has to refuse `yarns` with `settings`. Only [`Schedule::PerYarn`] leaves
/// anything out.
#[must_use]
pub fn beyond(device: &DeviceInfo, yarns: &Yarns, settings: &Settings) -> bool {
    device.schedule == Schedule::PerYarn
        && (yarns.layout().leans()
            || settings.frame != Frame::Upright
            || settings.caps
            || yarns.layout().yarns().iter().any(|yarn| yarn.closed || yarn.twist != 0.0)
            || (0..yarns.layout().yarns().len()).any(|yarn| yarns.layout().is_steep(yarn)))
}

/// All devices of [`REGISTRY`] on this machine that have to make `yarns` with `settings`.
///
/// # Panics
///
/// If a backend in `TEXERE_REQUIRE` lacks a device. For other backends the reason is printed.
pub fn able_devices(yarns: &Yarns, settings: &Settings) -> impl Iterator<Item = Arc<dyn Backend>> {
    let required = std::env::var("TEXERE_REQUIRE").unwrap_or_default();
    let opened = REGISTRY.iter().flat_map(move |entry| {
        let (devices, missing) = entry.devices();
        for reason in missing {
            assert!(!names(&required).any(|name| name == entry.name), "{} is missing: {reason}", entry.name);
            eprintln!("{} is missing: {reason}", entry.name);
        }
        devices
    });
    opened.filter(|device| !beyond(device.info(), yarns, settings))
}

/// Passes if `device` refuses `yarns` with `settings` as [`BackendError::Unsupported`].
pub(crate) fn refuses(device: &dyn Backend, yarns: &Yarns, settings: Settings) -> Result<(), Failed> {
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    match device.engine(plan) {
        Err(BackendError::Unsupported { .. }) => Ok(()),
        other => Err(format!("not refused as unsupported: {other:?}").into()),
    }
}
