//! The question whether long work should go on, asked between its steps.

use std::ops::ControlFlow;

use crate::FabricError;

/// A function that long work calls between its steps. An error that it returns ends the work.
pub(crate) type Look<'a> = &'a mut dyn FnMut() -> Result<(), FabricError>;

/// Tells `progress` the share of the work that is done.
///
/// **Errors**: [`FabricError::Cancelled`] if `progress` returns `Break`.
pub(crate) fn tell(progress: &mut impl FnMut(f64) -> ControlFlow<()>, done: f64) -> Result<(), FabricError> {
    match progress(done) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(FabricError::Cancelled),
    }
}
