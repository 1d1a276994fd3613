//! What files of curves do not say about their yarns.

use texere::read::CurveScale;

use super::numbers::millimetres;

/// The scale of curves that another program wrote.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct CurveArgs {
    /// The diameter of all yarns of a file of curves, mm; files of USD and TexGen say widths
    /// themselves
    #[arg(long, value_name = "MM", value_parser = millimetres, allow_negative_numbers = true)]
    diameter: Option<f32>,
    /// The length of the unit of a file of curves, mm: 1000 for metres; if left out, what a file of
    /// USD or TexGen says, and 1 for other files
    #[arg(long, value_name = "MM", value_parser = millimetres, allow_negative_numbers = true)]
    unit: Option<f32>,
}

impl CurveArgs {
    pub(crate) const fn scale(self) -> CurveScale {
        CurveScale { unit_mm: self.unit, diameter_mm: self.diameter }
    }

    /// The first option given, if there is one.
    pub(crate) fn given(self) -> Option<&'static str> {
        self.diameter.map(|_| "--diameter").or(self.unit.map(|_| "--unit"))
    }
}
