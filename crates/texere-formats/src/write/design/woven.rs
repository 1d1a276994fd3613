//! The woven part of a design, for the writers of woven designs.

use texere_fabric::{Structure, WovenDesign};

use crate::Design;
use crate::write::WriteError;

/// The woven design that a writer of `format` writes.
///
/// **Errors**: [`WriteError::Unheld`] for a knit.
pub(super) fn woven<'a>(format: &'static str, design: &'a Design) -> Result<&'a WovenDesign, WriteError> {
    let what = match &design.structure {
        Structure::Woven(woven) => return Ok(woven),
        Structure::Weft(_) => "a weft knit",
        Structure::Warp(_) => "a warp knit",
        _ => "a structure of this kind",
    };
    Err(WriteError::Unheld { format, what: what.into() })
}
