//! The elastic properties of a yarn, and the contact of two yarns.

/// The exponent p of the shell's energy.
///
/// **Source**: Singal et al. 2024, fitted to the compression of an acrylic yarn.
const HARDENING: f64 = 2.4;

/// The least share of the shells' thickness for which the energy follows the power law. Below this
/// share, the energy is continued by the parabola with equal value, slope and curvature. The energy
/// is therefore finite for yarns that pierce one another at the start. With half the value, and
/// with twice, no test is red.
const THINNEST: f64 = 0.02;

/// The elastic properties of a yarn: a core that is hardly ever entered, and a soft shell round it.
///
/// Two yarns touch where their shells overlap: where the distance of their centrelines is less than
/// the sum of both shells' radii. D is the thickness of both shells together: that sum less the sum
/// of both cores' radii. y is the share of D that is left between the cores, from 1 (the shells
/// just touch) to 0 (the cores touch). The energy for each mm of either yarn is
/// `k D² / (p (p - 1)) (y^(1 - p) - 1 + (p - 1) (y - 1))`, with p = 2.4 and the stiffness k.
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
    /// N/mm, its first derivative by the distance, N/mm², and its second one, N/mm³.
    #[inline]
    pub(super) fn energy(&self, distance: f64) -> [f64; 3] {
        let y = (distance - self.core) / self.depth;
        let (at, beyond) = (y.max(THINNEST), (y - THINNEST).min(0.0));
        let power = at.powf(-HARDENING);
        let value = at * power - 1.0 + (HARDENING - 1.0) * (at - 1.0);
        let slope = (HARDENING - 1.0) * (1.0 - power);
        let curvature = (HARDENING - 1.0) * HARDENING * power / at;
        let scale = self.compression * self.depth / (HARDENING * (HARDENING - 1.0));
        let value = value + beyond * (slope + 0.5 * beyond * curvature);
        [scale * self.depth * value, scale * (slope + beyond * curvature), scale * curvature / self.depth]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_differences() {
        let yarn = Elastic { bending: 0.045, core: 0.3, shell: 0.7, compression: 6e-4, extension: 50.0 };
        let shells = Shells::new([&yarn, &Elastic { core: 0.25, ..yarn }], 0.9);
        for distance in [0.3, 0.5, 0.6, 0.9, 1.2] {
            let step = 1e-6;
            let [low, high] = [-step, step].map(|way| shells.energy(distance + way));
            let [_, slope, change] = shells.energy(distance);
            assert!(((high[0] - low[0]) / (2.0 * step) / slope - 1.0).abs() < 1e-5, "{distance}");
            assert!(((high[1] - low[1]) / (2.0 * step) / change - 1.0).abs() < 1e-5, "{distance}");
        }
    }
}
