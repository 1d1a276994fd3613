//! Diameters of yarns of known weight, weights of yarns of known diameter, and twist by the metre.
//!
//! A yarn's *count* says how much a length of the yarn weighs. The diameter of the yarn then
//! follows from its density. Density here is that of the yarn with the air in it, not that of the
//! fibre.

use std::f64::consts::{PI, TAU};

/// One inch, mm.
pub(crate) const INCH_MM: f64 = 25.4;

/// Density of a cotton yarn, g/cm³: a specific volume of 1.1 cm³/g.
///
/// **Source**: Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28,
/// 1937.
pub const COTTON_DENSITY: f64 = 1.0 / 1.1;

/// Diameter (mm) of a round yarn of `tex` (g/km) and `density` (g/cm³).
///
/// A length of 1 km weighs `tex` g and fills `π d²/4` mm² × 1 km, so that d = √(4 tex / (1000 π
/// density)), or 0.0357 √(tex / density). With [`COTTON_DENSITY`] it is Peirce's d = 1 / (28 √Ne)
/// inch.
///
/// ```
/// use texere_fabric::{COTTON_DENSITY, diameter_mm};
/// assert!((diameter_mm(100.0, COTTON_DENSITY) - 0.374).abs() < 1e-3);
/// ```
#[must_use]
pub fn diameter_mm(tex: f64, density: f64) -> f64 {
    (4.0 * tex / (1000.0 * PI * density)).sqrt()
}

/// Density (g/cm³) of a round yarn of `tex` (g/km) and `diameter_mm`, the air in it included. It is
/// the inverse of [`diameter_mm`].
///
/// ```
/// use texere_fabric::{COTTON_DENSITY, density_from_tex, diameter_mm};
/// let density = density_from_tex(30.0, diameter_mm(30.0, COTTON_DENSITY));
/// assert!((density - COTTON_DENSITY).abs() < 1e-12);
/// ```
#[must_use]
pub fn density_from_tex(tex: f64, diameter_mm: f64) -> f64 {
    4.0 * tex / (1000.0 * PI * diameter_mm * diameter_mm)
}

/// Linear density (tex, g/km) of a round yarn of `diameter_mm` and `density` (g/cm³). It is the
/// inverse of [`diameter_mm`].
///
/// ```
/// use texere_fabric::{COTTON_DENSITY, diameter_mm, tex_from_diameter};
/// let tex = tex_from_diameter(diameter_mm(30.0, COTTON_DENSITY), COTTON_DENSITY);
/// assert!((tex - 30.0).abs() < 1e-9);
/// ```
#[must_use]
pub fn tex_from_diameter(diameter_mm: f64, density: f64) -> f64 {
    diameter_mm * diameter_mm * (1000.0 * PI * density) / 4.0
}

/// Tex of a cotton count Ne: hanks of 840 yards to the pound.
///
/// ```
/// assert!((texere_fabric::tex_from_cotton_count(30.0) - 19.68).abs() < 0.01);
/// ```
#[must_use]
pub fn tex_from_cotton_count(ne: f64) -> f64 {
    // A pound of 453.592 g over 840 yards of 0.9144 m, in g/km.
    453_592.37 / (840.0 * 0.9144 * ne)
}

/// Tex of a metric count Nm: kilometres to the kilogram.
///
/// ```
/// assert_eq!(texere_fabric::tex_from_metric_count(50.0), 20.0);
/// ```
#[must_use]
pub fn tex_from_metric_count(nm: f64) -> f64 {
    1000.0 / nm
}

/// Tex of a denier: grams to nine kilometres.
///
/// ```
/// assert_eq!(texere_fabric::tex_from_denier(90.0), 10.0);
/// ```
#[must_use]
pub fn tex_from_denier(denier: f64) -> f64 {
    denier / 9.0
}

/// Twist in rad per mm, the unit of yarns and threads, from turns per metre, the unit of mills and
/// design files.
///
/// ```
/// use texere_fabric::{Thread, twist_from_turns_per_m};
/// // Hard Z twist, as of a warp for denim.
/// let end = Thread { twist: twist_from_turns_per_m(500.0), ..Thread::new(0.4, 0.15) };
/// // Once round in two millimetres.
/// assert!((end.twist * 2.0 - std::f32::consts::TAU).abs() < 1e-6);
/// ```
#[must_use]
pub fn twist_from_turns_per_m(turns: f64) -> f32 {
    (turns * TAU / 1000.0) as f32
}

/// Turns per metre of a twist (rad per mm): the inverse of [`twist_from_turns_per_m`].
///
/// ```
/// assert!((texere_fabric::turns_per_m(-std::f32::consts::PI) + 500.0).abs() < 1e-4);
/// ```
#[must_use]
pub fn turns_per_m(twist: f32) -> f64 {
    f64::from(twist) * 1000.0 / TAU
}

/// The tangent of the angle between the fibres on the surface of a cotton yarn of ordinary twist
/// and the yarn's axis.
///
/// **Source**: Peirce's diameter, and a twist factor of 3,600 turns/m √tex, as of ring-spun cotton
/// for weaving. With half the value, and with twice, `filament_covers_and_hard_twist_stays_round`
/// is red.
const ORDINARY_TWIST: f32 = 0.42;

/// The firmness of filament without twist, and that of the hardest twist. With 0.03, the threads of
/// a taffeta of filament overlap (`filament_covers_and_hard_twist_stays_round`).
const FIRMNESS: [f32; 2] = [0.1, 10.0];

/// How firmly the section of a yarn keeps its shape in woven cloth at rest
/// ([`Thread::firmness`](crate::Thread::firmness)), from its twist (rad/mm) and its radius when it
/// is round (mm): 1 for cotton of ordinary twist, 0.1 without twist, 10 at most.
///
/// Twist presses the fibres together. Its pressure grows with the square of the tangent of the
/// angle between the fibres on the surface and the yarn's axis (Hearle, Grosberg and Backer,
/// "Structural Mechanics of Fibers, Yarns, and Fabrics", 1969).
///
/// ```
/// use texere_fabric::{firmness_from_twist, twist_from_turns_per_m};
/// let [soft, hard] = [300.0, 1500.0].map(twist_from_turns_per_m);
/// assert!(firmness_from_twist(soft, 0.08) < 0.5 && firmness_from_twist(hard, 0.08) > 2.0);
/// ```
#[must_use]
pub fn firmness_from_twist(twist: f32, radius_mm: f32) -> f32 {
    let [soft, hard] = FIRMNESS;
    (twist * radius_mm / ORDINARY_TWIST).powi(2).clamp(soft, hard)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cotton_agrees_with_peirce() {
        // Peirce rounds the diameter at a specific volume of 1.1 to d = 1 / (28 √Ne) inch.
        for ne in [10.0f64, 30.0, 80.0] {
            let inches = 1.0 / (28.0 * ne.sqrt());
            let diameter = diameter_mm(tex_from_cotton_count(ne), COTTON_DENSITY);
            assert!((diameter / (25.4 * inches) - 1.0).abs() < 5e-3, "Ne {ne}: {diameter} mm");
        }
    }

    #[test]
    fn a_kilometre_weighs_its_tex() {
        let (tex, density) = (59.0, 1.25);
        let radius_cm = diameter_mm(tex, density) / 20.0;
        assert!((PI * radius_cm * radius_cm * 1e5 * density - tex).abs() < 1e-9);
    }

    #[test]
    fn one_cotton_count_is_590_and_a_half_tex() {
        assert!((tex_from_cotton_count(1.0) - 590.5).abs() < 0.05);
    }
}
