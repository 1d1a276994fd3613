//! Stage 2 in lanes: the vertices of several rings at a time, with a ring in each lane. They are
//! then transposed into place.

use texere_core::SectionPoint;

use super::rings::Rings;
use super::simd::{Floats, Mask, Simd};
use super::stances::{Flat, Mixed, PLAIN, ROUND, Round, SLOPED, SixSided, Stances, VERTEX};

/// The number of floats by which the stores of a ring may reach over its end.
pub(super) const OVERHANG: usize = 2;

/// A section's outline, and the properties of its shape that let [`Stances::vertex`] leave out
/// terms of the core's `Ring::vertex`.
#[derive(Debug, Clone)]
pub(super) struct Surface<'a> {
    outline: &'a [SectionPoint],
    /// Whether each normal equals its point, as on a circle.
    round: bool,
    /// Whether each point of the first half, with its normal, is the negative of the opposite
    /// point.
    opposed: bool,
}

impl<'a> Surface<'a> {
    pub(super) fn new(outline: &'a [SectionPoint]) -> Self {
        let round = outline.iter().all(|point| [point.x, point.y] == [point.normal_x, point.normal_y]);
        let (first, second) = outline.split_at(outline.len() / 2);
        let opposed = first.iter().zip(second).all(|(one, other)| {
            let SectionPoint { x, y, normal_x, normal_y } = *other;
            *one == SectionPoint { x: -x, y: -y, normal_x: -normal_x, normal_y: -normal_y }
        });
        Self { outline, round, opposed }
    }

    /// Writes the vertices of `rings` to `out`. With `COLUMNS`, which needs an even number of
    /// sides, they are written as the columns of [`TileLines`](super::tiles::TileLines). Otherwise
    /// they are written ring after ring.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn write<S: Simd, const FLATTENED: bool, const COLUMNS: bool>(
        &self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        rolled: bool,
        out: &mut [f32],
    ) {
        if FLATTENED {
            self.write_flattened::<S, FLATTENED, COLUMNS>(simd, rings, rolled, out);
        } else if rings.width_growth.is_zero().bits() != S::ALL {
            vertices::<S, _, COLUMNS>(simd, &Round::<S, FLATTENED, SLOPED>(rings), self.outline, out);
        } else if !self.round {
            vertices::<S, _, COLUMNS>(simd, &Round::<S, FLATTENED, PLAIN>(rings), self.outline, out);
        } else if let Some((outline, [])) = self.outline.split_first_chunk::<6>() {
            // The length of `outline` is a constant here, so the compiler knows the lengths of
            // loops and the strides.
            vertices::<S, _, COLUMNS>(simd, &Round::<S, FLATTENED, ROUND>(rings), outline, out);
        } else {
            vertices::<S, _, COLUMNS>(simd, &Round::<S, FLATTENED, ROUND>(rings), self.outline, out);
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn write_flattened<S: Simd, const FLATTENED: bool, const COLUMNS: bool>(
        &self,
        simd: S,
        rings: &Rings<S, FLATTENED>,
        rolled: bool,
        out: &mut [f32],
    ) {
        if rings.round().bits() != 0 {
            let flat = Flat::<S, FLATTENED, true, true>::new(simd, rings);
            vertices::<S, _, COLUMNS>(simd, &Mixed { flat, round: Round(rings) }, self.outline, out);
        } else if rings.steady().bits() != S::ALL {
            if rolled {
                let flat = Flat::<S, FLATTENED, true, true>::new(simd, rings);
                vertices::<S, _, COLUMNS>(simd, &flat, self.outline, out);
            } else {
                let flat = Flat::<S, FLATTENED, false, true>::new(simd, rings);
                vertices::<S, _, COLUMNS>(simd, &flat, self.outline, out);
            }
        } else if let Some((outline, [])) = self.outline.split_first_chunk::<6>()
            && self.opposed
        {
            let six = if rolled {
                SixSided::new(simd, &Flat::<S, FLATTENED, true, false>::new(simd, rings), outline)
            } else {
                SixSided::new(simd, &Flat::<S, FLATTENED, false, false>::new(simd, rings), outline)
            };
            vertices::<S, _, COLUMNS>(simd, &six, outline, out);
        } else if rolled {
            let flat = Flat::<S, FLATTENED, true, false>::new(simd, rings);
            vertices::<S, _, COLUMNS>(simd, &flat, self.outline, out);
        } else {
            let flat = Flat::<S, FLATTENED, false, false>::new(simd, rings);
            vertices::<S, _, COLUMNS>(simd, &flat, self.outline, out);
        }
    }
}

#[cfg_attr(optimized, inline(always))]
fn vertices<S: Simd, V: Stances<S>, const COLUMNS: bool>(
    simd: S,
    stances: &V,
    outline: &[SectionPoint],
    out: &mut [f32],
) {
    if COLUMNS {
        columns(simd, stances, outline, out);
    } else {
        scattered(simd, stances, outline, out);
    }
}

/// Writes all vertices of a vector of rings in columns. Column number p of ring r, for r from 0 to
/// 3, holds floats 4p to 4p + 3 of the rings r, r + 4, r + 8 and so on, one ring after the other.
/// First come all columns of ring 0, then those of rings 1, 2 and 3.
#[cfg_attr(optimized, inline(always))]
fn columns<S: Simd, V: Stances<S>>(simd: S, stances: &V, outline: &[SectionPoint], out: &mut [f32]) {
    let (pairs, _) = outline.as_chunks::<2>();
    let quarters = 3 * pairs.len();
    let out = &mut out[..4 * quarters * S::LANES];
    for (number, [one, two]) in pairs.iter().enumerate() {
        let [a, b, c, d, e, f] = stances.vertex(simd, 2 * number, one);
        let [g, h, i, j, k, l] = stances.vertex(simd, 2 * number + 1, two);
        for (part, rows) in [[a, b, c, d], [e, f, g, h], [i, j, k, l]].into_iter().enumerate() {
            for (ring, column) in simd.tiles(rows).into_iter().enumerate() {
                column.store(&mut out[(ring * quarters + 3 * number + part) * S::LANES..]);
            }
        }
    }
}

/// Writes all vertices of a vector of rings, so that `out` holds one ring after the other. The last
/// vertices of the rings are written first. Floats that a store writes past the end of its ring are
/// overwritten later by the first vertices of the next ring. After the last ring, `out` has room
/// for them.
#[cfg_attr(optimized, inline(always))]
fn scattered<S: Simd, V: Stances<S>>(simd: S, stances: &V, outline: &[SectionPoint], out: &mut [f32]) {
    let stride = outline.len() * VERTEX;
    let out = &mut out[..S::LANES * stride + OVERHANG];
    let (fours, rest) = outline.as_chunks::<4>();
    let (twos, last) = rest.as_chunks::<2>();
    if let [point] = last {
        let out = &mut out[(outline.len() - 1) * VERTEX..];
        let [a, b, c, d, e, f] = stances.vertex(simd, outline.len() - 1, point);
        let zero = simd.splat(0.0);
        simd.scatter_eight([a, b, c, d, e, f, zero, zero], out, stride);
    }
    if let [[one, two]] = twos {
        let first = fours.len() * 4;
        let out = &mut out[first * VERTEX..];
        let [a, b, c, d, e, f] = stances.vertex(simd, first, one);
        let [g, h, i, j, k, l] = stances.vertex(simd, first + 1, two);
        simd.scatter_eight([a, b, c, d, e, f, g, h], out, stride);
        simd.scatter([i, j, k, l], &mut out[8..], stride);
    }
    for (number, [one, two, three, four]) in fours.iter().enumerate().rev() {
        let first = number * 4;
        let out = &mut out[first * VERTEX..];
        let [a, b, c, d, e, f] = stances.vertex(simd, first, one);
        let [g, h, i, j, k, l] = stances.vertex(simd, first + 1, two);
        simd.scatter_eight([a, b, c, d, e, f, g, h], out, stride);
        let [a, b, c, d, e, f] = stances.vertex(simd, first + 2, three);
        simd.scatter_eight([i, j, k, l, a, b, c, d], &mut out[8..], stride);
        let [g, h, i, j, k, l] = stances.vertex(simd, first + 3, four);
        simd.scatter_eight([e, f, g, h, i, j, k, l], &mut out[16..], stride);
    }
}
