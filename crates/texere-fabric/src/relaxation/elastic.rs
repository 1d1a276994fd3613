//! The elastic properties of yarns: what a design says of them, and what is assumed of the rest.

use texere_core::relaxation::Elastic;
use texere_core::{Material, Yarn, Yarns};

use crate::Fibre;

/// The radius of the soft shell, in radii of the yarn. Fibres that stand off a spun yarn are felt
/// before the yarns themselves touch. Shells of 1.3 to 2.3 radii were tried on plain jersey of
/// tightness 11 to 15: with less than 1.7 radii, slack loops get too wide
/// (`jersey_has_its_proportions`).
/// With half the value, `plans_refuse_what_no_yarn_has` is red; with twice,
/// `jersey_has_its_proportions`.
const SHELL: f64 = 2.0;

/// The stiffness of the shell, as a multiple of the bending stiffness over the fifth power of the
/// shell's radius. With a third of this multiple, slack jersey gets too wide, and with ten times as
/// much, jersey gets too low. With half the value, and with twice, `jersey_has_its_proportions` is
/// red.
const COMPRESSION: f64 = 0.01;

/// The stiffness against stretch, as a multiple of the bending stiffness over the square of the
/// yarn's radius. Yarns at rest are then shorter or longer by 0.1 % at most. Ten times as much
/// needs twice as many steps. With half the value, and with twice, no test is red.
const EXTENSION: f64 = 100.0;

/// The stiffness of springs that press cloth flat, as a multiple of the bending stiffness over the
/// fourth power of the diameter. The springs press like a light weight on the cloth. With a tenth
/// of the multiple, lace and cables crumple; with three times as much, rib does not draw in. With
/// twice the value, `rib_draws_in` is red; with half, no test is.
const PRESS: f64 = 0.015;

/// The diameter of a cotton yarn of 1 tex, mm.
///
/// **Source**: Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28,
/// 1937.
const DIAMETER: f64 = 0.0373;

/// The elastic properties of a spun yarn of this radius, mm. The shape of a knit at rest depends
/// only on their ratios, so that it is equal for yarns of any stiffness.
///
/// ```
/// // A cotton yarn of 20 tex.
/// let yarn = texere_fabric::elastic_of_radius(0.0834);
/// assert!((yarn.bending - 6.2e-4).abs() < 1e-5); // N mm²
/// assert_eq!(yarn.shell, 2.0 * yarn.core);
/// ```
#[must_use]
pub fn elastic_of_radius(radius_mm: f64) -> Elastic {
    elastic_of(radius_mm, Fibre::Cotton.bending_stiffness((2.0 * radius_mm / DIAMETER).powi(2)))
}

/// The elastic properties of a yarn of this radius, mm, and this bending stiffness, N mm².
fn elastic_of(radius_mm: f64, bending: f64) -> Elastic {
    let shell = SHELL * radius_mm;
    Elastic {
        bending,
        core: radius_mm,
        shell,
        compression: COMPRESSION * bending / shell.powi(5),
        extension: EXTENSION * bending / (radius_mm * radius_mm),
    }
}

/// The properties of all yarns, by the mean of their half widths and half heights, and by the
/// bending stiffness of their materials.
pub(super) fn of_yarns(yarns: &Yarns) -> Vec<Elastic> {
    let mean = |yarn: usize| {
        let points = yarns.yarn_points(yarn).unwrap_or(&[]);
        let halves = points.iter().map(|point| f64::from(point.half_width() + point.half_height()));
        0.5 * halves.sum::<f64>() / points.len().max(1) as f64
    };
    let own = |(yarn, each): (usize, &Yarn)| {
        let Material { tex, bending, .. } = &yarns.materials()[each.material as usize];
        let of_tex = || tex.map(|tex| Fibre::Cotton.bending_stiffness(f64::from(tex)));
        let bending = bending.map(f64::from).or_else(of_tex);
        bending.map_or_else(|| elastic_of_radius(mean(yarn)), |bending| elastic_of(mean(yarn), bending))
    };
    yarns.layout().yarns().iter().enumerate().map(own).collect()
}

/// The stiffness that presses a cloth of these yarns flat, N/mm²: the mean of what each asks for.
pub(super) fn press_of(elastic: &[Elastic]) -> f64 {
    let each = elastic.iter().map(|elastic| PRESS * elastic.bending / (2.0 * elastic.core).powi(4));
    each.sum::<f64>() / elastic.len().max(1) as f64
}
