//! How sections stand on rings, in lanes: `Ring::vertex` of the core for a vector of rings.

use texere_core::SectionPoint;

use super::rings::Rings;
use super::simd::{Floats, Mask, Simd, difference, plus, scale};

/// The number of floats of a vertex: position and normal.
pub(super) const VERTEX: usize = 6;

/// A vector of rings, with what all vertices of a ring share.
pub(super) trait Stances<S: Simd> {
    /// The vertex of each ring at `point`, which is number `number` of the outline: rows of x, y, z
    /// and of the normal's x, y, z, a ring in each lane.
    fn vertex(&self, simd: S, number: usize, point: &SectionPoint) -> [S::Floats; VERTEX];
}

/// Kind of [`Round`]: the radius grows or shrinks, so normals lean.
pub(super) const SLOPED: u8 = 0;
/// Kind of [`Round`]: constant radius, so normals do not lean.
pub(super) const PLAIN: u8 = 1;
/// Kind of [`Round`]: constant radius, and the section's normals equal its points, as on a circle.
pub(super) const ROUND: u8 = 2;

/// Round rings.
pub(super) struct Round<'a, S: Simd, const FLATTENED: bool, const KIND: u8>(
    pub(super) &'a Rings<S, FLATTENED>,
);

impl<S: Simd, const FLATTENED: bool, const KIND: u8> Stances<S> for Round<'_, S, FLATTENED, KIND> {
    #[cfg_attr(optimized, inline(always))]
    fn vertex(&self, simd: S, _: usize, point: &SectionPoint) -> [S::Floats; VERTEX] {
        let rings = self.0;
        let (x, y) = (simd.splat(point.x), simd.splat(point.y));
        let (normal_x, normal_y) = (simd.splat(point.normal_x), simd.splat(point.normal_y));
        let (lean, steep) = if KIND == SLOPED {
            let lean = rings.width_growth * simd.splat(point.reach());
            (lean, simd.splat(1.0) / (simd.splat(1.0) + lean * lean).sqrt())
        } else {
            (rings.width_growth, rings.width_growth)
        };
        let mut rows = [simd.splat(0.0); VERTEX];
        for axis in 0..3 {
            let outward = rings.side[axis] * x + rings.up[axis] * y;
            rows[axis] = rings.centre[axis] + outward * rings.half_width;
            let across = match KIND {
                ROUND => outward,
                _ => rings.side[axis] * normal_x + rings.up[axis] * normal_y,
            };
            rows[3 + axis] = if KIND == SLOPED {
                let leaning = (across - rings.tangent[axis] * lean) * steep;
                rings.width_growth.is_zero().select(across, leaning)
            } else {
                across
            };
        }
        rows
    }
}

/// Rings of flattened yarns. Without `ROLLED` they have no roll. Without `LEANING` neither the half
/// width nor the half height grows.
pub(super) struct Flat<'a, S: Simd, const FLATTENED: bool, const ROLLED: bool, const LEANING: bool> {
    rings: &'a Rings<S, FLATTENED>,
    /// The centre. No coordinate of it is -0.
    centre: [S::Floats; 3],
}

impl<'a, S: Simd, const FLATTENED: bool, const ROLLED: bool, const LEANING: bool>
    Flat<'a, S, FLATTENED, ROLLED, LEANING>
{
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, rings: &'a Rings<S, FLATTENED>) -> Self {
        Self { rings, centre: plus(rings.centre, [simd.splat(0.0); 3]) }
    }

    /// The vector from the centre to `point`, and the normal there.
    #[cfg_attr(optimized, inline(always))]
    fn outward(&self, simd: S, point: &SectionPoint) -> [[S::Floats; 3]; 2] {
        let (wide, high) = (self.rings.half_width, self.rings.half_height);
        let [x, y] = self.rolled(simd, point.x, point.y);
        let [normal_x, normal_y] = self.rolled(simd, point.normal_x, point.normal_y);
        let (normal_x, normal_y) = (normal_x * high, normal_y * wide);
        let squared = normal_x * normal_x + normal_y * normal_y;
        let normal = if LEANING {
            let lean = self.rings.width_growth * x * normal_x + self.rings.height_growth * y * normal_y;
            let inverse = simd.splat(1.0) / (squared + lean * lean).sqrt();
            let across = self.at(normal_x * inverse, normal_y * inverse);
            difference(across, scale(self.rings.tangent, lean * inverse))
        } else {
            let inverse = simd.splat(1.0) / squared.sqrt();
            self.at(normal_x * inverse, normal_y * inverse)
        };
        [self.at(x * wide, y * high), plus(normal, [simd.splat(0.0); 3])]
    }

    /// The vector that is `x` along the side and `y` along the up.
    #[cfg_attr(optimized, inline(always))]
    fn at(&self, x: S::Floats, y: S::Floats) -> [S::Floats; 3] {
        let Rings { side, up, .. } = self.rings;
        [side[0] * x + up[0] * y, side[1] * x + up[1] * y, up[2] * y]
    }

    /// `x` and `y` turned by the roll.
    #[cfg_attr(optimized, inline(always))]
    fn rolled(&self, simd: S, x: f32, y: f32) -> [S::Floats; 2] {
        let (x, y) = (simd.splat(x), simd.splat(y));
        if !ROLLED {
            return [x, y];
        }
        let (sin, cos) = self.rings.roll;
        [cos * x - sin * y, sin * x + cos * y]
    }
}

impl<S: Simd, const FLATTENED: bool, const ROLLED: bool, const LEANING: bool> Stances<S>
    for Flat<'_, S, FLATTENED, ROLLED, LEANING>
{
    #[cfg_attr(optimized, inline(always))]
    fn vertex(&self, simd: S, _: usize, point: &SectionPoint) -> [S::Floats; VERTEX] {
        let [outward, [normal_x, normal_y, normal_z]] = self.outward(simd, point);
        let [x, y, z] = plus(self.centre, outward);
        [x, y, z, normal_x, normal_y, normal_z]
    }
}

/// Rings of flattened yarns with six sides. Opposite points of the section are negatives of one
/// another.
pub(super) struct SixSided<S: Simd> {
    centre: [S::Floats; 3],
    /// For each of the first three points: the vector from the centre to the point, and the normal
    /// there.
    first: [[[S::Floats; 3]; 2]; 3],
}

impl<S: Simd> SixSided<S> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new<const FLATTENED: bool, const ROLLED: bool, const LEANING: bool>(
        simd: S,
        flat: &Flat<'_, S, FLATTENED, ROLLED, LEANING>,
        [one, two, three, ..]: &[SectionPoint; 6],
    ) -> Self {
        let first = [flat.outward(simd, one), flat.outward(simd, two), flat.outward(simd, three)];
        Self { centre: flat.centre, first }
    }
}

impl<S: Simd> Stances<S> for SixSided<S> {
    #[cfg_attr(optimized, inline(always))]
    fn vertex(&self, simd: S, number: usize, _: &SectionPoint) -> [S::Floats; VERTEX] {
        let [outward, normal] = self.first[number % 3];
        let ([x, y, z], [normal_x, normal_y, normal_z]) = if number < 3 {
            (plus(self.centre, outward), normal)
        } else {
            (difference(self.centre, outward), difference([simd.splat(0.0); 3], normal))
        };
        [x, y, z, normal_x, normal_y, normal_z]
    }
}

/// Rings of a flattened yarn. Some of these rings are round.
pub(super) struct Mixed<'a, S: Simd, const FLATTENED: bool> {
    pub(super) flat: Flat<'a, S, FLATTENED, true, true>,
    pub(super) round: Round<'a, S, FLATTENED, SLOPED>,
}

impl<S: Simd, const FLATTENED: bool> Stances<S> for Mixed<'_, S, FLATTENED> {
    #[cfg_attr(optimized, inline(always))]
    fn vertex(&self, simd: S, number: usize, point: &SectionPoint) -> [S::Floats; VERTEX] {
        let (flat, round) = (self.flat.vertex(simd, number, point), self.flat.rings.round());
        let mut rows = self.round.vertex(simd, number, point);
        for (row, flat) in rows.iter_mut().zip(flat) {
            *row = round.select(*row, flat);
        }
        rows
    }
}
