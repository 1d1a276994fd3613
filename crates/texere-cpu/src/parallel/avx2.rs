//! Eight lanes on x86-64 processors with AVX2.
#![allow(unsafe_code, reason = "vector instructions and streaming stores")]

use std::arch::x86_64::{
    __m256, __m256i, _CMP_EQ_OQ, _CMP_LT_OQ, _mm_loadu_ps, _mm_sfence, _mm_storeu_ps, _mm256_add_epi32,
    _mm256_add_ps, _mm256_alignr_epi8, _mm256_and_si256, _mm256_andnot_ps, _mm256_blend_epi32,
    _mm256_blendv_ps, _mm256_castps_si256, _mm256_castps256_ps128, _mm256_castsi256_ps, _mm256_cmp_ps,
    _mm256_cmpeq_epi32, _mm256_cvtepi32_ps, _mm256_cvtsi256_si32, _mm256_cvttps_epi32, _mm256_div_ps,
    _mm256_extractf128_ps, _mm256_floor_ps, _mm256_loadu_ps, _mm256_loadu_si256, _mm256_max_ps,
    _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps, _mm256_mullo_epi32, _mm256_permute2f128_ps,
    _mm256_permute2x128_si256, _mm256_permutevar8x32_epi32, _mm256_permutevar8x32_ps, _mm256_set_m128,
    _mm256_set1_epi32, _mm256_set1_ps, _mm256_setzero_ps, _mm256_setzero_si256, _mm256_shuffle_epi32,
    _mm256_shuffle_ps, _mm256_slli_epi32, _mm256_slli_si256, _mm256_sqrt_ps, _mm256_srai_epi32,
    _mm256_srli_epi32, _mm256_storeu_ps, _mm256_storeu_si256, _mm256_stream_ps, _mm256_stream_si256,
    _mm256_sub_epi32, _mm256_sub_ps, _mm256_unpackhi_ps, _mm256_unpacklo_ps, _mm256_xor_ps,
};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::simd::{Floats, Integers, Job, LINE, Line, Mask, Simd};

// SAFETY, for all blocks in this file: the instructions need AVX2. An `Avx2` proves that the
// processor has it, since `detect` alone makes one. A vector or a mask proves it too, since it is
// made with an `Avx2` or from another vector or mask. Their fields are private, and nothing outside
// this file makes one. The comment at each block is about its pointers alone.

/// Proof that the processor has AVX2.
#[derive(Debug, Clone, Copy)]
pub(super) struct Avx2(());

impl Avx2 {
    pub(super) fn detect() -> Option<Self> {
        is_x86_feature_detected!("avx2").then_some(Self(()))
    }

    /// A vector of two points, one in each half.
    #[cfg_attr(optimized, inline(always))]
    fn pair(self, low: &[f32; 4], high: &[f32; 4]) -> F32x8 {
        // SAFETY: each load reads four values, and need not be aligned.
        F32x8(unsafe { _mm256_set_m128(_mm_loadu_ps(high.as_ptr()), _mm_loadu_ps(low.as_ptr())) })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct F32x8(__m256);

#[derive(Debug, Clone, Copy)]
pub(super) struct U32x8(__m256i);

#[derive(Debug, Clone, Copy)]
pub(super) struct Mask8(__m256);

/// Implements an operator of two vectors by its instruction.
macro_rules! operator {
    ($vector:ty, $operator:ident, $method:ident, $instruction:ident) => {
        impl $operator for $vector {
            type Output = Self;
            #[cfg_attr(optimized, inline(always))]
            fn $method(self, other: Self) -> Self {
                // SAFETY: no pointers.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

operator!(F32x8, Add, add, _mm256_add_ps);
operator!(F32x8, Sub, sub, _mm256_sub_ps);
operator!(F32x8, Mul, mul, _mm256_mul_ps);
operator!(F32x8, Div, div, _mm256_div_ps);
operator!(U32x8, Add, add, _mm256_add_epi32);
operator!(U32x8, Sub, sub, _mm256_sub_epi32);

impl Neg for F32x8 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn neg(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_xor_ps(_mm256_set1_ps(-0.0), self.0) })
    }
}

impl Simd for Avx2 {
    const LANES: usize = 8;
    type Floats = F32x8;
    type Integers = U32x8;
    type Mask = Mask8;

    fn run(self, job: impl Job) {
        #[inline(never)]
        #[target_feature(enable = "avx2")]
        fn with_avx2(simd: Avx2, job: impl Job) {
            job.run(simd);
        }
        // SAFETY: no pointers.
        unsafe { with_avx2(self, job) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat(self, value: f32) -> F32x8 {
        // SAFETY: no pointers.
        F32x8(unsafe { _mm256_set1_ps(value) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn load(self, from: &[f32]) -> F32x8 {
        let from = &from[..8];
        // SAFETY: eight values are there; the load need not be aligned.
        F32x8(unsafe { _mm256_loadu_ps(from.as_ptr()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_integer(self, value: u32) -> U32x8 {
        // SAFETY: no pointers.
        U32x8(unsafe { _mm256_set1_epi32(value.cast_signed()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn load_integers(self, from: &[u32]) -> U32x8 {
        let from = &from[..8];
        // SAFETY: eight values are there; the load need not be aligned.
        U32x8(unsafe { _mm256_loadu_si256(from.as_ptr().cast()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn components(self, points: &[[f32; 4]]) -> [F32x8; 4] {
        let points = &points[..8];
        let (a, b) = (self.pair(&points[0], &points[4]), self.pair(&points[1], &points[5]));
        let (c, d) = (self.pair(&points[2], &points[6]), self.pair(&points[3], &points[7]));
        self.tiles([a, b, c, d])
    }

    #[cfg_attr(optimized, inline(always))]
    fn rows<const ROWS: usize>(self, table: &[[[f32; 4]; ROWS]], numbers: &[u32], row: usize) -> [F32x8; 4] {
        let numbers = &numbers[..8];
        let mut columns = [self.splat(0.0); 4];
        for (lane, column) in columns.iter_mut().enumerate() {
            let [low, high] = [numbers[lane] as usize, numbers[lane + 4] as usize];
            *column = self.pair(&table[low][row], &table[high][row]);
        }
        self.tiles(columns)
    }

    #[cfg_attr(optimized, inline(always))]
    fn tiles(self, [a, b, c, d]: [F32x8; 4]) -> [F32x8; 4] {
        // SAFETY: no pointers.
        unsafe {
            let (low_ab, high_ab) = (_mm256_unpacklo_ps(a.0, b.0), _mm256_unpackhi_ps(a.0, b.0));
            let (low_cd, high_cd) = (_mm256_unpacklo_ps(c.0, d.0), _mm256_unpackhi_ps(c.0, d.0));
            [
                F32x8(_mm256_shuffle_ps::<0x44>(low_ab, low_cd)),
                F32x8(_mm256_shuffle_ps::<0xee>(low_ab, low_cd)),
                F32x8(_mm256_shuffle_ps::<0x44>(high_ab, high_cd)),
                F32x8(_mm256_shuffle_ps::<0xee>(high_ab, high_cd)),
            ]
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn arrange<const STREAM: bool>(self, columns: &[f32], lines: &mut [Line]) {
        let (first, last) = lines.split_at_mut(lines.len() / 2);
        for ((four, first), last) in columns.chunks_exact(4 * Self::LANES).zip(first).zip(last) {
            let (a, b) = (self.load(four), self.load(&four[8..]));
            let (c, d) = (self.load(&four[16..]), self.load(&four[24..]));
            let (first, last) = (first.0.as_mut_ptr(), last.0.as_mut_ptr());
            // SAFETY: a line is two aligned vectors.
            unsafe {
                for (to, half) in [
                    (first, _mm256_permute2f128_ps::<0x20>(a.0, b.0)),
                    (first.add(8), _mm256_permute2f128_ps::<0x20>(c.0, d.0)),
                    (last, _mm256_permute2f128_ps::<0x31>(a.0, b.0)),
                    (last.add(8), _mm256_permute2f128_ps::<0x31>(c.0, d.0)),
                ] {
                    if STREAM { _mm256_stream_ps(to, half) } else { _mm256_storeu_ps(to, half) }
                }
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter(self, rows: [F32x8; 4], out: &mut [f32], stride: usize) {
        let out = &mut out[..7 * stride + 4];
        let to = out.as_mut_ptr();
        // SAFETY: lane l is stored at l * stride, and the last lane ends where `out` does. Stores
        // need not be aligned.
        unsafe {
            let half = to.add(4 * stride);
            for (lane, F32x8(column)) in self.tiles(rows).into_iter().enumerate() {
                _mm_storeu_ps(to.add(lane * stride), _mm256_castps256_ps128(column));
                _mm_storeu_ps(half.add(lane * stride), _mm256_extractf128_ps::<1>(column));
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter_eight(self, rows: [F32x8; 8], out: &mut [f32], stride: usize) {
        let out = &mut out[..7 * stride + 8];
        let to = out.as_mut_ptr();
        let [a, b, c, d, e, f, g, h] = rows;
        let (low, high) = (self.tiles([a, b, c, d]), self.tiles([e, f, g, h]));
        // SAFETY: lane l is stored at l * stride, and the last lane ends where `out` does. Stores
        // need not be aligned.
        unsafe {
            for (lane, (F32x8(low), F32x8(high))) in low.into_iter().zip(high).enumerate() {
                let (first, second) =
                    (_mm256_permute2f128_ps::<0x20>(low, high), _mm256_permute2f128_ps::<0x31>(low, high));
                _mm256_storeu_ps(to.add(lane * stride), first);
                _mm256_storeu_ps(to.add((lane + 4) * stride), second);
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream(self, from: &[f32; LINE], to: &mut Line) {
        let to = to.0.as_mut_ptr();
        // SAFETY: a line is two aligned vectors; loads need not be aligned.
        unsafe {
            _mm256_stream_ps(to, _mm256_loadu_ps(from.as_ptr()));
            _mm256_stream_ps(to.add(8), _mm256_loadu_ps(from.as_ptr().add(8)));
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream_indices(self, table: &[u32; LINE], base: U32x8, to: &mut Line) {
        let to = to.0.as_mut_ptr();
        let (first, second) = (self.load_integers(table), self.load_integers(&table[8..]));
        // SAFETY: a line is two aligned vectors.
        unsafe {
            _mm256_stream_si256(to.cast(), (base + first).0);
            _mm256_stream_si256(to.add(8).cast(), (base + second).0);
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn fence(self) {
        // SAFETY: no pointers.
        unsafe { _mm_sfence() }
    }
}

impl Floats for F32x8 {
    type Integers = U32x8;
    type Mask = Mask8;

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..8];
        // SAFETY: eight places are there; the store need not be aligned.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn sqrt(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn floor(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_floor_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn abs(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn min(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn max(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn less(self, other: Self) -> Mask8 {
        // SAFETY: no pointers.
        Mask8(unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn is_zero(self) -> Mask8 {
        // SAFETY: no pointers.
        Mask8(unsafe { _mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, _mm256_setzero_ps()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn permute(self, places: U32x8) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_permutevar8x32_ps(self.0, places.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_in(self, before: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let (before, here) = (_mm256_castps_si256(before.0), _mm256_castps_si256(self.0));
            // The last half of `before` and the first half of `here`. The last lane of each half of
            // this vector becomes the first lane of the same half of the result.
            let middle = _mm256_permute2x128_si256::<0x21>(before, here);
            _mm256_castsi256_ps(_mm256_alignr_epi8::<12>(here, middle))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_in_four(self, before: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_permute2f128_ps::<0x21>(before.0, self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_signed(self) -> U32x8 {
        // SAFETY: no pointers.
        U32x8(unsafe { _mm256_cvttps_epi32(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_bits(self) -> U32x8 {
        // SAFETY: no pointers.
        U32x8(unsafe { _mm256_castps_si256(self.0) })
    }
}

impl Integers for U32x8 {
    type Floats = F32x8;
    type Mask = Mask8;

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [u32]) {
        let to = &mut to[..8];
        // SAFETY: eight places are there; the store need not be aligned.
        unsafe { _mm256_storeu_si256(to.as_mut_ptr().cast(), self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn first(self) -> u32 {
        // SAFETY: no pointers.
        unsafe { _mm256_cvtsi256_si32(self.0) }.cast_unsigned()
    }

    #[cfg_attr(optimized, inline(always))]
    fn without_first(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_blend_epi32::<1>(self.0, _mm256_setzero_si256()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn running_sum(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let a = self.0;
            let a = _mm256_add_epi32(a, _mm256_slli_si256::<4>(a));
            let a = _mm256_add_epi32(a, _mm256_slli_si256::<8>(a));
            // Each half has its own sums. The sums of the second half still lack the last sum of
            // the first half.
            let first = _mm256_permute2x128_si256::<0x08>(a, a);
            _mm256_add_epi32(a, _mm256_shuffle_epi32::<0xff>(first))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_last(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_permutevar8x32_epi32(self.0, _mm256_set1_epi32(7)) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_left<const BY: i32>(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_slli_epi32::<BY>(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn times(self, factor: u32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_mullo_epi32(self.0, _mm256_set1_epi32(factor.cast_signed())) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right<const BY: i32>(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_srli_epi32::<BY>(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right_signed<const BY: i32>(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_srai_epi32::<BY>(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn masked(self, mask: u32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_and_si256(self.0, _mm256_set1_epi32(mask.cast_signed())) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn has_bit(self, bit: u32) -> Mask8 {
        // SAFETY: no pointers.
        Mask8(unsafe {
            let bit = _mm256_set1_epi32(bit.cast_signed());
            _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(self.0, bit), bit))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn signed_to_floats(self) -> F32x8 {
        // SAFETY: no pointers.
        F32x8(unsafe { _mm256_cvtepi32_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn bit_cast(self) -> F32x8 {
        // SAFETY: no pointers.
        F32x8(unsafe { _mm256_castsi256_ps(self.0) })
    }
}

impl Mask for Mask8 {
    type Floats = F32x8;

    #[cfg_attr(optimized, inline(always))]
    fn select(self, yes: F32x8, no: F32x8) -> F32x8 {
        // SAFETY: no pointers.
        F32x8(unsafe { _mm256_blendv_ps(no.0, yes.0, self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn bits(self) -> u32 {
        // SAFETY: no pointers.
        unsafe { _mm256_movemask_ps(self.0) }.cast_unsigned()
    }
}
