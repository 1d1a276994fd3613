//! The yarns of a knit, and the number of their control points.

/// A yarn of a weft or warp knit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnitYarn {
    /// The radius of the yarn, mm.
    pub radius_mm: f32,
    /// Index into the materials.
    pub material: u32,
    /// Index into the sections.
    pub section: u32,
    /// Twist, rad per mm; positive is Z twist.
    /// [`twist_from_turns_per_m`](crate::twist_from_turns_per_m) gives it.
    pub twist: f32,
}

impl KnitYarn {
    /// An untwisted yarn of the first material and the first section.
    #[must_use]
    pub const fn new(radius_mm: f32) -> Self {
        Self { radius_mm, material: 0, section: 0, twist: 0.0 }
    }
}

/// The number of control points of each loop and of each float or underlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Cells {
    /// The number that the bends of the yarn need. In a weft knit it is 12 for a plain loop, and 3
    /// for a float past a needle. In a warp knit it grows with the length of underlaps.
    #[default]
    Round,
    /// In a weft knit, 12 for each needle that the yarn comes to, whether it makes a loop there or
    /// floats. In a warp knit, 9 for each loop and none for underlaps.
    Even,
}
