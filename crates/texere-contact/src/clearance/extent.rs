//! Whether a plane lies between two intervals, so that they can't touch.

use glam::DVec3;

use super::interval::Cubic;
use super::support::Support;

/// Parameters of the sections that represent the whole interval: its beginning, middle and end.
const STATIONS: [f64; 3] = [0.0, 0.5, 1.0];

/// The share of a second difference by which a value may be larger between stations. A parabola
/// needs 1/8. With half the value, and with twice, no test is red.
const BETWEEN: f64 = 0.25;

/// The reach of an interval whose sections do not turn.
pub(super) struct Extent {
    hull: [DVec3; 4],
    middle: DVec3,
    /// Half width and half height in the middle, mm.
    halves: [f64; 2],
    /// Half axes of ellipses that hold the sections.
    axes: [[DVec3; 2]; 3],
}

impl Extent {
    pub(super) fn new(cubic: &Cubic, support: &Support) -> Self {
        let axes = STATIONS.map(|t| {
            let [_, velocity, _] = cubic.path(t);
            let sizes = cubic.sizes(t) * support.extent();
            let [side, up] = cubic.frame(t, velocity.normalize_or(DVec3::X));
            [side * sizes.x, up * sizes.y]
        });
        Self { hull: cubic.hull(), middle: cubic.position(0.5), halves: cubic.sizes(0.5).to_array(), axes }
    }

    /// Upper bound of how far the surface reaches from the centreline in a direction.
    fn reach(&self, direction: DVec3) -> f64 {
        let [first, middle, last] =
            self.axes.map(|[side, up]| (side.dot(direction).powi(2) + up.dot(direction).powi(2)).sqrt());
        first.max(middle).max(last) + BETWEEN * (first - 2.0 * middle + last).abs()
    }

    /// Whether a plane at right angles to `direction` lies between both intervals when their
    /// sections are `near` times as large.
    fn parted(&self, other: &Self, direction: DVec3, near: f64) -> bool {
        let along = |one: &Self| one.hull.map(|corner| corner.dot(direction));
        let most = along(self).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let least = along(other).into_iter().fold(f64::INFINITY, f64::min);
        least - most > near * (self.reach(direction) + other.reach(direction))
    }

    /// Whether a plane shows that the surfaces are clear of one another with sections `near` times
    /// as large. Two planes are tried. The second is at right angles to the line between the
    /// middles. The first is at right angles to that line after its components are scaled as those
    /// of a flat thread's normal: x and y by the squared height, z by the squared width.
    pub(super) fn is_clear_of(&self, other: &Self, near: f64) -> bool {
        let apart = other.middle - self.middle;
        let [wide, high] = [0, 1].map(|half| self.halves[half] + other.halves[half]);
        let flat = DVec3::new(apart.x * high * high, apart.y * high * high, apart.z * wide * wide);
        [flat, apart].into_iter().any(|direction| self.parted(other, direction, near))
    }
}
