//! Intervals: the pieces of yarn between two control points while the yarn settles.

use glam::{IVec3, Vec3};

use super::{Place, Scale};
use crate::definitions::VERTICAL;
use crate::spline::coefficients;

/// The spline between two control points, relative to the first of them, with the yarn's half width
/// and half height.
#[derive(Debug, Clone, Copy)]
pub struct Interval {
    /// The interval's start, units.
    pub start: IVec3,
    /// The coefficients of u, u² and u³ in the vector from the start, mm.
    pub terms: [Vec3; 3],
    /// Half width and half height at the start, and by how much both grow to the end, mm.
    halves: [[f32; 2]; 2],
}

impl Interval {
    /// The interval between `places[1]` and `places[2]`, with `s = (1 - tension) / 2`.
    #[must_use]
    #[inline]
    pub fn new(places: &[Place; 4], scale: &Scale, s: f32) -> Self {
        let [before, start, end, after] = places.map(|place| place.units());
        let [a, b, c] = [before, end, after].map(|place| scale.length(place.wrapping_sub(start)));
        let halves = [places[1], places[2]].map(|place| [place.halves.width(), place.halves.height()]);
        let growth = [halves[1][0] - halves[0][0], halves[1][1] - halves[0][1]];
        Self { start, terms: coefficients(a, b, c, s), halves: [halves[0], growth] }
    }

    /// An interval from four rows, as backends store it. Row 0 has the start (as bits) and the
    /// growth of the half width. Row 1 has the coefficient of u and the half width at the start,
    /// row 2 the coefficient of u² and the half height at the start, and row 3 the coefficient of
    /// u³ and the growth of the half height.
    #[must_use]
    pub fn from_rows(rows: &[[f32; 4]; 4]) -> Self {
        let [[x, y, z, width_growth], [.., width], [.., height], [.., height_growth]] = *rows;
        let terms = [1, 2, 3].map(|row: usize| Vec3::new(rows[row][0], rows[row][1], rows[row][2]));
        let start = IVec3::from_array([x, y, z].map(|bits| bits.to_bits().cast_signed()));
        Self { start, terms, halves: [[width, height], [width_growth, height_growth]] }
    }

    /// The vector from the start to `u` in \[0, 1\], mm.
    #[must_use]
    #[inline]
    pub fn offset(&self, u: f32) -> Vec3 {
        let [c1, c2, c3] = self.terms;
        (c1 + (c2 + c3 * u) * u) * u
    }

    /// The first derivative by u, mm.
    #[must_use]
    #[inline]
    pub fn velocity(&self, u: f32) -> Vec3 {
        let [c1, c2, c3] = self.terms;
        c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u
    }

    /// The second derivative by u, mm.
    #[must_use]
    #[inline]
    pub fn acceleration(&self, u: f32) -> Vec3 {
        let [_, c2, c3] = self.terms;
        c2 * 2.0 + c3 * (6.0 * u)
    }

    /// The reach of the yarn from its centreline at `u` in direction `towards`, a unit vector, mm.
    /// The yarn stands upright: its width is level, and its height points out of the cloth.
    #[must_use]
    #[inline]
    pub fn reach(&self, u: f32, towards: Vec3) -> f32 {
        let [start, growth] = self.halves;
        let (width, height) = (start[0] + growth[0] * u, start[1] + growth[1] * u);
        if width == height {
            return width;
        }
        let tangent = self.velocity(u);
        let level = tangent.x * tangent.x + tangent.y * tangent.y;
        let square = level + tangent.z * tangent.z;
        if level <= VERTICAL * square {
            return width;
        }
        // The side is (-y, x, 0) and the up is t x side, both divided by their lengths.
        let aside = (towards.y * tangent.x - towards.x * tangent.y) * width;
        let up = (towards.z * level - (towards.x * tangent.x + towards.y * tangent.y) * tangent.z) * height;
        ((aside * aside + up * up / square) / level).sqrt()
    }

    /// The largest half width or half height at either end, mm.
    #[must_use]
    #[inline]
    pub fn thickest(&self) -> f32 {
        let [start, growth] = self.halves;
        let end = [start[0] + growth[0], start[1] + growth[1]];
        start[0].max(start[1]).max(end[0].max(end[1]))
    }

    /// The arc length between two parameters, by Gauss's rule with three nodes, mm.
    #[must_use]
    #[inline]
    pub fn arc_between(&self, from: f32, to: f32) -> f32 {
        let speed = |share: f32| self.velocity(from + (to - from) * share).length_squared().sqrt();
        let mean =
            (speed(GAUSS[0]) + speed(GAUSS[2])) * GAUSS_WEIGHTS[0] + speed(GAUSS[1]) * GAUSS_WEIGHTS[1];
        mean * (to - from)
    }

    /// The arc length by Gauss's rule with three nodes, mm, and the direction from start to end.
    #[must_use]
    #[inline]
    pub fn arc(&self) -> (f32, Vec3) {
        let [c1, c2, c3] = self.terms;
        let arc = self.arc_between(0.0, 1.0);
        let chord = c1 + c2 + c3;
        let length = chord.length_squared().sqrt();
        (arc, if length > 0.0 { chord * (1.0 / length) } else { Vec3::ZERO })
    }
}

/// The nodes of Gauss's rule on \[0, 1\]: 1/2 and 1/2 ± √0.15.
pub const GAUSS: [f32; 3] = [0.112_701_67, 0.5, 0.887_298_35];

/// The weight of either outer node, and that of the middle node.
pub const GAUSS_WEIGHTS: [f32; 2] = [5.0 / 18.0, 8.0 / 18.0];

/// The weights of an interval's four control points at `u`. Their sum is 1.
#[must_use]
#[inline]
pub(super) fn weights(u: f32, s: f32) -> [f32; 4] {
    let (square, cube) = (u * u, u * u * u);
    let before = (2.0 * square - u - cube) * s;
    let after = (cube - square) * s;
    let end = s * u + (3.0 - 2.0 * s) * square + (s - 2.0) * cube;
    [before, 1.0 - before - end - after, end, after]
}

/// The weights of an interval's four control points in its second derivative at `u`. Their sum is
/// 0.
#[must_use]
#[inline]
pub fn bends(u: f32, s: f32) -> [f32; 4] {
    let before = (4.0 - 6.0 * u) * s;
    let after = (6.0 * u - 2.0) * s;
    let end = 2.0 * (3.0 - 2.0 * s) + 6.0 * (s - 2.0) * u;
    [before, -(before + end + after), end, after]
}
