//! Sixteen lanes, which fill one line of the output, on x86-64 processors with AVX-512.
#![allow(unsafe_code, reason = "vector instructions and streaming stores")]

use std::arch::x86_64::{
    __m512, __m512i, __mmask16, _CMP_EQ_OQ, _CMP_LT_OQ, _mm_loadu_ps, _mm_sfence, _mm_storeu_ps,
    _mm256_storeu_ps, _mm512_abs_ps, _mm512_add_epi32, _mm512_add_ps, _mm512_alignr_epi32, _mm512_and_si512,
    _mm512_castps_si512, _mm512_castps128_ps512, _mm512_castps512_ps256, _mm512_castsi512_ps,
    _mm512_cmp_ps_mask, _mm512_cvtepi32_ps, _mm512_cvtsi512_si32, _mm512_cvttps_epi32, _mm512_div_ps,
    _mm512_extractf32x4_ps, _mm512_extractf32x8_ps, _mm512_insertf32x4, _mm512_loadu_ps, _mm512_loadu_si512,
    _mm512_mask_blend_ps, _mm512_maskz_mov_epi32, _mm512_max_ps, _mm512_min_ps, _mm512_mul_ps,
    _mm512_mullo_epi32, _mm512_permutex2var_ps, _mm512_permutexvar_epi32, _mm512_permutexvar_ps,
    _mm512_roundscale_ps, _mm512_set1_epi32, _mm512_set1_ps, _mm512_setr_epi32, _mm512_setzero_ps,
    _mm512_setzero_si512, _mm512_shuffle_f32x4, _mm512_shuffle_ps, _mm512_sllv_epi32, _mm512_sqrt_ps,
    _mm512_srav_epi32, _mm512_srlv_epi32, _mm512_storeu_ps, _mm512_storeu_si512, _mm512_stream_ps,
    _mm512_stream_si512, _mm512_sub_epi32, _mm512_sub_ps, _mm512_test_epi32_mask, _mm512_unpackhi_ps,
    _mm512_unpacklo_ps, _mm512_xor_si512,
};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::simd::{Floats, Integers, Job, LINE, Line, Mask, Simd};

// SAFETY, for all blocks in this file: the instructions need AVX-512 F and DQ. An `Avx512` proves
// that the processor has them, since `detect` alone makes one. A vector or a mask proves it too,
// since it is made with an `Avx512` or from another vector or mask. Their fields are private, and
// nothing outside this file makes one. The comment at each block is about its pointers alone.

/// Proof that the processor has AVX-512, its parts F and DQ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Avx512(());

impl Avx512 {
    pub(super) fn detect() -> Option<Self> {
        (is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq")).then_some(Self(()))
    }

    /// A vector of four points, one in each quarter.
    #[cfg_attr(optimized, inline(always))]
    fn quarters(self, [a, b, c, d]: [&[f32; 4]; 4]) -> F32x16 {
        // SAFETY: each load reads four values, and need not be aligned.
        F32x16(unsafe {
            let first = _mm512_castps128_ps512(_mm_loadu_ps(a.as_ptr()));
            let first = _mm512_insertf32x4::<1>(first, _mm_loadu_ps(b.as_ptr()));
            let first = _mm512_insertf32x4::<2>(first, _mm_loadu_ps(c.as_ptr()));
            _mm512_insertf32x4::<3>(first, _mm_loadu_ps(d.as_ptr()))
        })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct F32x16(__m512);

#[derive(Debug, Clone, Copy)]
pub(super) struct U32x16(__m512i);

#[derive(Debug, Clone, Copy)]
pub(super) struct Mask16(__mmask16);

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

operator!(F32x16, Add, add, _mm512_add_ps);
operator!(F32x16, Sub, sub, _mm512_sub_ps);
operator!(F32x16, Mul, mul, _mm512_mul_ps);
operator!(F32x16, Div, div, _mm512_div_ps);
operator!(U32x16, Add, add, _mm512_add_epi32);
operator!(U32x16, Sub, sub, _mm512_sub_epi32);

impl Neg for F32x16 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn neg(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let sign = _mm512_castps_si512(_mm512_set1_ps(-0.0));
            _mm512_castsi512_ps(_mm512_xor_si512(sign, _mm512_castps_si512(self.0)))
        })
    }
}

impl Simd for Avx512 {
    const LANES: usize = 16;
    type Floats = F32x16;
    type Integers = U32x16;
    type Mask = Mask16;

    fn run(self, job: impl Job) {
        #[inline(never)]
        #[target_feature(enable = "avx512f,avx512dq")]
        fn with_avx512(simd: Avx512, job: impl Job) {
            job.run(simd);
        }
        // SAFETY: no pointers.
        unsafe { with_avx512(self, job) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat(self, value: f32) -> F32x16 {
        // SAFETY: no pointers.
        F32x16(unsafe { _mm512_set1_ps(value) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn load(self, from: &[f32]) -> F32x16 {
        let from = &from[..16];
        // SAFETY: sixteen values are there; the load need not be aligned.
        F32x16(unsafe { _mm512_loadu_ps(from.as_ptr()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_integer(self, value: u32) -> U32x16 {
        // SAFETY: no pointers.
        U32x16(unsafe { _mm512_set1_epi32(value.cast_signed()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn load_integers(self, from: &[u32]) -> U32x16 {
        let from = &from[..16];
        // SAFETY: sixteen values are there; the load need not be aligned.
        U32x16(unsafe { _mm512_loadu_si512(from.as_ptr().cast()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn components(self, points: &[[f32; 4]]) -> [F32x16; 4] {
        let points = points[..16].as_flattened();
        let (a, b) = (self.load(points), self.load(&points[16..]));
        let (c, d) = (self.load(&points[32..]), self.load(&points[48..]));
        // After `tiles` the components of points 0 to 3 are in lanes 0, 4, 8 and 12, and so on.
        // `order` sorts the lanes by point. SAFETY: no pointers.
        let order =
            U32x16(unsafe { _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15) });
        let [x, y, z, w] = self.tiles([a, b, c, d]);
        [x.permute(order), y.permute(order), z.permute(order), w.permute(order)]
    }

    #[cfg_attr(optimized, inline(always))]
    fn rows<const ROWS: usize>(self, table: &[[[f32; 4]; ROWS]], numbers: &[u32], row: usize) -> [F32x16; 4] {
        let numbers = &numbers[..16];
        let mut columns = [self.splat(0.0); 4];
        for (lane, column) in columns.iter_mut().enumerate() {
            let (a, b) = (&table[numbers[lane] as usize][row], &table[numbers[lane + 4] as usize][row]);
            let (c, d) = (&table[numbers[lane + 8] as usize][row], &table[numbers[lane + 12] as usize][row]);
            *column = self.quarters([a, b, c, d]);
        }
        self.tiles(columns)
    }

    #[cfg_attr(optimized, inline(always))]
    fn tiles(self, [a, b, c, d]: [F32x16; 4]) -> [F32x16; 4] {
        // SAFETY: no pointers.
        unsafe {
            let (low_ab, high_ab) = (_mm512_unpacklo_ps(a.0, b.0), _mm512_unpackhi_ps(a.0, b.0));
            let (low_cd, high_cd) = (_mm512_unpacklo_ps(c.0, d.0), _mm512_unpackhi_ps(c.0, d.0));
            [
                F32x16(_mm512_shuffle_ps::<0x44>(low_ab, low_cd)),
                F32x16(_mm512_shuffle_ps::<0xee>(low_ab, low_cd)),
                F32x16(_mm512_shuffle_ps::<0x44>(high_ab, high_cd)),
                F32x16(_mm512_shuffle_ps::<0xee>(high_ab, high_cd)),
            ]
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn arrange<const STREAM: bool>(self, columns: &[f32], lines: &mut [Line]) {
        let count = lines.len() / 4;
        let (first, others) = lines.split_at_mut(count);
        let (second, others) = others.split_at_mut(count);
        let (third, fourth) = others.split_at_mut(count);
        let lines = first.iter_mut().zip(second).zip(third).zip(fourth);
        for (four, (((first, second), third), fourth)) in columns.chunks_exact(4 * Self::LANES).zip(lines) {
            let (a, b) = (self.load(four), self.load(&four[16..]));
            let (c, d) = (self.load(&four[32..]), self.load(&four[48..]));
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
    fn scatter(self, rows: [F32x16; 4], out: &mut [f32], stride: usize) {
        let out = &mut out[..15 * stride + 4];
        let to = out.as_mut_ptr();
        // SAFETY: lane l is stored at l * stride, and the last lane ends where `out` does. Stores
        // need not be aligned.
        unsafe {
            for (lane, F32x16(column)) in self.tiles(rows).into_iter().enumerate() {
                _mm_storeu_ps(to.add(lane * stride), _mm512_extractf32x4_ps::<0>(column));
                _mm_storeu_ps(to.add((lane + 4) * stride), _mm512_extractf32x4_ps::<1>(column));
                _mm_storeu_ps(to.add((lane + 8) * stride), _mm512_extractf32x4_ps::<2>(column));
                _mm_storeu_ps(to.add((lane + 12) * stride), _mm512_extractf32x4_ps::<3>(column));
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter_eight(self, [a, b, c, d, e, f, g, h]: [F32x16; 8], out: &mut [f32], stride: usize) {
        let out = &mut out[..15 * stride + 8];
        let to = out.as_mut_ptr();
        let (low, high) = (self.tiles([a, b, c, d]), self.tiles([e, f, g, h]));
        // SAFETY: lane l is stored at l * stride, and the last lane ends where `out` does. Stores
        // need not be aligned.
        unsafe {
            let first = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
            let last = _mm512_setr_epi32(8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31);
            for (lane, (F32x16(low), F32x16(high))) in low.into_iter().zip(high).enumerate() {
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
    fn stream(self, from: &[f32; LINE], to: &mut Line) {
        // SAFETY: a line is an aligned vector; loads need not be aligned.
        unsafe { _mm512_stream_ps(to.0.as_mut_ptr(), _mm512_loadu_ps(from.as_ptr())) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream_indices(self, table: &[u32; LINE], base: U32x16, to: &mut Line) {
        let indices = base + self.load_integers(table);
        // SAFETY: a line is an aligned vector.
        unsafe { _mm512_stream_si512(to.0.as_mut_ptr().cast(), indices.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn fence(self) {
        // SAFETY: no pointers.
        unsafe { _mm_sfence() }
    }
}

impl Floats for F32x16 {
    type Integers = U32x16;
    type Mask = Mask16;

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..16];
        // SAFETY: sixteen places are there; the store need not be aligned.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn sqrt(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_sqrt_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn floor(self) -> Self {
        /// The rounding of the instruction: downwards to a whole number, without exceptions.
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
    fn less(self, other: Self) -> Mask16 {
        // SAFETY: no pointers.
        Mask16(unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn is_zero(self) -> Mask16 {
        // SAFETY: no pointers.
        Mask16(unsafe { _mm512_cmp_ps_mask::<_CMP_EQ_OQ>(self.0, _mm512_setzero_ps()) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn permute(self, places: U32x16) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_permutexvar_ps(places.0, self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_in(self, before: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let (before, here) = (_mm512_castps_si512(before.0), _mm512_castps_si512(self.0));
            _mm512_castsi512_ps(_mm512_alignr_epi32::<15>(here, before))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_in_four(self, before: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let (before, here) = (_mm512_castps_si512(before.0), _mm512_castps_si512(self.0));
            _mm512_castsi512_ps(_mm512_alignr_epi32::<12>(here, before))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_signed(self) -> U32x16 {
        // SAFETY: no pointers.
        U32x16(unsafe { _mm512_cvttps_epi32(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_bits(self) -> U32x16 {
        // SAFETY: no pointers.
        U32x16(unsafe { _mm512_castps_si512(self.0) })
    }
}

impl Integers for U32x16 {
    type Floats = F32x16;
    type Mask = Mask16;

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [u32]) {
        let to = &mut to[..16];
        // SAFETY: sixteen places are there; the store need not be aligned.
        unsafe { _mm512_storeu_si512(to.as_mut_ptr().cast(), self.0) }
    }

    #[cfg_attr(optimized, inline(always))]
    fn first(self) -> u32 {
        // SAFETY: no pointers.
        unsafe { _mm512_cvtsi512_si32(self.0) }.cast_unsigned()
    }

    #[cfg_attr(optimized, inline(always))]
    fn without_first(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_maskz_mov_epi32(0xfffe, self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn running_sum(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let a = self.0;
            let zero = _mm512_setzero_si512();
            let a = _mm512_add_epi32(a, _mm512_alignr_epi32::<15>(a, zero));
            let a = _mm512_add_epi32(a, _mm512_alignr_epi32::<14>(a, zero));
            let a = _mm512_add_epi32(a, _mm512_alignr_epi32::<12>(a, zero));
            _mm512_add_epi32(a, _mm512_alignr_epi32::<8>(a, zero))
        })
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_last(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_permutexvar_epi32(_mm512_set1_epi32(15), self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_left<const BY: i32>(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_sllv_epi32(self.0, _mm512_set1_epi32(BY)) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn times(self, factor: u32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_mullo_epi32(self.0, _mm512_set1_epi32(factor.cast_signed())) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right<const BY: i32>(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_srlv_epi32(self.0, _mm512_set1_epi32(BY)) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right_signed<const BY: i32>(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_srav_epi32(self.0, _mm512_set1_epi32(BY)) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn masked(self, mask: u32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm512_and_si512(self.0, _mm512_set1_epi32(mask.cast_signed())) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn has_bit(self, bit: u32) -> Mask16 {
        // SAFETY: no pointers.
        Mask16(unsafe { _mm512_test_epi32_mask(self.0, _mm512_set1_epi32(bit.cast_signed())) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn signed_to_floats(self) -> F32x16 {
        // SAFETY: no pointers.
        F32x16(unsafe { _mm512_cvtepi32_ps(self.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn bit_cast(self) -> F32x16 {
        // SAFETY: no pointers.
        F32x16(unsafe { _mm512_castsi512_ps(self.0) })
    }
}

impl Mask for Mask16 {
    type Floats = F32x16;

    #[cfg_attr(optimized, inline(always))]
    fn select(self, yes: F32x16, no: F32x16) -> F32x16 {
        // SAFETY: no pointers.
        F32x16(unsafe { _mm512_mask_blend_ps(self.0, no.0, yes.0) })
    }

    #[cfg_attr(optimized, inline(always))]
    fn bits(self) -> u32 {
        self.0.into()
    }
}
