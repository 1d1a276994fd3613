//! Sixteen lanes, a line of the output each, on x86-64 processors with AVX-512.
#![allow(unsafe_code, reason = "vector instructions and streaming stores")]

use std::arch::x86_64::{
    __m512, __m512i, __mmask16, _CMP_EQ_OQ, _CMP_LT_OQ, _mm_sfence, _mm_storeu_ps, _mm256_storeu_ps,
    _mm512_abs_ps, _mm512_add_epi32, _mm512_add_ps, _mm512_alignr_epi32, _mm512_castps_si512,
    _mm512_castps512_ps256, _mm512_castsi512_ps, _mm512_cmp_ps_mask, _mm512_cvtepi32_ps,
    _mm512_cvtsi512_si32, _mm512_cvttps_epi32, _mm512_div_ps, _mm512_extractf32x4_ps, _mm512_extractf32x8_ps,
    _mm512_loadu_ps, _mm512_loadu_si512, _mm512_mask_blend_ps, _mm512_maskz_mov_epi32, _mm512_max_ps,
    _mm512_min_ps, _mm512_mul_ps, _mm512_permutex2var_ps, _mm512_permutexvar_epi32, _mm512_permutexvar_ps,
    _mm512_roundscale_ps, _mm512_set1_epi32, _mm512_set1_ps, _mm512_setr_epi32, _mm512_setzero_ps,
    _mm512_setzero_si512, _mm512_shuffle_f32x4, _mm512_shuffle_ps, _mm512_sllv_epi32, _mm512_sqrt_ps,
    _mm512_srlv_epi32, _mm512_storeu_ps, _mm512_storeu_si512, _mm512_stream_ps, _mm512_stream_si512,
    _mm512_sub_epi32, _mm512_sub_ps, _mm512_test_epi32_mask, _mm512_unpackhi_ps, _mm512_unpacklo_ps,
    _mm512_xor_si512,
};
use std::ops::{Add, Div, Mul, Sub};

use super::vector::{LINE, Line, Vector};

// SAFETY, for all blocks in this file: the instructions need AVX-512 F and DQ, and `Path` calls code that is generic over
// vectors with this type only where the processor has them. What is said at a block is about its pointers.

#[derive(Debug, Clone, Copy)]
pub(super) struct Avx512(__m512);

impl Add for Avx512 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn add(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_add_ps(self.0, other.0) })
    }
}

impl Sub for Avx512 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn sub(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_sub_ps(self.0, other.0) })
    }
}

impl Mul for Avx512 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn mul(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_mul_ps(self.0, other.0) })
    }
}

impl Div for Avx512 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn div(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_div_ps(self.0, other.0) })
    }
}

impl Vector for Avx512 {
    const LANES: usize = 16;
    type Mask = __mmask16;
    type Whole = __m512i;

    #[cfg_attr(optimized, inline(always))]
    fn load(from: &[f32]) -> Self {
        let from = &from[..16];
        // SAFETY: sixteen values are there; the load need not be aligned.
        Self(unsafe { _mm512_loadu_ps(from.as_ptr()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..16];
        // SAFETY: sixteen places are there; the store need not be aligned.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat(value: f32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_set1_ps(value) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn sqrt(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_sqrt_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn floor(self) -> Self {
        /// To no binary places, downwards, without exceptions.
        const DOWN: i32 = 0x09;
        // SAFETY: no pointers.
        Self(unsafe { _mm512_roundscale_ps::<DOWN>(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn abs(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_abs_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn negate(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let sign = _mm512_castps_si512(_mm512_set1_ps(-0.0));
            _mm512_castsi512_ps(_mm512_xor_si512(sign, _mm512_castps_si512(self.0)))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn min(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_min_ps(self.0, other.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn max(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_max_ps(self.0, other.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn less(self, other: Self) -> __mmask16 {
        // SAFETY: no pointers.
        unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn is_zero(self) -> __mmask16 {
        // SAFETY: no pointers.
        unsafe { _mm512_cmp_ps_mask::<_CMP_EQ_OQ>(self.0, _mm512_setzero_ps()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn select(mask: __mmask16, yes: Self, no: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_mask_blend_ps(mask, no.0, yes.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn bits(mask: __mmask16) -> u32 {
        mask.into()
    }

    #[cfg_attr(optimized, inline(always))]
    fn pick(from: Self, places: __m512i) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_permutexvar_ps(places, from.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn preceding(before: Self, here: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let (before, here) = (_mm512_castps_si512(before.0), _mm512_castps_si512(here.0));
            _mm512_castsi512_ps(_mm512_alignr_epi32::<15>(here, before))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn preceding_four(before: Self, here: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let (before, here) = (_mm512_castps_si512(before.0), _mm512_castps_si512(here.0));
            _mm512_castsi512_ps(_mm512_alignr_epi32::<12>(here, before))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn components(points: &[[f32; 4]]) -> [Self; 4] {
        let points = points[..16].as_flattened();
        let (a, b) = (Self::load(points), Self::load(&points[16..]));
        let (c, d) = (Self::load(&points[32..]), Self::load(&points[48..]));
        // Four of lanes 0, 4, 8 and 12 are the components of points 0 to 3: the order has to be turned, too.
        // SAFETY: no pointers.
        let order = unsafe { _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15) };
        let [x, y, z, w] = Self::tiles([a, b, c, d]);
        [Self::pick(x, order), Self::pick(y, order), Self::pick(z, order), Self::pick(w, order)]
    }

    #[cfg_attr(optimized, inline(always))]
    fn tiles([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        // SAFETY: no pointers.
        unsafe {
            let (low_ab, high_ab) = (_mm512_unpacklo_ps(a.0, b.0), _mm512_unpackhi_ps(a.0, b.0));
            let (low_cd, high_cd) = (_mm512_unpacklo_ps(c.0, d.0), _mm512_unpackhi_ps(c.0, d.0));
            [
                Self(_mm512_shuffle_ps::<0x44>(low_ab, low_cd)),
                Self(_mm512_shuffle_ps::<0xee>(low_ab, low_cd)),
                Self(_mm512_shuffle_ps::<0x44>(high_ab, high_cd)),
                Self(_mm512_shuffle_ps::<0xee>(high_ab, high_cd)),
            ]
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn arrange<const STREAM: bool>(columns: &[f32], lines: &mut [Line]) {
        let count = lines.len() / 4;
        let (first, others) = lines.split_at_mut(count);
        let (second, others) = others.split_at_mut(count);
        let (third, fourth) = others.split_at_mut(count);
        let lines = first.iter_mut().zip(second).zip(third).zip(fourth);
        for (four, (((first, second), third), fourth)) in columns.chunks_exact(4 * Self::LANES).zip(lines) {
            let (a, b) = (Self::load(four), Self::load(&four[16..]));
            let (c, d) = (Self::load(&four[32..]), Self::load(&four[48..]));
            // SAFETY: a line is an aligned vector.
            unsafe {
                let (low_ab, high_ab) =
                    (_mm512_shuffle_f32x4::<0x44>(a.0, b.0), _mm512_shuffle_f32x4::<0xee>(a.0, b.0));
                let (low_cd, high_cd) =
                    (_mm512_shuffle_f32x4::<0x44>(c.0, d.0), _mm512_shuffle_f32x4::<0xee>(c.0, d.0));
                for (to, line) in [
                    (first, _mm512_shuffle_f32x4::<0x88>(low_ab, low_cd)),
                    (second, _mm512_shuffle_f32x4::<0xdd>(low_ab, low_cd)),
                    (third, _mm512_shuffle_f32x4::<0x88>(high_ab, high_cd)),
                    (fourth, _mm512_shuffle_f32x4::<0xdd>(high_ab, high_cd)),
                ] {
                    let to = to.0.as_mut_ptr();
                    if STREAM { _mm512_stream_ps(to, line) } else { _mm512_storeu_ps(to, line) }
                }
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter(rows: [Self; 4], out: &mut [f32], stride: usize) {
        let out = &mut out[..15 * stride + 4];
        let to = out.as_mut_ptr();
        // SAFETY: lane l is stored at l * stride, and the last of them ends where `out` does; stores need not be aligned.
        unsafe {
            for (lane, Self(column)) in Self::tiles(rows).into_iter().enumerate() {
                _mm_storeu_ps(to.add(lane * stride), _mm512_extractf32x4_ps::<0>(column));
                _mm_storeu_ps(to.add((lane + 4) * stride), _mm512_extractf32x4_ps::<1>(column));
                _mm_storeu_ps(to.add((lane + 8) * stride), _mm512_extractf32x4_ps::<2>(column));
                _mm_storeu_ps(to.add((lane + 12) * stride), _mm512_extractf32x4_ps::<3>(column));
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter_eight([a, b, c, d, e, f, g, h]: [Self; 8], out: &mut [f32], stride: usize) {
        let out = &mut out[..15 * stride + 8];
        let to = out.as_mut_ptr();
        let (low, high) = (Self::tiles([a, b, c, d]), Self::tiles([e, f, g, h]));
        // SAFETY: lane l is stored at l * stride, and the last of them ends where `out` does; stores need not be aligned.
        unsafe {
            let first = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
            let last = _mm512_setr_epi32(8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31);
            for (lane, (Self(low), Self(high))) in low.into_iter().zip(high).enumerate() {
                let first = _mm512_permutex2var_ps(low, first, high);
                let last = _mm512_permutex2var_ps(low, last, high);
                _mm256_storeu_ps(to.add(lane * stride), _mm512_castps512_ps256(first));
                _mm256_storeu_ps(to.add((lane + 4) * stride), _mm512_extractf32x8_ps::<1>(first));
                _mm256_storeu_ps(to.add((lane + 8) * stride), _mm512_castps512_ps256(last));
                _mm256_storeu_ps(to.add((lane + 12) * stride), _mm512_extractf32x8_ps::<1>(last));
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn load_whole(from: &[u32]) -> __m512i {
        let from = &from[..16];
        // SAFETY: sixteen values are there; the load need not be aligned.
        unsafe { _mm512_loadu_si512(from.as_ptr().cast()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn store_whole(values: __m512i, to: &mut [u32]) {
        let to = &mut to[..16];
        // SAFETY: sixteen places are there; the store need not be aligned.
        unsafe { _mm512_storeu_si512(to.as_mut_ptr().cast(), values) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_whole(value: u32) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_set1_epi32(value.cast_signed()) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn add_whole(a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_add_epi32(a, b) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn sub_whole(a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_sub_epi32(a, b) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn first(a: __m512i) -> u32 {
        // SAFETY: no pointers.
        unsafe { _mm512_cvtsi512_si32(a) }.cast_unsigned()
    }

    #[cfg_attr(optimized, inline(always))]
    fn without_first(a: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_maskz_mov_epi32(0xfffe, a) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn running_sum(a: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe {
            let zero = _mm512_setzero_si512();
            let a = _mm512_add_epi32(a, _mm512_alignr_epi32::<15>(a, zero));
            let a = _mm512_add_epi32(a, _mm512_alignr_epi32::<14>(a, zero));
            let a = _mm512_add_epi32(a, _mm512_alignr_epi32::<12>(a, zero));
            _mm512_add_epi32(a, _mm512_alignr_epi32::<8>(a, zero))
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_last(a: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_permutexvar_epi32(_mm512_set1_epi32(15), a) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_left<const BY: i32>(a: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_sllv_epi32(a, _mm512_set1_epi32(BY)) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right<const BY: i32>(a: __m512i) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_srlv_epi32(a, _mm512_set1_epi32(BY)) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn has_bit(a: __m512i, bit: u32) -> __mmask16 {
        // SAFETY: no pointers.
        unsafe { _mm512_test_epi32_mask(a, Self::splat_whole(bit)) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn from_signed(a: __m512i) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_cvtepi32_ps(a) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn from_bits(a: __m512i) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_castsi512_ps(a) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_signed(self) -> __m512i {
        // SAFETY: no pointers.
        unsafe { _mm512_cvttps_epi32(self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream(from: &[f32; LINE], to: &mut Line) {
        // SAFETY: a line is an aligned vector; loads need not be aligned.
        unsafe { _mm512_stream_ps(to.0.as_mut_ptr(), _mm512_loadu_ps(from.as_ptr())) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream_indices(table: &[u32; LINE], base: Self::Whole, to: &mut Line) {
        let indices = Self::add_whole(base, Self::load_whole(table));
        // SAFETY: a line is an aligned vector.
        unsafe { _mm512_stream_si512(to.0.as_mut_ptr().cast(), indices) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn fence() {
        // SAFETY: no pointers.
        unsafe { _mm_sfence() }
    }
}
