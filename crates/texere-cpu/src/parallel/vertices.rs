//! Stage 2 in lanes: vertices of several rings at a time, a ring in each lane, then a transpose into place.

use texere_core::SectionPoint;

use super::rings::Rings;
use super::simd::{Floats, Mask, Simd};

/// Floats of a vertex: position and normal.
pub(super) const VERTEX: usize = 6;

/// Floats by which the stores of a ring may reach over its end.
pub(super) const OVERHANG: usize = 2;

/// A section's outline, and what of `Ring::vertex` its shape leaves to do.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface<'a> {
    outline: &'a [SectionPoint],
    /// Whether each normal is its point, as on a circle.
    round: bool,
}

impl<'a> Surface<'a> {
    pub(super) fn new(outline: &'a [SectionPoint]) -> Self {
        let round = outline.iter().all(|point| [point.x, point.y] == [point.normal_x, point.normal_y]);
        Self { outline, round }
    }

    /// Writes the vertices of `rings` to `out`: ring after ring or, of an even number of sides, as the `COLUMNS` that
    /// [`TileLines`](super::tiles::TileLines) wants.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn write<S: Simd, const FLATTENED: bool, const COLUMNS: bool>(
        &self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        out: &mut [f32],
    ) {
        if FLATTENED && rings.round().bits() == 0 {
            vertices::<S, FLATTENED, FLAT, COLUMNS>(simd, rings, self.outline, out);
        } else if FLATTENED {
            vertices::<S, FLATTENED, MIXED, COLUMNS>(simd, rings, self.outline, out);
        } else if rings.width_growth.is_zero().bits() != S::ALL {
            vertices::<S, FLATTENED, SLOPED, COLUMNS>(simd, rings, self.outline, out);
        } else if !self.round {
            vertices::<S, FLATTENED, PLAIN, COLUMNS>(simd, rings, self.outline, out);
        } else if let Some((outline, [])) = self.outline.split_first_chunk::<6>() {
            // The paper's tube has loops and strides known beforehand.
            vertices::<S, FLATTENED, ROUND, COLUMNS>(simd, rings, outline, out);
        } else {
            vertices::<S, FLATTENED, ROUND, COLUMNS>(simd, rings, self.outline, out);
        }
    }
}

/// The yarn is round, and its radius grows or shrinks, so that normals lean.
const SLOPED: u8 = 0;
/// It does not.
const PLAIN: u8 = 1;
/// Nor do the section's normals differ from its points.
const ROUND: u8 = 2;
/// All of the rings are flattened.
const FLAT: u8 = 3;
/// Some of them are.
const MIXED: u8 = 4;

#[cfg_attr(optimized, inline(always))]
fn vertices<S: Simd, const FLATTENED: bool, const KIND: u8, const COLUMNS: bool>(
    simd: S,
    rings: &Rings<S, FLATTENED>,
    outline: &[SectionPoint],
    out: &mut [f32],
) {
    if COLUMNS {
        columns::<S, FLATTENED, KIND>(simd, rings, outline, out);
    } else {
        scattered::<S, FLATTENED, KIND>(simd, rings, outline, out);
    }
}

/// All vertices of `rings` in columns. A column has the same four floats of every fourth ring; first come those of ring 0,
/// from its first floats to its last, then those of ring 1.
#[cfg_attr(optimized, inline(always))]
fn columns<S: Simd, const FLATTENED: bool, const KIND: u8>(
    simd: S,
    rings: &Rings<S, FLATTENED>,
    outline: &[SectionPoint],
    out: &mut [f32],
) {
    let (pairs, _) = outline.as_chunks::<2>();
    let quarters = 3 * pairs.len();
    let out = &mut out[..4 * quarters * S::LANES];
    for (number, [one, two]) in pairs.iter().enumerate() {
        let [a, b, c, d, e, f] = vertex::<S, FLATTENED, KIND>(simd, rings, one);
        let [g, h, i, j, k, l] = vertex::<S, FLATTENED, KIND>(simd, rings, two);
        for (part, rows) in [[a, b, c, d], [e, f, g, h], [i, j, k, l]].into_iter().enumerate() {
            for (ring, column) in simd.tiles(rows).into_iter().enumerate() {
                column.store(&mut out[(ring * quarters + 3 * number + part) * S::LANES..]);
            }
        }
    }
}

/// All vertices of `rings`, the last ones first: a store that reaches over the end of its ring is then followed by the next
/// ring's own.
#[cfg_attr(optimized, inline(always))]
fn scattered<S: Simd, const FLATTENED: bool, const KIND: u8>(
    simd: S,
    rings: &Rings<S, FLATTENED>,
    outline: &[SectionPoint],
    out: &mut [f32],
) {
    let stride = outline.len() * VERTEX;
    let out = &mut out[..S::LANES * stride + OVERHANG];
    let (fours, rest) = outline.as_chunks::<4>();
    let (twos, last) = rest.as_chunks::<2>();
    if let [point] = last {
        let out = &mut out[(outline.len() - 1) * VERTEX..];
        let [a, b, c, d, e, f] = vertex::<S, FLATTENED, KIND>(simd, rings, point);
        let zero = simd.splat(0.0);
        simd.scatter_eight([a, b, c, d, e, f, zero, zero], out, stride);
    }
    if let [[one, two]] = twos {
        let out = &mut out[fours.len() * 4 * VERTEX..];
        let [a, b, c, d, e, f] = vertex::<S, FLATTENED, KIND>(simd, rings, one);
        let [g, h, i, j, k, l] = vertex::<S, FLATTENED, KIND>(simd, rings, two);
        simd.scatter_eight([a, b, c, d, e, f, g, h], out, stride);
        simd.scatter([i, j, k, l], &mut out[8..], stride);
    }
    for (number, [one, two, three, four]) in fours.iter().enumerate().rev() {
        let out = &mut out[number * 4 * VERTEX..];
        let [a, b, c, d, e, f] = vertex::<S, FLATTENED, KIND>(simd, rings, one);
        let [g, h, i, j, k, l] = vertex::<S, FLATTENED, KIND>(simd, rings, two);
        simd.scatter_eight([a, b, c, d, e, f, g, h], out, stride);
        let [a, b, c, d, e, f] = vertex::<S, FLATTENED, KIND>(simd, rings, three);
        simd.scatter_eight([i, j, k, l, a, b, c, d], &mut out[8..], stride);
        let [g, h, i, j, k, l] = vertex::<S, FLATTENED, KIND>(simd, rings, four);
        simd.scatter_eight([e, f, g, h, i, j, k, l], &mut out[16..], stride);
    }
}

/// A vertex of each of `rings`: rows of x, y, z and of the normal's, a ring in each lane.
#[cfg_attr(optimized, inline(always))]
fn vertex<S: Simd, const FLATTENED: bool, const KIND: u8>(
    simd: S,
    rings: &Rings<S, FLATTENED>,
    point: &SectionPoint,
) -> [S::Floats; VERTEX] {
    if KIND == FLAT {
        return flattened_vertex(simd, rings, point);
    }
    if KIND != MIXED {
        return round_vertex::<S, FLATTENED, KIND>(simd, rings, point);
    }
    let (flat, round) = (flattened_vertex(simd, rings, point), rings.round());
    let mut rows = round_vertex::<S, FLATTENED, SLOPED>(simd, rings, point);
    for (row, flat) in rows.iter_mut().zip(flat) {
        *row = round.select(*row, flat);
    }
    rows
}

/// That of a flattened yarn.
#[cfg_attr(optimized, inline(always))]
fn flattened_vertex<S: Simd, const FLATTENED: bool>(
    simd: S,
    rings: &Rings<S, FLATTENED>,
    point: &SectionPoint,
) -> [S::Floats; VERTEX] {
    let (sin, cos) = rings.roll;
    let (x, y) = (simd.splat(point.x), simd.splat(point.y));
    let (x, y) = (cos * x - sin * y, sin * x + cos * y);
    let (normal_x, normal_y) = (simd.splat(point.normal_x), simd.splat(point.normal_y));
    let (normal_x, normal_y) = (cos * normal_x - sin * normal_y, sin * normal_x + cos * normal_y);
    let (across_x, across_y) = (normal_x * rings.half_height, normal_y * rings.half_width);
    let lean = rings.width_growth * x * across_x + rings.height_growth * y * across_y;
    let length_squared = across_x * across_x + across_y * across_y + lean * lean;
    let inverse = simd.splat(1.0) / length_squared.sqrt();
    let (x, y) = (x * rings.half_width, y * rings.half_height);
    let mut rows = [simd.splat(0.0); VERTEX];
    for axis in 0..3 {
        let across = rings.side[axis] * across_x + rings.up[axis] * across_y;
        rows[axis] = rings.centre[axis] + (rings.side[axis] * x + rings.up[axis] * y);
        rows[3 + axis] = (across - rings.tangent[axis] * lean) * inverse;
    }
    rows
}

/// That of a round yarn.
#[cfg_attr(optimized, inline(always))]
fn round_vertex<S: Simd, const FLATTENED: bool, const KIND: u8>(
    simd: S,
    rings: &Rings<S, FLATTENED>,
    point: &SectionPoint,
) -> [S::Floats; VERTEX] {
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
