//! What yarns of a knit are like, and how many control points they get.

/// A yarn of a knitted cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnitYarn {
    /// Its radius, mm.
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
    /// A round, untwisted yarn of the first material and the first section.
    #[must_use]
    pub const fn new(radius_mm: f32) -> Self {
        Self { radius_mm, material: 0, section: 0, twist: 0.0 }
    }
}

/// How many control points stitches get.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Cells {
    /// As many as their yarn needs for its bends: 12 for a plain loop, 3 where it floats.
    #[default]
    Round,
    /// 12 for each needle that the yarn comes to, whether it makes a loop there or floats.
    Even,
}
