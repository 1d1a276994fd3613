//! What a schedule leaves out: decided here from what is asked, so that no backend can excuse itself.

use std::sync::Arc;

use libtest_mimic::Failed;
use texere_core::{Backend, BackendError, DeviceInfo, Frame, Plan, Schedule, Settings, Yarns};

use crate::REGISTRY;

/// Why `device` must refuse `yarns` under `settings`: words, one of which its error must have. None where it must do
/// the work. Only [`Schedule::PerYarn`] leaves anything out.
#[must_use]
pub fn beyond(device: &DeviceInfo, yarns: &Yarns, settings: &Settings) -> Vec<&'static str> {
    if device.schedule != Schedule::PerYarn.to_string() {
        return Vec::new();
    }
    let rows = yarns.layout().yarns();
    let reasons = [
        ("frame", settings.frame != Frame::Upright),
        ("caps", settings.caps),
        ("closed", rows.iter().any(|yarn| yarn.closed)),
        ("twist", rows.iter().any(|yarn| yarn.twist != 0.0)),
    ];
    reasons.into_iter().filter(|(_, beyond)| *beyond).map(|(word, _)| word).collect()
}

/// All devices of [`REGISTRY`] that there are here and that must do `yarns` under `settings`.
pub fn able_devices(yarns: &Yarns, settings: &Settings) -> impl Iterator<Item = Arc<dyn Backend>> {
    REGISTRY
        .iter()
        .flat_map(|entry| (entry.open)().unwrap_or_default())
        .filter(|device| beyond(device.info(), yarns, settings).is_empty())
}

/// Passes where `device` refuses `yarns` under `settings` for one of `reasons`, in its own name.
pub(crate) fn refuses(
    device: &dyn Backend,
    yarns: &Yarns,
    settings: Settings,
    reasons: &[&str],
) -> Result<(), Failed> {
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    match device.session(plan) {
        Err(BackendError::Unsupported { schedule, what })
            if schedule == device.info().name && reasons.iter().any(|word| what.contains(word)) =>
        {
            Ok(())
        }
        other => Err(format!("not refused as unsupported, for one of {reasons:?}: {other:?}").into()),
    }
}
