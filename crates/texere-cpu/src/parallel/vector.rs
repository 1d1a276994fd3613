//! Vectors of `f32`, one implementation for each kind of processor.

/// What stage 2 needs of a vector.
///
/// Arithmetic is plain IEEE, lane by lane, without fused multiply-add, so that every implementation gives the same bits.
/// The methods of an implementation may be called only on a processor that has its instructions: generic code is reached
/// by way of [`Path`](super::path::Path) alone, which has asked.
pub(super) trait Vector: Copy {
    /// Lanes: a power of two, at most 8.
    const LANES: usize;

    /// The first `LANES` values of a slice.
    fn load(from: &[f32]) -> Self;

    /// One value in all lanes.
    fn splat(value: f32) -> Self;

    /// `self + other`
    fn add(self, other: Self) -> Self;

    /// `self - other`
    fn sub(self, other: Self) -> Self;

    /// `self * other`
    fn mul(self, other: Self) -> Self;

    /// `1 / √self`, by a division and a root that are rounded correctly.
    fn inverse_root(self) -> Self;

    /// `here` in the lanes where `self` is zero, `elsewhere` in the others.
    fn where_zero(self, here: Self, elsewhere: Self) -> Self;

    /// Stores lane l of row r, of `LANES` rows, at `out[l * stride + r]`.
    fn scatter(rows: &[Self], out: &mut [f32], stride: usize);

    /// Copies past the caches, where the processor can: for outputs that no cache would hold anyway. Only a
    /// [`Vector::fence`] makes the copy sure to be seen by other threads.
    fn stream(from: &[f32], to: &mut [f32]);

    /// Writes `base + table[start + i]` to `out[i]`, past the caches where the processor can; from `period` on the table
    /// goes on from its start with `base` grown by `growth`. `table` has a vector's lanes more than `period`, and `period`
    /// is a multiple of them.
    fn stream_pattern(table: &[u32], period: usize, growth: u32, base: u32, out: &mut [u32]);

    /// Ends streaming: what was written is there for other threads.
    fn fence();
}

/// Four lanes in plain Rust, which the compiler turns into whatever vectors there are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portable([f32; 4]);

impl Portable {
    #[inline(always)]
    fn each(f: impl Fn(usize) -> f32) -> Self {
        Self([f(0), f(1), f(2), f(3)])
    }
}

impl Vector for Portable {
    const LANES: usize = 4;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        Self([from[0], from[1], from[2], from[3]])
    }

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::each(|lane| self.0[lane] + other.0[lane])
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::each(|lane| self.0[lane] - other.0[lane])
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::each(|lane| self.0[lane] * other.0[lane])
    }

    #[inline(always)]
    fn inverse_root(self) -> Self {
        Self::each(|lane| 1.0 / self.0[lane].sqrt())
    }

    #[inline(always)]
    fn where_zero(self, here: Self, elsewhere: Self) -> Self {
        Self::each(|lane| if self.0[lane] == 0.0 { here.0[lane] } else { elsewhere.0[lane] })
    }

    #[inline(always)]
    fn scatter(rows: &[Self], out: &mut [f32], stride: usize) {
        for lane in 0..4 {
            let place = &mut out[lane * stride..][..4];
            place.copy_from_slice(&Self::each(|row| rows[row].0[lane]).0);
        }
    }

    #[inline(always)]
    fn stream(from: &[f32], to: &mut [f32]) {
        to.copy_from_slice(from);
    }

    #[inline(always)]
    fn stream_pattern(table: &[u32], period: usize, growth: u32, mut base: u32, out: &mut [u32]) {
        for stretch in out.chunks_mut(period) {
            for (index, offset) in stretch.iter_mut().zip(table) {
                *index = base + offset;
            }
            base += growth;
        }
    }

    #[inline(always)]
    fn fence() {}
}
