//! The kinds of files of curves.

use std::path::Path;

use super::WriteError;
use super::format::by_extension;

/// A kind of file of curves.
///
/// ```
/// use texere_formats::write::CurveFormat;
/// assert_eq!(CurveFormat::from_path("damask.USDA")?, CurveFormat::Usda);
/// let error = CurveFormat::from_path("damask.abc").unwrap_err();
/// assert_eq!(error.to_string(), "damask.abc has no known extension; there are: bcc, usda");
/// # Ok::<(), texere_formats::WriteError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CurveFormat {
    /// Binary Curve Collection: control points alone. The format has no thickness, no colour and no
    /// tension.
    Bcc,
    /// The text form of Universal Scene Description: curves with diameters and colours.
    Usda,
    /// USD's text form with straight lines between control points, for simulators that read no
    /// other curves. The lines have a thickness and, if the yarns have a tex, a mass. No extension
    /// stands for this format alone: [`Output::linear`](super::Output::linear) asks for it.
    LinearUsda,
}

impl CurveFormat {
    /// The formats that an extension stands for.
    pub const ALL: [Self; 2] = [Self::Bcc, Self::Usda];

    /// The extension of the format's files, without its dot.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Bcc => "bcc",
            Self::Usda | Self::LinearUsda => "usda",
        }
    }

    /// The format that the extension of `path` stands for, in upper or lower case.
    ///
    /// **Errors**: [`WriteError::UnknownFormat`], which names all extensions.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, WriteError> {
        by_extension(path.as_ref(), Self::ALL, Self::extension)
    }
}
