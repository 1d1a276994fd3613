//! Pairs of chords in lanes: the nearest image of the second chord, and the places where the two
//! chords come nearest to one another. An image is a copy of the chord in some repeat of the cloth.

use texere_core::settling::{PARALLEL, SHORT, SettlingPlan};

use super::tables::ChordRow;
use crate::parallel::simd::{
    Floats, Integers, Mask, Simd, between, difference, dot, plus, rounded, scale, share, to_bits, to_floats,
};

/// A vector of chords.
#[derive(Clone, Copy)]
pub(super) struct Chords<S: Simd> {
    at: [S::Integers; 3],
    pub(super) span: [S::Floats; 3],
    /// The largest half width or half height of each chord's interval, mm.
    pub(super) thickest: S::Floats,
}

impl<S: Simd> Chords<S> {
    /// The chords that `numbers` name.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, chords: &[ChordRow], numbers: &[u32]) -> Self {
        let chords: &[[[f32; 4]; 2]] = bytemuck::cast_slice(chords);
        let [x, y, z, _] = simd.rows(chords, numbers, 0);
        let [dx, dy, dz, thickest] = simd.rows(chords, numbers, 1);
        Self { at: to_bits([x, y, z]), span: [dx, dy, dz], thickest }
    }

    /// One chord in all lanes.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn splat(simd: S, ChordRow([[x, y, z, _], [dx, dy, dz, thickest]]): &ChordRow) -> Self {
        Self {
            at: to_bits([simd.splat(*x), simd.splat(*y), simd.splat(*z)]),
            span: [simd.splat(*dx), simd.splat(*dy), simd.splat(*dz)],
            thickest: simd.splat(*thickest),
        }
    }

    /// The middles of the chords, units.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn middle(&self, simd: S, unit: f32) -> [S::Integers; 3] {
        let [dx, dy, dz] = rounded(simd, scale(self.span, simd.splat(0.5 / unit)));
        [self.at[0] + dx, self.at[1] + dy, self.at[2] + dz]
    }
}

/// The places where pairs of chords come nearest to one another.
#[derive(Clone, Copy)]
pub(super) struct Nearest<S: Simd> {
    /// The places, as shares of their chords.
    pub(super) shares: [S::Floats; 2],
    /// The way from the first chord's place to the second's, mm.
    pub(super) apart: [S::Floats; 3],
    /// Minus the number of repeats to the image of the second chord, along x and along y.
    pub(super) image: [S::Floats; 2],
}

impl<S: Simd> Nearest<S> {
    /// `Chord::nearest` of the core, for the nearest image of the second chord.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, images: &Images<S>, one: &Chords<S>, other: &Chords<S>) -> Self {
        let (half, short) = (simd.splat(0.5), simd.splat(SHORT));
        let (d, e) = (one.span, other.span);
        let (way, image) = images.nearest(between(one.at, other.at), scale(difference(e, d), half));
        let between = scale(to_floats(way), images.unit);
        let (a, c) = (dot(d, d).max(short), -dot(d, between));
        let (e2, f) = (dot(e, e).max(short), -dot(e, between));
        let b = dot(d, e);
        let determinant = a * e2 - b * b;
        let slanted = (simd.splat(PARALLEL) * (a * e2)).less(determinant);
        let s = slanted.select(share(simd, (b * f - c * e2) / determinant), half);
        let t = share(simd, (b * s + f) / e2);
        let s = share(simd, (b * t - c) / a);
        Self { shares: [s, t], apart: difference(plus(between, scale(e, t)), scale(d, s)), image }
    }
}

/// Images in a cloth that repeats.
#[derive(Clone, Copy)]
pub(super) struct Images<S: Simd> {
    simd: S,
    /// Whether the cloth repeats along x or y.
    any: bool,
    period: [i32; 2],
    frequency: [S::Floats; 2],
    /// The unit of places, mm.
    pub(super) unit: S::Floats,
}

impl<S: Simd> Images<S> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, plan: &SettlingPlan) -> Self {
        let period = plan.period();
        Self {
            simd,
            any: period != [0; 2],
            period,
            frequency: [simd.splat(plan.frequency()[0]), simd.splat(plan.frequency()[1])],
            unit: simd.splat(plan.scale().unit()),
        }
    }

    /// The vector to the nearest image, and minus the number of repeats to it. `way` is the vector
    /// between one point of each chord. `middles`, mm, is what has to be added to `way` to get the
    /// vector between the middles of both chords. The nearest image is the one whose middle is
    /// nearest. `middles` is not added to the vector that is returned.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn nearest(
        &self,
        way: [S::Integers; 3],
        middles: [S::Floats; 3],
    ) -> ([S::Integers; 3], [S::Floats; 2]) {
        if !self.any {
            return (way, [self.simd.splat(0.0); 2]);
        }
        let half = self.simd.splat(0.5);
        let image = [
            ((way[0].signed_to_floats() * self.unit + middles[0]) * self.frequency[0] + half).floor(),
            ((way[1].signed_to_floats() * self.unit + middles[1]) * self.frequency[1] + half).floor(),
        ];
        (self.moved(way, image), image)
    }

    /// The vector to an image. `image` is minus the number of repeats to it.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn moved(&self, [x, y, z]: [S::Integers; 3], image: [S::Floats; 2]) -> [S::Integers; 3] {
        if !self.any {
            return [x, y, z];
        }
        let [width, height] = self.period;
        [
            x - image[0].to_signed().times(width.cast_unsigned()),
            y - image[1].to_signed().times(height.cast_unsigned()),
            z,
        ]
    }
}
