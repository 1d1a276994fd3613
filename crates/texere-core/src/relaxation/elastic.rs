//! The elastic properties of a yarn, and the contact of two yarns.

/// The exponent p of the shell's energy.
///
/// **Source**: Singal et al. 2024, fitted to the compression of an acrylic yarn.
const HARDENING: f64 = 2.4;

/// The least share of the shell's thickness, up to which the energy follows the power law. Below
/// it, the energy is continued by the parabola with equal value, slope and curvature, so that it is
/// finite for yarns that pierce one another at the start.
const THINNEST: f64 = 0.02;

/// The elastic properties of a yarn: a core that is hardly ever entered, and a soft shell round it.
///
/// Two yarns touch where their shells overlap. If their centrelines are a distance apart that is
/// more than the sum of both cores and less than the sum of both shells, y is the share of both
/// shells' thickness D that is left, from 1 (they just touch) to 0 (the cores touch). The energy
/// for each mm of either yarn is `k D² / (p (p - 1)) (y^(1 - p) - 1 + (p - 1) (y - 1))`, with p =
/// 2.4 and the stiffness k.
///
/// ```
/// use texere_core::relaxation::Elastic;
/// // An acrylic yarn for knitting by hand.
/// let yarn = Elastic { bending: 0.045, core: 0.325, shell: 0.74, compression: 0.0006, extension: 50.0 };
/// assert!(yarn.shell > yarn.core);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Bending stiffness B, N mm²: the moment for a curvature of 1/mm, N mm.
    pub bending: f64,
    /// Radius of the core, mm.
    pub core: f64,
    /// Radius of the shell, mm; more than that of the core.
    pub shell: f64,
    /// Stiffness k of the shell against compression, N/mm³.
    pub compression: f64,
    /// Stiffness EA against stretch, N: the force that would double the length.
    pub extension: f64,
}

/// The contact of two yarns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shells {
    /// The distance of centrelines at which the cores touch, mm.
    core: f64,
    /// The thickness of both shells together, mm.
    depth: f64,
    /// The stiffness of both shells, one behind the other, N/mm³.
    compression: f64,
}

impl Shells {
    /// The contact of two yarns that have the share `growth` of their thickness.
    pub(super) fn new(yarns: [&Elastic; 2], growth: f64) -> Self {
        let [one, other] = yarns;
        let core = growth * (one.core + other.core);
        let depth = growth * (one.shell + other.shell) - core;
        let compression = 2.0 * one.compression * other.compression / (one.compression + other.compression);
        Self { core, depth, compression }
    }

    /// The distance of centrelines below which the shells touch, mm.
    pub(super) const fn reach(&self) -> f64 {
        self.core + self.depth
    }

    /// The energy at a distance of centrelines below [`Shells::reach`], for each mm of either yarn,
    /// N/mm, and by how much it grows with the distance, N/mm².
    #[inline]
    pub(super) fn energy(&self, distance: f64) -> [f64; 2] {
        let y = (distance - self.core) / self.depth;
        let (at, beyond) = (y.max(THINNEST), (y - THINNEST).min(0.0));
        let power = at.powf(-HARDENING);
        let value = at * power - 1.0 + (HARDENING - 1.0) * (at - 1.0);
        let slope = (HARDENING - 1.0) * (1.0 - power);
        let curvature = if beyond < 0.0 { (HARDENING - 1.0) * HARDENING * power / at } else { 0.0 };
        let scale = self.compression * self.depth / (HARDENING * (HARDENING - 1.0));
        let value = value + beyond * (slope + 0.5 * beyond * curvature);
        [scale * self.depth * value, scale * (slope + beyond * curvature)]
    }
}
