//! The scale of curves that another program wrote.

use std::path::Path;

use super::ReadError;

/// The size of curves. What is not given is as the file says. By default nothing is given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurveScale {
    /// The length of the file's unit, mm. For coordinates in metres it is 1000. If it is not given,
    /// a file of USD or TexGen says it, and it is 1 for files of any other kind.
    pub unit_mm: Option<f32>,
    /// The diameter of all yarns, mm. If it is not given, a file of USD or TexGen has to say the
    /// widths. Files of any other kind can't.
    pub diameter_mm: Option<f32>,
}

impl CurveScale {
    /// The unit and the diameter of the yarns, mm, for a file that says neither.
    ///
    /// **Errors**: [`ReadError::MissingKey`] without a diameter.
    pub(super) fn given(self, file: &Path) -> Result<[f32; 2], ReadError> {
        let missing = || ReadError::MissingKey {
            file: file.into(),
            field: "the diameter of the yarns".into(),
            needed_for: "files of this kind do not say it",
        };
        Ok([self.unit_mm.unwrap_or(1.0), self.diameter_mm.ok_or_else(missing)?])
    }
}
