//! Eight lanes on x86-64 processors with AVX2.
#![allow(unsafe_code, reason = "vector instructions and streaming stores")]

use std::arch::x86_64::{
    __m256, __m256i, _CMP_EQ_OQ, _CMP_LT_OQ, _mm_loadu_ps, _mm_sfence, _mm_storeu_ps, _mm256_add_epi32,
    _mm256_add_ps, _mm256_alignr_epi8, _mm256_and_si256, _mm256_andnot_ps, _mm256_blend_epi32,
    _mm256_blendv_ps, _mm256_castps_si256, _mm256_castps256_ps128, _mm256_castsi256_ps, _mm256_cmp_ps,
    _mm256_cmpeq_epi32, _mm256_cvtepi32_ps, _mm256_cvtsi256_si32, _mm256_cvttps_epi32, _mm256_div_ps,
    _mm256_extractf128_ps, _mm256_floor_ps, _mm256_loadu_ps, _mm256_loadu_si256, _mm256_max_ps,
    _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps, _mm256_permute2f128_ps, _mm256_permute2x128_si256,
    _mm256_permutevar8x32_epi32, _mm256_permutevar8x32_ps, _mm256_set_m128, _mm256_set1_epi32,
    _mm256_set1_ps, _mm256_setzero_ps, _mm256_setzero_si256, _mm256_shuffle_epi32, _mm256_shuffle_ps,
    _mm256_slli_epi32, _mm256_slli_si256, _mm256_sqrt_ps, _mm256_srli_epi32, _mm256_storeu_ps,
    _mm256_storeu_si256, _mm256_stream_ps, _mm256_stream_si256, _mm256_sub_epi32, _mm256_sub_ps,
    _mm256_unpackhi_ps, _mm256_unpacklo_ps, _mm256_xor_ps,
};
use std::ops::{Add, Div, Mul, Sub};

use super::vector::{LINE, Line, Vector};

// SAFETY, for all blocks in this file: the instructions need AVX2, and `Path` calls code that is generic over vectors with
// this type only where the processor has it. What is said at a block is about its pointers.

#[derive(Debug, Clone, Copy)]
pub(super) struct Avx2(__m256);

impl Add for Avx2 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn add(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_add_ps(self.0, other.0) })
    }
}

impl Sub for Avx2 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn sub(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_sub_ps(self.0, other.0) })
    }
}

impl Mul for Avx2 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn mul(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_mul_ps(self.0, other.0) })
    }
}

impl Div for Avx2 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn div(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_div_ps(self.0, other.0) })
    }
}

/// Two points, one in each half.
#[cfg_attr(optimized, inline(always))]
fn pair(low: &[f32; 4], high: &[f32; 4]) -> __m256 {
    // SAFETY: each load reads four values, and need not be aligned.
    unsafe { _mm256_set_m128(_mm_loadu_ps(high.as_ptr()), _mm_loadu_ps(low.as_ptr())) }
}

impl Vector for Avx2 {
    const LANES: usize = 8;
    type Mask = __m256;
    type Whole = __m256i;

    #[cfg_attr(optimized, inline(always))]
    fn load(from: &[f32]) -> Self {
        let from = &from[..8];
        // SAFETY: eight values are there; the load need not be aligned.
        Self(unsafe { _mm256_loadu_ps(from.as_ptr()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..8];
        // SAFETY: eight places are there; the store need not be aligned.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat(value: f32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_set1_ps(value) })
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
    fn negate(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_xor_ps(_mm256_set1_ps(-0.0), self.0) })
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
    fn less(self, other: Self) -> __m256 {
        // SAFETY: no pointers.
        unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn is_zero(self) -> __m256 {
        // SAFETY: no pointers.
        unsafe { _mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, _mm256_setzero_ps()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn select(mask: __m256, yes: Self, no: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_blendv_ps(no.0, yes.0, mask) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn bits(mask: __m256) -> u32 {
        // SAFETY: no pointers.
        unsafe { _mm256_movemask_ps(mask) }.cast_unsigned()
    }

    #[cfg_attr(optimized, inline(always))]
    fn pick(from: Self, places: __m256i) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_permutevar8x32_ps(from.0, places) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn preceding(before: Self, here: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let (before, here) = (_mm256_castps_si256(before.0), _mm256_castps_si256(here.0));
            // The last half of the one and the first half of the other, from which each half gets its first lane.
            let middle = _mm256_permute2x128_si256::<0x21>(before, here);
            _mm256_castsi256_ps(_mm256_alignr_epi8::<12>(here, middle))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn preceding_four(before: Self, here: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_permute2f128_ps::<0x21>(before.0, here.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn components(points: &[[f32; 4]]) -> [Self; 4] {
        let points = &points[..8];
        let (a, b) = (pair(&points[0], &points[4]), pair(&points[1], &points[5]));
        let (c, d) = (pair(&points[2], &points[6]), pair(&points[3], &points[7]));
        Self::tiles([Self(a), Self(b), Self(c), Self(d)])
    }

    #[cfg_attr(optimized, inline(always))]
    fn tiles([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        // SAFETY: no pointers.
        unsafe {
            let (low_ab, high_ab) = (_mm256_unpacklo_ps(a.0, b.0), _mm256_unpackhi_ps(a.0, b.0));
            let (low_cd, high_cd) = (_mm256_unpacklo_ps(c.0, d.0), _mm256_unpackhi_ps(c.0, d.0));
            [
                Self(_mm256_shuffle_ps::<0x44>(low_ab, low_cd)),
                Self(_mm256_shuffle_ps::<0xee>(low_ab, low_cd)),
                Self(_mm256_shuffle_ps::<0x44>(high_ab, high_cd)),
                Self(_mm256_shuffle_ps::<0xee>(high_ab, high_cd)),
            ]
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn arrange<const STREAM: bool>(columns: &[f32], lines: &mut [Line]) {
        let (first, last) = lines.split_at_mut(lines.len() / 2);
        for ((four, first), last) in columns.chunks_exact(4 * Self::LANES).zip(first).zip(last) {
            let (a, b) = (Self::load(four), Self::load(&four[8..]));
            let (c, d) = (Self::load(&four[16..]), Self::load(&four[24..]));
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
    fn scatter(rows: [Self; 4], out: &mut [f32], stride: usize) {
        let out = &mut out[..7 * stride + 4];
        let to = out.as_mut_ptr();
        // SAFETY: lane l is stored at l * stride, and the last of them ends where `out` does; stores need not be aligned.
        unsafe {
            let half = to.add(4 * stride);
            for (lane, Self(column)) in Self::tiles(rows).into_iter().enumerate() {
                _mm_storeu_ps(to.add(lane * stride), _mm256_castps256_ps128(column));
                _mm_storeu_ps(half.add(lane * stride), _mm256_extractf128_ps::<1>(column));
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter_eight(rows: [Self; 8], out: &mut [f32], stride: usize) {
        let out = &mut out[..7 * stride + 8];
        let to = out.as_mut_ptr();
        let [a, b, c, d, e, f, g, h] = rows;
        let (low, high) = (Self::tiles([a, b, c, d]), Self::tiles([e, f, g, h]));
        // SAFETY: lane l is stored at l * stride, and the last of them ends where `out` does; stores need not be aligned.
        unsafe {
            for (lane, (Self(low), Self(high))) in low.into_iter().zip(high).enumerate() {
                let (first, second) =
                    (_mm256_permute2f128_ps::<0x20>(low, high), _mm256_permute2f128_ps::<0x31>(low, high));
                _mm256_storeu_ps(to.add(lane * stride), first);
                _mm256_storeu_ps(to.add((lane + 4) * stride), second);
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn load_whole(from: &[u32]) -> __m256i {
        let from = &from[..8];
        // SAFETY: eight values are there; the load need not be aligned.
        unsafe { _mm256_loadu_si256(from.as_ptr().cast()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn store_whole(values: __m256i, to: &mut [u32]) {
        let to = &mut to[..8];
        // SAFETY: eight places are there; the store need not be aligned.
        unsafe { _mm256_storeu_si256(to.as_mut_ptr().cast(), values) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_whole(value: u32) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_set1_epi32(value.cast_signed()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn add_whole(a: __m256i, b: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_add_epi32(a, b) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn sub_whole(a: __m256i, b: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_sub_epi32(a, b) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn first(a: __m256i) -> u32 {
        // SAFETY: no pointers.
        unsafe { _mm256_cvtsi256_si32(a) }.cast_unsigned()
    }

    #[cfg_attr(optimized, inline(always))]
    fn without_first(a: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_blend_epi32::<1>(a, _mm256_setzero_si256()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn running_sum(a: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe {
            let a = _mm256_add_epi32(a, _mm256_slli_si256::<4>(a));
            let a = _mm256_add_epi32(a, _mm256_slli_si256::<8>(a));
            // Each half has its own sums; the second lacks the last one of the first.
            let first = _mm256_permute2x128_si256::<0x08>(a, a);
            _mm256_add_epi32(a, _mm256_shuffle_epi32::<0xff>(first))
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_last(a: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_permutevar8x32_epi32(a, _mm256_set1_epi32(7)) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_left<const BY: i32>(a: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_slli_epi32::<BY>(a) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right<const BY: i32>(a: __m256i) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_srli_epi32::<BY>(a) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn has_bit(a: __m256i, bit: u32) -> __m256 {
        let bit = Self::splat_whole(bit);
        // SAFETY: no pointers.
        unsafe { _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(a, bit), bit)) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn from_signed(a: __m256i) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_cvtepi32_ps(a) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn from_bits(a: __m256i) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_castsi256_ps(a) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_signed(self) -> __m256i {
        // SAFETY: no pointers.
        unsafe { _mm256_cvttps_epi32(self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream(from: &[f32; LINE], to: &mut Line) {
        let to = to.0.as_mut_ptr();
        // SAFETY: a line is two aligned vectors; loads need not be aligned.
        unsafe {
            _mm256_stream_ps(to, _mm256_loadu_ps(from.as_ptr()));
            _mm256_stream_ps(to.add(8), _mm256_loadu_ps(from.as_ptr().add(8)));
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream_indices(table: &[u32; LINE], base: Self::Whole, to: &mut Line) {
        let to = to.0.as_mut_ptr();
        let (first, second) = (Self::load_whole(table), Self::load_whole(&table[8..]));
        // SAFETY: a line is two aligned vectors.
        unsafe {
            _mm256_stream_si256(to.cast(), _mm256_add_epi32(base, first));
            _mm256_stream_si256(to.add(8).cast(), _mm256_add_epi32(base, second));
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn fence() {
        // SAFETY: no pointers.
        unsafe { _mm_sfence() }
    }
}
