//! What a yarn is made of, as far as its look and its weight go.

/// A yarn's material: shared by many yarns, and free to change without touching any geometry.
///
/// ```
/// use texere_core::Material;
/// let cotton = Material { name: "cotton".into(), srgb: [236, 229, 212], tex: Some(30.0), hairiness: 6.0 };
/// assert_eq!(cotton.linear_rgb()[0], (236.0f32 / 255.0 + 0.055).powf(2.4) / 1.055f32.powf(2.4));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name, as the design gives it.
    pub name: String,
    /// Colour, sRGB, 8 bits a channel.
    pub srgb: [u8; 3],
    /// Linear density in tex (g/km), where the design gives one.
    pub tex: Option<f32>,
    /// Fibres that stand off the yarn: their length in cm for a cm of yarn, as Uster testers have
    /// it in their H. 0 for none, as of filament; [`HAIRINESS_LIMIT`] at most. Only pictures show
    /// them.
    pub hairiness: f32,
}

/// The most hairiness that is taken: spun yarns have 3 to 11 by Uster's testers, and coarse woollen
/// some more.
pub const HAIRINESS_LIMIT: f32 = 30.0;

impl Default for Material {
    /// Undyed yarn of unknown weight, off which no fibres stand.
    fn default() -> Self {
        Self { name: "undyed".into(), srgb: [232, 226, 212], tex: None, hairiness: 0.0 }
    }
}

impl Material {
    /// The colour in linear light, each channel in \[0, 1\] (IEC 61966-2-1, the sRGB transfer
    /// function).
    #[must_use]
    pub fn linear_rgb(&self) -> [f32; 3] {
        self.srgb.map(|channel| {
            let encoded = f32::from(channel) / 255.0;
            if encoded <= 0.04045 {
                encoded / 12.92
            } else {
                (encoded + 0.055).powf(2.4) / 1.055f32.powf(2.4)
            }
        })
    }
}
