//! How sections stand on rings, in lanes: `Ring::vertex` of the core for a vector of rings.

use texere_core::SectionPoint;

use super::rings::Rings;
use super::simd::{Floats, Mask, Simd, difference, plus, scale, select};
use super::vertices::VERTEX;

/// A vector of rings with what all their vertices share.
pub(super) trait Stances<S: Simd> {
    /// The vertex of each ring at `point`, which is number `number` of the outline: rows of x, y, z and of the normal's, a ring
    /// in each lane.
    fn vertex(&self, simd: S, number: usize, point: &SectionPoint) -> [S::Floats; VERTEX];
}

/// The radius of round yarns grows or shrinks, so that normals lean.
pub(super) const SLOPED: u8 = 0;
/// It does not.
pub(super) const PLAIN: u8 = 1;
/// Nor do the section's normals differ from its points.
pub(super) const ROUND: u8 = 2;

/// Of round yarns.
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

/// Of flattened yarns. Without `ROLLED` they have no roll, and the outline is unrolled already; without `LEANING` neither half
/// grows.
pub(super) struct Flat<'a, S: Simd, const FLATTENED: bool, const ROLLED: bool, const LEANING: bool> {
    rings: &'a Rings<S, FLATTENED>,
    /// The upright frame times the halves, and times each other's half: what points go out by, and normals.
    outward: Level<S>,
    across: Level<S>,
    /// The squares of half height and half width.
    squares: [S::Floats; 2],
    /// The growth of each half times the other half.
    growths: [S::Floats; 2],
    /// Which of them don't grow.
    steady: S::Mask,
}

impl<'a, S: Simd, const FLATTENED: bool, const ROLLED: bool, const LEANING: bool>
    Flat<'a, S, FLATTENED, ROLLED, LEANING>
{
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(rings: &'a Rings<S, FLATTENED>) -> Self {
        let (side, up, wide, high) = (rings.side, rings.up, rings.half_width, rings.half_height);
        Self {
            rings,
            outward: Level { side: [side[0] * wide, side[1] * wide], up: scale(up, high) },
            across: Level { side: [side[0] * high, side[1] * high], up: scale(up, wide) },
            squares: [high * high, wide * wide],
            growths: [rings.width_growth * high, rings.height_growth * wide],
            steady: rings.steady(),
        }
    }

    /// The vertex at `point`, with how much its normal leans and one over the normal's length.
    #[cfg_attr(optimized, inline(always))]
    fn vertex_with(
        &self,
        simd: S,
        point: &SectionPoint,
        lean: S::Floats,
        inverse: S::Floats,
    ) -> [S::Floats; VERTEX] {
        let [x, y] = self.rolled(simd, point.x, point.y);
        let [normal_x, normal_y] = self.rolled(simd, point.normal_x, point.normal_y);
        let ([x, y, z], mut normal) =
            (plus(self.rings.centre, self.outward.at(x, y)), self.across.at(normal_x, normal_y));
        if LEANING {
            normal = select(self.steady, normal, difference(normal, scale(self.rings.tangent, lean)));
        }
        let [normal_x, normal_y, normal_z] = scale(normal, inverse);
        [x, y, z, normal_x, normal_y, normal_z]
    }

    #[cfg_attr(optimized, inline(always))]
    fn lean(&self, simd: S, point: &SectionPoint) -> S::Floats {
        let [x, y] = self.rolled(simd, point.x, point.y);
        let [normal_x, normal_y] = self.rolled(simd, point.normal_x, point.normal_y);
        self.growths[0] * (x * normal_x) + self.growths[1] * (y * normal_y)
    }

    #[cfg_attr(optimized, inline(always))]
    fn inverse_length(&self, simd: S, point: &SectionPoint, lean: S::Floats) -> S::Floats {
        let [normal_x, normal_y] = self.rolled(simd, point.normal_x, point.normal_y);
        let squared = (normal_x * normal_x) * self.squares[0] + (normal_y * normal_y) * self.squares[1];
        let squared = if LEANING { squared + lean * lean } else { squared };
        simd.splat(1.0) / squared.sqrt()
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
        let lean = if LEANING { self.lean(simd, point) } else { simd.splat(0.0) };
        let inverse = self.inverse_length(simd, point, lean);
        self.vertex_with(simd, point, lean, inverse)
    }
}

/// Of flattened yarns whose halves don't grow, with six sides, where opposite normals are as long as each other.
pub(super) struct SixSided<'a, S: Simd, const FLATTENED: bool, const ROLLED: bool> {
    flat: Flat<'a, S, FLATTENED, ROLLED, false>,
    /// One over the length of the first three normals.
    inverses: [S::Floats; 3],
}

impl<'a, S: Simd, const FLATTENED: bool, const ROLLED: bool> SixSided<'a, S, FLATTENED, ROLLED> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, rings: &'a Rings<S, FLATTENED>, outline: &[SectionPoint; 6]) -> Self {
        let (flat, zero) = (Flat::<S, FLATTENED, ROLLED, false>::new(rings), simd.splat(0.0));
        let inverse = |number: usize| flat.inverse_length(simd, &outline[number], zero);
        Self { inverses: [inverse(0), inverse(1), inverse(2)], flat }
    }
}

impl<S: Simd, const FLATTENED: bool, const ROLLED: bool> Stances<S> for SixSided<'_, S, FLATTENED, ROLLED> {
    #[cfg_attr(optimized, inline(always))]
    fn vertex(&self, simd: S, number: usize, point: &SectionPoint) -> [S::Floats; VERTEX] {
        self.flat.vertex_with(simd, point, simd.splat(0.0), self.inverses[number % 3])
    }
}

/// A frame whose side is level, in some length.
struct Level<S: Simd> {
    side: [S::Floats; 2],
    up: [S::Floats; 3],
}

impl<S: Simd> Level<S> {
    #[cfg_attr(optimized, inline(always))]
    fn at(&self, x: S::Floats, y: S::Floats) -> [S::Floats; 3] {
        let Self { side, up } = self;
        [side[0] * x + up[0] * y, side[1] * x + up[1] * y, up[2] * y]
    }
}

/// Some are of round yarns.
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
