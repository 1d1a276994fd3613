//! Writes the centrelines of yarns as curves, for simulators and renderers that make tubes of
//! curves themselves.

mod bcc;
mod usd;

use std::io::Write;

use texere_core::Yarns;

use super::curve_format::CurveFormat;
use super::target::Target;
use super::{Output, WriteError};

/// Writes the centrelines of yarns as curves, in the format that the extension of `output` stands
/// for. Coordinates are in mm. Returns the file's length in bytes.
///
/// BCC and USD both hold the control points of the spline to the bit. `docs/FORMATS.md` says what
/// else each format holds. Sections, up directions, twist and sources are left out.
///
/// **Errors**: [`WriteError::UnknownFormat`]; [`WriteError::NotEnding`] for linear curves in a file
/// that does not end in `.usda`; [`WriteError::Unheld`] for a BCC file of yarns whose tension is
/// not 0, or of a yarn of more than 2³¹ - 1 control points; [`WriteError::Spared`],
/// [`WriteError::Io`].
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_formats::write;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("yarn.bcc");
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// // A header of 64 bytes, a count of 4, and 12 bytes a control point.
/// assert_eq!(write::curves(&yarns.build()?, &path)?, 64 + 4 + 3 * 12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn curves(yarns: &Yarns, output: impl Into<Output>) -> Result<u64, WriteError> {
    let output = output.into();
    let format = output.curve_format()?;
    check(yarns, format)?;
    write(yarns, format, Target::create(output)?)?.commit()
}

/// Writes the centrelines of yarns to `out`: the bytes that [`curves`] writes to a file.
///
/// **Errors**: the errors of [`curves`], and [`WriteError::Writer`] if `out` refuses bytes.
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_formats::write::{self, CurveFormat};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let mut stage = Vec::new();
/// write::curves_to(&yarns.build()?, CurveFormat::Usda, &mut stage)?;
/// assert!(stage.starts_with(b"#usda 1.0\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn curves_to(yarns: &Yarns, format: CurveFormat, out: impl Write) -> Result<u64, WriteError> {
    check(yarns, format)?;
    write(yarns, format, Target::straight(out))?.done()
}

/// Checks that the format can hold the yarns, before a byte is written.
fn check(yarns: &Yarns, format: CurveFormat) -> Result<(), WriteError> {
    match format {
        CurveFormat::Bcc => bcc::check(yarns),
        CurveFormat::Usda | CurveFormat::LinearUsda => Ok(()),
    }
}

fn write<W: Write>(yarns: &Yarns, format: CurveFormat, target: Target<W>) -> Result<Target<W>, WriteError> {
    match format {
        CurveFormat::Bcc => bcc::write(yarns, target),
        CurveFormat::Usda => usd::write(yarns, usd::Basis::of(yarns.tension()), target),
        CurveFormat::LinearUsda => usd::write(yarns, usd::Basis::Linear, target),
    }
}
