//! Vectors of `f32` and of `u32`, one implementation for each kind of processor.

use std::ops::{Add, Div, Mul, Sub};

use bytemuck::{Pod, Zeroable};

/// Floats of a cache line.
pub(super) const LINE: usize = 16;

/// A cache line of the output: what can be written past the caches without a read before it.
#[repr(C, align(64))]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Line(pub(super) [f32; LINE]);

/// The most lanes that an implementation has.
pub(super) const LANES_MAX: usize = 16;

/// What the stages need of a vector.
///
/// Arithmetic is plain IEEE, lane by lane, without fused multiply-add, so that every implementation gives the same bits.
/// The methods of an implementation may be called only on a processor that has its instructions: generic code is reached
/// by way of [`Path`](super::path::Path) alone, which has asked.
pub(super) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Lanes: a power of two, from 4 to [`LANES_MAX`].
    const LANES: usize;

    /// The bits of a mask that says yes in all lanes.
    const ALL: u32 = (1 << Self::LANES) - 1;

    /// Yes or no in each lane.
    type Mask: Copy;

    /// As many lanes of `u32`.
    type Whole: Copy;

    /// The first `LANES` values of a slice.
    fn load(from: &[f32]) -> Self;

    /// Writes the lanes to the first `LANES` places of a slice.
    fn store(self, to: &mut [f32]);

    /// One value in all lanes.
    fn splat(value: f32) -> Self;

    /// The root, rounded correctly.
    fn sqrt(self) -> Self;

    /// The next whole number below.
    fn floor(self) -> Self;

    /// The value without its sign.
    fn abs(self) -> Self;

    /// The value with its sign turned over.
    fn negate(self) -> Self;

    /// The smaller one; neither is NaN.
    fn min(self, other: Self) -> Self;

    /// The larger one; neither is NaN.
    fn max(self, other: Self) -> Self;

    /// `self < other`
    fn less(self, other: Self) -> Self::Mask;

    /// `self == 0`
    fn is_zero(self) -> Self::Mask;

    /// `yes` where `mask` says so, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// A bit for each lane, the first lane's lowest.
    fn bits(mask: Self::Mask) -> u32;

    /// Lane l is lane `places[l]` of `from`; places are below `LANES`.
    fn pick(from: Self, places: Self::Whole) -> Self;

    /// Lane l is lane l - 1 of `here`, the first one the last of `before`.
    fn preceding(before: Self, here: Self) -> Self;

    /// The same by four lanes.
    fn preceding_four(before: Self, here: Self) -> Self;

    /// The four components of `LANES` points.
    fn components(points: &[[f32; 4]]) -> [Self; 4];

    /// Tiles of four by four values, transposed: lane 4j + c of column q is lane 4j + q of row c.
    fn tiles(rows: [Self; 4]) -> [Self; 4];

    /// Makes lines of columns: with n lines for every four lanes, line jn + i becomes lanes 4j to 4j + 3 of columns 4i to
    /// 4i + 3. They go past the caches if `STREAM` says so and the processor can.
    fn arrange<const STREAM: bool>(columns: &[f32], lines: &mut [Line]);

    /// Stores lane l of row r at `out[l * stride + r]`.
    fn scatter(rows: [Self; 4], out: &mut [f32], stride: usize);

    /// The same with eight rows.
    #[cfg_attr(optimized, inline(always))]
    fn scatter_eight([a, b, c, d, e, f, g, h]: [Self; 8], out: &mut [f32], stride: usize) {
        Self::scatter([a, b, c, d], out, stride);
        Self::scatter([e, f, g, h], &mut out[4..], stride);
    }

    /// The first `LANES` values of a slice.
    fn load_whole(from: &[u32]) -> Self::Whole;

    /// Writes the lanes to the first `LANES` places of a slice.
    fn store_whole(values: Self::Whole, to: &mut [u32]);

    /// One value in all lanes.
    fn splat_whole(value: u32) -> Self::Whole;

    /// `a + b`, wrapping.
    fn add_whole(a: Self::Whole, b: Self::Whole) -> Self::Whole;

    /// `a - b`, wrapping.
    fn sub_whole(a: Self::Whole, b: Self::Whole) -> Self::Whole;

    /// The first lane.
    fn first(a: Self::Whole) -> u32;

    /// `a`, but 0 in the first lane.
    fn without_first(a: Self::Whole) -> Self::Whole;

    /// Each lane and those before it, added up, wrapping.
    fn running_sum(a: Self::Whole) -> Self::Whole;

    /// The last lane in all lanes.
    fn splat_last(a: Self::Whole) -> Self::Whole;

    /// `a << BY`
    fn shift_left<const BY: i32>(a: Self::Whole) -> Self::Whole;

    /// `a >> BY`
    fn shift_right<const BY: i32>(a: Self::Whole) -> Self::Whole;

    /// `a & bit != 0`
    fn has_bit(a: Self::Whole, bit: u32) -> Self::Mask;

    /// The nearest floats to lanes taken as `i32`.
    fn from_signed(a: Self::Whole) -> Self;

    /// The floats that have the lanes' bits.
    fn from_bits(a: Self::Whole) -> Self;

    /// Whole numbers within the range of `i32`.
    fn to_signed(self) -> Self::Whole;

    /// Copies a line past the caches, where the processor can: for outputs that no cache would hold anyway. Only a
    /// [`Vector::fence`] makes the copy sure to be seen by other threads.
    fn stream(from: &[f32; LINE], to: &mut Line);

    /// Writes the line `base + table[i]`, `base` the same in all lanes, past the caches where the processor can.
    fn stream_indices(table: &[u32; LINE], base: Self::Whole, to: &mut Line);

    /// Ends streaming: what was written is there for other threads.
    fn fence();
}

/// Dot product, added up in the order of `Vec3::dot`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn dot<V: Vector>(a: [V; 3], b: [V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `v * factor`
#[cfg_attr(optimized, inline(always))]
pub(super) fn scale<V: Vector>(v: [V; 3], factor: V) -> [V; 3] {
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

/// `a + b`
#[cfg_attr(optimized, inline(always))]
pub(super) fn plus<V: Vector>(a: [V; 3], b: [V; 3]) -> [V; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a - b`
#[cfg_attr(optimized, inline(always))]
pub(super) fn difference<V: Vector>(a: [V; 3], b: [V; 3]) -> [V; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `yes` where `mask` says so, else `no`.
#[cfg_attr(optimized, inline(always))]
pub(super) fn select<V: Vector>(mask: V::Mask, yes: [V; 3], no: [V; 3]) -> [V; 3] {
    [V::select(mask, yes[0], no[0]), V::select(mask, yes[1], no[1]), V::select(mask, yes[2], no[2])]
}
