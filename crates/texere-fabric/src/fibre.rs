//! Fibres: how dense they are, how small a yarn of them can become, and how stiffly it bends.

use std::f64::consts::PI;

use crate::{COTTON_DENSITY, density_from_tex};

/// The largest share of a yarn's section that its fibres fill when the yarn is squeezed, unless a
/// yarn says otherwise. Equal round fibres in hexagons, the closest way, fill 0.907. In a yarn they
/// lie less orderly.
pub const PACKING: f64 = 0.8;

/// The least and the greatest packing of a squeezed yarn that a design may give.
pub const PACKING_LIMITS: [f64; 2] = [0.1, 0.91];

/// A fibre that yarns are made of.
///
/// ```
/// use texere_fabric::Fibre;
/// assert_eq!(Fibre::named("wool"), Some(Fibre::Wool));
/// assert_eq!(Fibre::Wool.density(), 1.31);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Fibre {
    /// Cotton.
    #[default]
    Cotton,
    /// Linen, which is flax.
    Linen,
    /// Nylon.
    Nylon,
    /// Polyester.
    Polyester,
    /// Silk.
    Silk,
    /// Viscose.
    Viscose,
    /// Wool.
    Wool,
}

impl Fibre {
    /// All fibres, in the order of their names.
    pub const ALL: [Self; 7] =
        [Self::Cotton, Self::Linen, Self::Nylon, Self::Polyester, Self::Silk, Self::Viscose, Self::Wool];

    /// The fibre's name in design files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cotton => "cotton",
            Self::Linen => "linen",
            Self::Nylon => "nylon",
            Self::Polyester => "polyester",
            Self::Silk => "silk",
            Self::Viscose => "viscose",
            Self::Wool => "wool",
        }
    }

    /// The fibre of this [name](Self::name).
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|fibre| fibre.name() == name)
    }

    /// Density of the solid fibre, g/cm³.
    ///
    /// **Source**: Morton and Hearle, "Physical properties of textile fibres", 4th edition, 2008,
    /// chapter 5.
    #[must_use]
    pub const fn density(self) -> f64 {
        match self {
            Self::Cotton | Self::Viscose => 1.52,
            Self::Linen => 1.5,
            Self::Nylon => 1.14,
            Self::Polyester => 1.38,
            Self::Silk => 1.34,
            Self::Wool => 1.31,
        }
    }

    /// Density of a yarn of this fibre with the air in it, g/cm³, if it is as full of fibre as
    /// Peirce's cotton yarn ([`COTTON_DENSITY`]).
    ///
    /// ```
    /// use texere_fabric::{COTTON_DENSITY, Fibre};
    /// assert_eq!(Fibre::Cotton.yarn_density(), COTTON_DENSITY);
    /// assert!((Fibre::Wool.yarn_density() - 0.783).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn yarn_density(self) -> f64 {
        COTTON_DENSITY * (self.density() / Self::Cotton.density())
    }

    /// Density of a yarn of this fibre as it is spun, the air in it included, g/cm³: the density
    /// that is `given`, else that of `tex` (g/km) and `diameter_mm` if both are known, else
    /// [`Fibre::yarn_density`].
    ///
    /// ```
    /// use texere_fabric::Fibre;
    /// assert_eq!(Fibre::Wool.spun_density(Some(0.7), Some(30.0), None), 0.7);
    /// assert_eq!(Fibre::Wool.spun_density(None, Some(30.0), None), Fibre::Wool.yarn_density());
    /// ```
    #[must_use]
    pub fn spun_density(self, given: Option<f64>, tex: Option<f64>, diameter_mm: Option<f64>) -> f64 {
        let spun = || tex.zip(diameter_mm).map(|(tex, diameter_mm)| density_from_tex(tex, diameter_mm));
        given.or_else(spun).unwrap_or_else(|| self.yarn_density())
    }

    /// Bending stiffness of a yarn of `tex` (g/km) of this fibre, N mm², if its fibres slide freely
    /// on one another: `η E T / (4 π ρ)` for each tex of yarn. Here η is the shape factor of the
    /// fibre's section, E its modulus (N/tex), T its linear density (tex) and ρ its density
    /// (g/cm³). The fibres are those of usual yarns: of wool 0.5 tex, of nylon 0.33, of linen 0.25,
    /// of silk 0.12, and of all others 0.17. Twist, size and resin make a yarn several times as
    /// stiff.
    ///
    /// **Source**: Morton and Hearle, "Physical properties of textile fibres", 4th edition, 2008,
    /// chapters 13 (moduli) and 17 (bending); the shape factors of cotton and linen are assumed.
    ///
    /// ```
    /// use texere_fabric::Fibre;
    /// // A cotton yarn of 20 tex, and one of polyester.
    /// assert!((Fibre::Cotton.bending_stiffness(20.0) - 6.2e-4).abs() < 1e-5);
    /// assert!((Fibre::Polyester.bending_stiffness(20.0) - 1.9e-3).abs() < 1e-4);
    /// ```
    #[must_use]
    pub fn bending_stiffness(self, tex: f64) -> f64 {
        let (shape, modulus, fibre_tex) = match self {
            Self::Cotton => (0.7, 5.0, 0.17),
            Self::Linen => (0.8, 18.0, 0.25),
            Self::Nylon => (0.91, 2.6, 0.33),
            Self::Polyester => (0.91, 10.6, 0.17),
            Self::Silk => (0.59, 7.3, 0.12),
            Self::Viscose => (0.74, 6.5, 0.17),
            Self::Wool => (0.8, 2.3, 0.5),
        };
        // The unit of the product is N tex / (g/cm³), which is 0.001 N mm².
        1e-3 * shape * modulus * fibre_tex / (4.0 * PI * self.density()) * tex
    }

    /// The bending stiffness that this fibre gives the material of a yarn of `tex`, N mm². None for
    /// cotton and without tex: such a material bends as cotton does.
    ///
    /// ```
    /// use texere_fabric::Fibre;
    /// assert_eq!(Fibre::Wool.bending_of(Some(20.0)), Some(Fibre::Wool.bending_stiffness(20.0)));
    /// assert_eq!((Fibre::Wool.bending_of(None), Fibre::Cotton.bending_of(Some(20.0))), (None, None));
    /// ```
    #[must_use]
    pub fn bending_of(self, tex: Option<f64>) -> Option<f64> {
        tex.filter(|_| self != Self::Cotton).map(|tex| self.bending_stiffness(tex))
    }

    /// The least area that the section of a yarn keeps, as a share of the section of the yarn as it
    /// is spun. `yarn_density` (g/cm³) is the density of the yarn as it is spun, the air in it
    /// included. `packing` is the largest share of the section that fibre fills. The least area is
    /// 1 if fibre fills this share, or more, of the yarn as it is spun.
    ///
    /// ```
    /// use texere_fabric::{COTTON_DENSITY, COTTON_LEAST_AREA, Fibre, PACKING};
    /// let cotton = Fibre::Cotton.least_area(COTTON_DENSITY, PACKING);
    /// assert!((cotton - 0.7476).abs() < 1e-4);
    /// assert_eq!(cotton, COTTON_LEAST_AREA);
    /// ```
    #[must_use]
    pub fn least_area(self, yarn_density: f64, packing: f64) -> f32 {
        (yarn_density / (packing * self.density())).min(1.0) as f32
    }
}

/// The least area of a cotton yarn's section, as a share of the section of the yarn as it is spun:
/// [`Fibre::least_area`] of Peirce's cotton yarn.
pub const COTTON_LEAST_AREA: f32 = (COTTON_DENSITY / (PACKING * Fibre::Cotton.density())) as f32;
