//! Eight lanes on x86-64 processors with AVX2.
#![allow(unsafe_code, reason = "vector instructions and streaming stores")]

use std::arch::x86_64::{
    __m256, __m256i, _CMP_EQ_OQ, _mm_sfence, _mm256_add_epi32, _mm256_add_ps, _mm256_blendv_ps,
    _mm256_cmp_ps, _mm256_div_ps, _mm256_loadu_ps, _mm256_loadu_si256, _mm256_mul_ps, _mm256_permute2f128_ps,
    _mm256_set1_epi32, _mm256_set1_ps, _mm256_setzero_ps, _mm256_shuffle_ps, _mm256_sqrt_ps,
    _mm256_storeu_ps, _mm256_stream_ps, _mm256_stream_si256, _mm256_sub_ps, _mm256_unpackhi_ps,
    _mm256_unpacklo_ps,
};

use super::vector::Vector;

// SAFETY, for all blocks in this file: the instructions need AVX2, and `Path` calls code that is generic over vectors with
// this type only where the processor has it. What is said at a block is about its pointers.

/// Bytes that a streaming store's address has to be a multiple of.
const ALIGN: usize = 32;

#[derive(Debug, Clone, Copy)]
pub(super) struct Avx2(__m256);

impl Vector for Avx2 {
    const LANES: usize = 8;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let from = &from[..8];
        // SAFETY: eight values are there; the load need not be aligned.
        Self(unsafe { _mm256_loadu_ps(from.as_ptr()) })
    }

    #[inline(always)]
    fn splat(value: f32) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_set1_ps(value) })
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_add_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn inverse_root(self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe { _mm256_div_ps(_mm256_set1_ps(1.0), _mm256_sqrt_ps(self.0)) })
    }

    #[inline(always)]
    fn where_zero(self, here: Self, elsewhere: Self) -> Self {
        // SAFETY: no pointers.
        Self(unsafe {
            let zero = _mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, _mm256_setzero_ps());
            _mm256_blendv_ps(elsewhere.0, here.0, zero)
        })
    }

    #[inline(always)]
    fn scatter(rows: &[Self], out: &mut [f32], stride: usize) {
        let (rows, out) = (&rows[..8], &mut out[..7 * stride + 8]);
        // SAFETY: lane l is stored at l * stride, and the last of them ends where `out` does; stores need not be aligned.
        unsafe {
            // Pairs of rows, then fours, then halves: the usual transpose of eight by eight.
            let pairs = |a: usize| {
                (_mm256_unpacklo_ps(rows[a].0, rows[a + 1].0), _mm256_unpackhi_ps(rows[a].0, rows[a + 1].0))
            };
            let ((l01, h01), (l23, h23), (l45, h45), (l67, h67)) = (pairs(0), pairs(2), pairs(4), pairs(6));
            let low = |a, b| (_mm256_shuffle_ps::<0x44>(a, b), _mm256_shuffle_ps::<0xee>(a, b));
            let ((a0, a1), (a2, a3)) = (low(l01, l23), low(h01, h23));
            let ((b0, b1), (b2, b3)) = (low(l45, l67), low(h45, h67));
            let to = out.as_mut_ptr();
            for (lane, (a, b)) in [(a0, b0), (a1, b1), (a2, b2), (a3, b3)].into_iter().enumerate() {
                _mm256_storeu_ps(to.add(lane * stride), _mm256_permute2f128_ps::<0x20>(a, b));
                _mm256_storeu_ps(to.add((lane + 4) * stride), _mm256_permute2f128_ps::<0x31>(a, b));
            }
        }
    }

    #[inline(always)]
    fn stream(from: &[f32], to: &mut [f32]) {
        let from = &from[..to.len()];
        let head = (to.as_ptr().align_offset(ALIGN)).min(to.len());
        let vectors = (to.len() - head) / 8;
        to[..head].copy_from_slice(&from[..head]);
        // SAFETY: `vectors` times eight values lie behind `head` in both, and `to` is aligned there.
        unsafe {
            let (source, target) = (from.as_ptr().add(head), to.as_mut_ptr().add(head));
            for vector in 0..vectors {
                _mm256_stream_ps(target.add(8 * vector), _mm256_loadu_ps(source.add(8 * vector)));
            }
        }
        let tail = head + 8 * vectors;
        to[tail..].copy_from_slice(&from[tail..]);
    }

    #[inline(always)]
    fn stream_pattern(table: &[u32], period: usize, growth: u32, mut base: u32, out: &mut [u32]) {
        let table = &table[..period + 8];
        let head = out.as_ptr().align_offset(ALIGN).min(out.len()).min(8);
        let (first, mut rest) = out.split_at_mut(head);
        for (index, offset) in first.iter_mut().zip(table) {
            *index = base + offset;
        }
        while rest.len() >= period {
            let (stretch, others) = rest.split_at_mut(period);
            // SAFETY: `period` is a multiple of eight; `head` is at most eight, and the table has eight values more than
            // `period`. `stretch` is aligned: it lies whole vectors behind `head`.
            unsafe {
                let bases = _mm256_set1_epi32(base.cast_signed());
                let (source, target) = (table.as_ptr().add(head), stretch.as_mut_ptr());
                for vector in 0..period / 8 {
                    let offsets = _mm256_loadu_si256(source.add(8 * vector).cast::<__m256i>());
                    let target = target.add(8 * vector).cast::<__m256i>();
                    _mm256_stream_si256(target, _mm256_add_epi32(bases, offsets));
                }
            }
            base += growth;
            rest = others;
        }
        for (k, index) in rest.iter_mut().enumerate() {
            let place = head + k;
            *index = if place < period { base + table[place] } else { base + growth + table[place - period] };
        }
    }

    #[inline(always)]
    fn fence() {
        // SAFETY: no pointers.
        unsafe { _mm_sfence() }
    }
}
