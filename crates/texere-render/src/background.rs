//! The background of a picture.

use texere_core::Material;

/// What a picture shows where it shows no yarn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Background {
    /// A light grey ground, on which the cloth lies and casts its shadow.
    #[default]
    Ground,
    /// One colour, sRGB.
    Color([u8; 3]),
    /// Nothing: [`Picture::alpha`](crate::Picture::alpha) says how much of each pixel is yarn.
    Nothing,
}

impl Background {
    /// The background's linear colour, and its kind as `view.wgsl` encodes it.
    pub(crate) fn encoded(self) -> ([f32; 3], u32) {
        match self {
            Self::Ground => ([0.0; 3], 0),
            Self::Color(srgb) => (Material { srgb, ..Material::default() }.linear_rgb(), 1),
            Self::Nothing => ([0.0; 3], 2),
        }
    }
}
