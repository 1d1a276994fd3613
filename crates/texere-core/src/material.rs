//! Materials: the look, the weight and the bending stiffness of yarns.

/// A yarn's material. Many yarns can share a material. Changing a material moves no control point.
///
/// ```
/// use texere_core::Material;
/// let cotton = Material { name: "cotton".into(), srgb: [236, 229, 212], tex: Some(30.0), ..Material::default() };
/// assert_eq!(cotton.linear_rgb()[0], (236.0f32 / 255.0 + 0.055).powf(2.4) / 1.055f32.powf(2.4));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The material's name in the design.
    pub name: String,
    /// Colour, sRGB, 8 bits a channel.
    pub srgb: [u8; 3],
    /// Linear density in tex (g/km), if the design has one.
    pub tex: Option<f32>,
    /// Hairiness: the length in cm of the fibres that stand off one cm of yarn (the H of Uster
    /// testers). It is 0 for yarn without such fibres, for example filament, and
    /// [`HAIRINESS_LIMIT`] at most. Only pictures show these fibres.
    pub hairiness: f32,
    /// Bending stiffness B, N mm²: the moment for a curvature of 1/mm, within [`BENDING_LIMITS`].
    /// Knits that come to rest by their energy use it. If it is `None`, the yarn bends as soft
    /// cotton of equal tex does, or as soft cotton of equal thickness if the material has no tex.
    pub bending: Option<f32>,
}

/// The largest hairiness that is accepted. Spun yarns have 3 to 11 on Uster's testers, and coarse
/// woollen yarns a little more.
pub const HAIRINESS_LIMIT: f32 = 30.0;

/// The least and the greatest bending stiffness that are accepted, N mm²: that of a thin fibre, and
/// that of a rope.
pub const BENDING_LIMITS: [f32; 2] = [1e-9, 1e6];

impl Default for Material {
    /// Undyed yarn of unknown weight without hairs.
    fn default() -> Self {
        Self { name: "undyed".into(), srgb: [232, 226, 212], tex: None, hairiness: 0.0, bending: None }
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

    /// The sRGB value of a linear one, both in \[0, 1\]: the inverse of [`Material::linear_rgb`],
    /// channel by channel.
    ///
    /// ```
    /// use texere_core::Material;
    /// let madder = Material { srgb: [160, 44, 41], ..Material::default() };
    /// let again = madder.linear_rgb().map(|linear| (255.0 * Material::encoded(linear)).round());
    /// assert_eq!(again, [160.0, 44.0, 41.0]);
    /// ```
    #[must_use]
    pub fn encoded(linear: f32) -> f32 {
        if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
    }
}
