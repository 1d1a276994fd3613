//! The kernels of a schedule.

use texere_core::BackendError;
use texere_core::backend::{Plan, Schedule};

use crate::opened::Opened;
use crate::per_ring::PerRing;
use crate::per_yarn::PerYarn;
use crate::work::Kernels;

/// The kernels of `opened`'s schedule for `plan`: for round yarns alone, or with `flattened` for
/// all yarns.
///
/// **Errors**: [`BackendError::Compile`], and [`BackendError::Driver`] or
/// [`BackendError::DeviceLost`] if another call of OpenCL fails.
pub(crate) fn kernels(
    opened: &Opened,
    plan: &Plan,
    flattened: bool,
) -> Result<Box<dyn Kernels>, BackendError> {
    Ok(match opened.schedule {
        Schedule::PerYarn => Box::new(PerYarn::new(opened, flattened)?),
        _ => Box::new(PerRing::new(opened, plan, flattened)?),
    })
}
