//! The yarn between two control points, as settling sees it.

use glam::{IVec3, Vec3};

use super::{Place, Scale};
use crate::definitions::VERTICAL;
use crate::spline::coefficients;

/// The spline between two control points, from the first of them on, and how thick the yarn is
/// there.
#[derive(Debug, Clone, Copy)]
pub struct Interval {
    /// Where it begins, units.
    pub start: IVec3,
    /// What goes with u, u² and u³, mm.
    pub terms: [Vec3; 3],
    /// Half width and half height at its beginning, and their growth to its end, mm.
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

    /// An interval from four rows, as backends keep it: where it begins (as bits) and the growth of
    /// its half width; what goes with u and its half width at the beginning; with u² and its half
    /// height; with u³ and the growth of that.
    #[must_use]
    pub fn from_rows(rows: &[[f32; 4]; 4]) -> Self {
        let [[x, y, z, width_growth], [.., width], [.., height], [.., height_growth]] = *rows;
        let terms = [1, 2, 3].map(|row: usize| Vec3::new(rows[row][0], rows[row][1], rows[row][2]));
        let start = IVec3::from_array([x, y, z].map(|bits| bits.to_bits().cast_signed()));
        Self { start, terms, halves: [[width, height], [width_growth, height_growth]] }
    }

    /// The way from its beginning to `u` in \[0, 1\], mm.
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

    /// How far the yarn reaches from its centreline at `u` in direction `towards`, a unit vector,
    /// mm. It stands upright: half its width level, half its height out of the cloth.
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
        // Side is (-y, x, 0), up is t x side, both over their lengths.
        let aside = (towards.y * tangent.x - towards.x * tangent.y) * width;
        let up = (towards.z * level - (towards.x * tangent.x + towards.y * tangent.y) * tangent.z) * height;
        ((aside * aside + up * up / square) / level).sqrt()
    }

    /// The larger of its half width and half height, at either end, mm.
    #[must_use]
    #[inline]
    pub fn thickest(&self) -> f32 {
        let [start, growth] = self.halves;
        let end = [start[0] + growth[0], start[1] + growth[1]];
        start[0].max(start[1]).max(end[0].max(end[1]))
    }

    /// Its length between two places, by Gauss's rule of three places, mm.
    #[must_use]
    #[inline]
    pub fn arc_between(&self, from: f32, to: f32) -> f32 {
        let speed = |share: f32| self.velocity(from + (to - from) * share).length_squared().sqrt();
        let mean =
            (speed(GAUSS[0]) + speed(GAUSS[2])) * GAUSS_WEIGHTS[0] + speed(GAUSS[1]) * GAUSS_WEIGHTS[1];
        mean * (to - from)
    }

    /// Its length by Gauss's rule of three places, mm, and the direction from its beginning to its
    /// end.
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

/// Places of Gauss's rule on \[0, 1\]: 1/2 and 1/2 ± √0.15.
pub const GAUSS: [f32; 3] = [0.112_701_67, 0.5, 0.887_298_35];

/// What the outer places and the middle one count.
pub const GAUSS_WEIGHTS: [f32; 2] = [5.0 / 18.0, 8.0 / 18.0];

/// What each of an interval's four control points counts at `u`: their sum is 1.
#[must_use]
#[inline]
pub(super) fn weights(u: f32, s: f32) -> [f32; 4] {
    let (square, cube) = (u * u, u * u * u);
    let before = (2.0 * square - u - cube) * s;
    let after = (cube - square) * s;
    let end = s * u + (3.0 - 2.0 * s) * square + (s - 2.0) * cube;
    [before, 1.0 - before - end - after, end, after]
}

/// What each of an interval's four control points counts in its second derivative at `u`: their sum
/// is 0.
#[must_use]
#[inline]
pub fn bends(u: f32, s: f32) -> [f32; 4] {
    let before = (4.0 - 6.0 * u) * s;
    let after = (6.0 * u - 2.0) * s;
    let end = 2.0 * (3.0 - 2.0 * s) + 6.0 * (s - 2.0) * u;
    [before, -(before + end + after), end, after]
}
