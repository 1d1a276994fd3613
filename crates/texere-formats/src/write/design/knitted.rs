//! The weft knit of a design, and the program that knits it.

use texere_fabric::Structure;
use texere_fabric::weft::{Knitted, Machine};

use super::kind::kind;
use crate::Design;
use crate::read::KnittedFrom;
use crate::write::WriteError;

/// The weft knit that a writer of `format` writes, and its program. The machine runs the program
/// once more, because the structure of a design may have been replaced since the design was read.
///
/// **Errors**: [`WriteError::Unheld`] for other structures, for a knit without a program, and for a
/// knit that is not the one that its program knits.
pub(super) fn knitted<'a>(
    format: &'static str,
    design: &'a Design,
) -> Result<(&'a Knitted, &'a KnittedFrom), WriteError> {
    let unheld = |what: &str| WriteError::Unheld { format, what: what.into() };
    let knit = match &design.structure {
        Structure::Weft(knit) => knit,
        other => return Err(unheld(kind(other))),
    };
    let from = design.knitted_from().ok_or_else(|| unheld("a weft knit whose program is not known"))?;
    let again = Machine::default().knit(&from.program);
    if again.is_ok_and(|again| again.stitches == *knit.stitches()) {
        Ok((knit, from))
    } else {
        Err(unheld("a weft knit with other stitches than its own program makes"))
    }
}
