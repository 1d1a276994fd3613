//! Vectors of `f32` and of `u32`, one implementation for each set of vector instructions.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use bytemuck::{Pod, Zeroable};

/// The number of floats of a cache line.
pub(super) const LINE: usize = 16;

/// A cache line of the output: the least that can be written past the caches without being read
/// first.
#[repr(C, align(64))]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Line(pub(super) [f32; LINE]);

/// The most lanes that an implementation has.
pub(super) const LANES_MAX: usize = 16;

/// The numbers of consecutive entries, for [`Simd::rows`].
pub(super) const IN_TURN: [u32; LANES_MAX] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// A set of vector instructions, and proof that the processor has it.
///
/// If not every processor has the set, only the implementation's own detection makes a value of the
/// type. Vectors and masks are made with such a value or from other vectors. They too are proof
/// that the processor has the set, so all methods are safe to call. The values of the type have no
/// size, so it takes no time to pass them on.
///
/// Arithmetic is plain IEEE, lane by lane, without fused multiply-add, so that every implementation
/// gives the same bits.
pub(super) trait Simd: Copy + Debug + Send + Sync {
    /// The number of lanes of a vector: a power of two, from 4 to [`LANES_MAX`].
    const LANES: usize;

    /// The bits of a mask that is set in all lanes.
    const ALL: u32 = (1 << Self::LANES) - 1;

    /// `LANES` values of `f32`.
    type Floats: Floats<Integers = Self::Integers, Mask = Self::Mask>;

    /// `LANES` values of `u32`.
    type Integers: Integers<Floats = Self::Floats, Mask = Self::Mask>;

    /// The mask with as many lanes.
    type Mask: Mask<Floats = Self::Floats>;

    /// Runs `job` as a function of its own, which is compiled for these instructions.
    fn run(self, job: impl Job);

    /// One value in all lanes.
    fn splat(self, value: f32) -> Self::Floats;

    /// The first `LANES` values of a slice.
    fn load(self, from: &[f32]) -> Self::Floats;

    /// One value in all lanes.
    fn splat_integer(self, value: u32) -> Self::Integers;

    /// The first `LANES` values of a slice.
    fn load_integers(self, from: &[u32]) -> Self::Integers;

    /// The four components of `LANES` points.
    fn components(self, points: &[[f32; 4]]) -> [Self::Floats; 4];

    /// Row `row` of each of the first `LANES` entries that `numbers` name, as four components.
    fn rows<const ROWS: usize>(
        self,
        table: &[[[f32; 4]; ROWS]],
        numbers: &[u32],
        row: usize,
    ) -> [Self::Floats; 4];

    /// Tiles of four by four values, transposed: lane 4j + c of column q is lane 4j + q of row c.
    fn tiles(self, rows: [Self::Floats; 4]) -> [Self::Floats; 4];

    /// Makes lines from columns. With n lines for every four lanes, line jn + i becomes lanes 4j to
    /// 4j + 3 of columns 4i to 4i + 3. With `STREAM` the lines go past the caches, if the processor
    /// can do so.
    fn arrange<const STREAM: bool>(self, columns: &[f32], lines: &mut [Line]);

    /// Stores lane l of row r at `out[l * stride + r]`.
    fn scatter(self, rows: [Self::Floats; 4], out: &mut [f32], stride: usize);

    /// Stores lane l of row r at `out[l * stride + r]`, for eight rows.
    #[cfg_attr(optimized, inline(always))]
    fn scatter_eight(self, [a, b, c, d, e, f, g, h]: [Self::Floats; 8], out: &mut [f32], stride: usize) {
        self.scatter([a, b, c, d], out, stride);
        self.scatter([e, f, g, h], &mut out[4..], stride);
    }

    /// Copies a line past the caches, if the processor can do so. Other threads are sure to see the
    /// copy only after a [`Simd::fence`].
    fn stream(self, from: &[f32; LINE], to: &mut Line);

    /// Writes the line `base + table[i]` past the caches, if the processor can do so. `base` is the
    /// same in all lanes.
    fn stream_indices(self, table: &[u32; LINE], base: Self::Integers, to: &mut Line);

    /// Ends streaming: other threads then see what was written.
    fn fence(self);
}

/// Work that is written once for all sets of vector instructions.
pub(super) trait Job {
    /// Does the work. The function must be inlined, so that it is compiled for the instructions of
    /// `simd`.
    fn run<S: Simd>(self, simd: S);
}

/// A vector of `f32`.
pub(super) trait Floats:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The vector of `u32` with as many lanes.
    type Integers;

    /// The mask with as many lanes.
    type Mask;

    /// Writes the lanes to the first places of a slice.
    fn store(self, to: &mut [f32]);

    /// The square root, rounded correctly.
    fn sqrt(self) -> Self;

    /// The largest whole number that is not above the value.
    fn floor(self) -> Self;

    /// The value without its sign.
    fn abs(self) -> Self;

    /// The smaller one; neither is NaN.
    fn min(self, other: Self) -> Self;

    /// The larger one; neither is NaN.
    fn max(self, other: Self) -> Self;

    /// `self < other`
    fn less(self, other: Self) -> Self::Mask;

    /// `self == 0`
    fn is_zero(self) -> Self::Mask;

    /// Lane l takes the value of lane `places[l]`; places are below the number of lanes.
    fn permute(self, places: Self::Integers) -> Self;

    /// Lane l takes the value of lane l - 1; the first lane takes that of the last lane of
    /// `before`.
    fn shift_in(self, before: Self) -> Self;

    /// Lane l takes the value of lane l - 4; the first four lanes take those of the last four of
    /// `before`.
    fn shift_in_four(self, before: Self) -> Self;

    /// The lanes converted to `i32`. They must be whole numbers within its range.
    fn to_signed(self) -> Self::Integers;

    /// The bits of the lanes.
    fn to_bits(self) -> Self::Integers;
}

/// A vector of `u32`; sums and differences wrap.
pub(super) trait Integers: Copy + Debug + Add<Output = Self> + Sub<Output = Self> {
    /// The vector of `f32` with as many lanes.
    type Floats;

    /// The mask with as many lanes.
    type Mask;

    /// Writes the lanes to the first places of a slice.
    fn store(self, to: &mut [u32]);

    /// The first lane.
    fn first(self) -> u32;

    /// This vector with 0 in the first lane.
    fn without_first(self) -> Self;

    /// Each lane becomes the sum of itself and all lanes before it.
    fn running_sum(self) -> Self;

    /// The last lane in all lanes.
    fn splat_last(self) -> Self;

    /// `self << BY`
    fn shift_left<const BY: i32>(self) -> Self;

    /// `self * factor`, the lowest 32 bits of it.
    fn times(self, factor: u32) -> Self;

    /// `self >> BY`
    fn shift_right<const BY: i32>(self) -> Self;

    /// `self >> BY` of lanes read as `i32`, which shifts in copies of the sign.
    fn shift_right_signed<const BY: i32>(self) -> Self;

    /// `self & mask`
    fn masked(self, mask: u32) -> Self;

    /// `self & bit != 0`, where `bit` is one bit.
    fn has_bit(self, bit: u32) -> Self::Mask;

    /// The nearest floats to lanes read as `i32`.
    fn signed_to_floats(self) -> Self::Floats;

    /// The floats that have the lanes' bits.
    fn bit_cast(self) -> Self::Floats;
}

/// A mask: yes or no for each lane of a vector.
pub(super) trait Mask: Copy + Debug {
    /// The vector of `f32` with as many lanes.
    type Floats;

    /// `yes` in lanes where the mask is set, else `no`.
    fn select(self, yes: Self::Floats, no: Self::Floats) -> Self::Floats;

    /// A bit for each lane. The lowest bit belongs to the first lane.
    fn bits(self) -> u32;
}

/// The dot product, added up in the order of `Vec3::dot`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn dot<F: Floats>(a: [F; 3], b: [F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `v * factor`
#[cfg_attr(optimized, inline(always))]
pub(super) fn scale<F: Floats>(v: [F; 3], factor: F) -> [F; 3] {
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

/// `a + b`
#[cfg_attr(optimized, inline(always))]
pub(super) fn plus<F: Floats>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a - b`
#[cfg_attr(optimized, inline(always))]
pub(super) fn difference<F: Floats>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The bits of three vectors.
#[cfg_attr(optimized, inline(always))]
pub(super) fn to_bits<F: Floats>([x, y, z]: [F; 3]) -> [F::Integers; 3] {
    [x.to_bits(), y.to_bits(), z.to_bits()]
}

/// The floats that have the bits of three vectors.
#[cfg_attr(optimized, inline(always))]
pub(super) fn bit_cast<I: Integers>([x, y, z]: [I; 3]) -> [I::Floats; 3] {
    [x.bit_cast(), y.bit_cast(), z.bit_cast()]
}

/// The nearest floats to lanes read as `i32`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn to_floats<I: Integers>([x, y, z]: [I; 3]) -> [I::Floats; 3] {
    [x.signed_to_floats(), y.signed_to_floats(), z.signed_to_floats()]
}

/// `to - from`
#[cfg_attr(optimized, inline(always))]
pub(super) fn between<I: Integers>(from: [I; 3], to: [I; 3]) -> [I; 3] {
    [to[0] - from[0], to[1] - from[1], to[2] - from[2]]
}

/// `value`, limited to 0 to 1.
#[cfg_attr(optimized, inline(always))]
pub(super) fn share<S: Simd>(simd: S, value: S::Floats) -> S::Floats {
    value.max(simd.splat(0.0)).min(simd.splat(1.0))
}

/// The nearest whole numbers. If two are equally near, the larger is taken.
#[cfg_attr(optimized, inline(always))]
pub(super) fn rounded<S: Simd>(simd: S, [x, y, z]: [S::Floats; 3]) -> [S::Integers; 3] {
    let half = simd.splat(0.5);
    [(x + half).floor().to_signed(), (y + half).floor().to_signed(), (z + half).floor().to_signed()]
}

/// The least value of all lanes.
#[cfg_attr(optimized, inline(always))]
pub(super) fn least<S: Simd>(values: S::Floats) -> f32 {
    let mut lanes = [f32::INFINITY; LANES_MAX];
    values.store(&mut lanes);
    let mut width = S::LANES / 2;
    while width > 0 {
        let (low, high) = lanes.split_at_mut(width);
        for (low, high) in low.iter_mut().zip(high) {
            *low = low.min(*high);
        }
        width /= 2;
    }
    lanes[0]
}

/// The bits of a mask whose first `count` lanes are set.
#[cfg_attr(optimized, inline(always))]
pub(super) fn first<S: Simd>(count: usize) -> u32 {
    if count < S::LANES { (1 << count) - 1 } else { S::ALL }
}

/// `yes` in lanes where `mask` is set, else `no`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn select<M: Mask<Floats: Copy>>(
    mask: M,
    yes: [M::Floats; 3],
    no: [M::Floats; 3],
) -> [M::Floats; 3] {
    [mask.select(yes[0], no[0]), mask.select(yes[1], no[1]), mask.select(yes[2], no[2])]
}
