//! Looks whether work goes on, between its steps.

use std::ops::ControlFlow;

use crate::FabricError;

/// Asks whether the work goes on.
pub(crate) type Look<'a> = &'a mut dyn FnMut() -> Result<(), FabricError>;

/// Tells `progress` the share of the work that is done.
///
/// **Errors**: [`FabricError::Cancelled`] if it answers `Break`.
pub(super) fn tell(progress: &mut impl FnMut(f64) -> ControlFlow<()>, done: f64) -> Result<(), FabricError> {
    match progress(done) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(FabricError::Cancelled),
    }
}
