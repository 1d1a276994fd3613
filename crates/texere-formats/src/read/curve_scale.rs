//! The scale of curves that another program wrote.

/// What a file of curves does not say about its yarns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveScale {
    /// The length of the file's unit, mm. For coordinates in metres it is 1000.
    pub unit_mm: f32,
    /// The diameter of all yarns, mm.
    pub diameter_mm: f32,
}
