//! The woven part of a design, for the writers of woven designs.

use texere_fabric::{Structure, WovenDesign};

use super::kind::kind;
use crate::Design;
use crate::write::WriteError;

/// The woven design that a writer of `format` writes.
///
/// **Errors**: [`WriteError::Unheld`] for a knit.
pub(super) fn woven<'a>(format: &'static str, design: &'a Design) -> Result<&'a WovenDesign, WriteError> {
    match &design.structure {
        Structure::Woven(woven) => Ok(woven),
        other => Err(WriteError::Unheld { format, what: kind(other).into() }),
    }
}
