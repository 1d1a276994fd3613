//! A plain fill of the host's memory, with which the CPU's mesh stage is compared. It writes and
//! does nothing else.

use rayon::prelude::*;

/// The number of floats that one task fills: a megabyte.
const TASK: usize = 1 << 18;

/// Fills `out` on all threads of the present rayon pool. A processor with AVX or AVX-512F writes
/// past the caches, with the wider of the two.
///
/// No mesh of as many bytes can be written faster, so benchmarks state a mesh's share of this
/// speed.
///
/// ```
/// let mut out = vec![0.0; 1000];
/// texere_bench::stream::fill(&mut out[3..], 1.5);
/// assert!(out[..3] == [0.0; 3] && out[3..].iter().all(|value| *value == 1.5));
/// ```
pub fn fill(out: &mut [f32], value: f32) {
    out.par_chunks_mut(TASK).for_each(|out| fill_one(out, value));
}

#[cfg(target_arch = "x86_64")]
fn fill_one(out: &mut [f32], value: f32) {
    if is_x86_feature_detected!("avx512f") {
        // SAFETY: the processor has AVX-512F.
        unsafe { x86::fill_512(out, value) }
    } else if is_x86_feature_detected!("avx") {
        // SAFETY: the processor has AVX.
        unsafe { x86::fill_256(out, value) }
    } else {
        out.fill(value);
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn fill_one(out: &mut [f32], value: f32) {
    out.fill(value);
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::{_mm_sfence, _mm256_set1_ps, _mm256_stream_ps, _mm512_set1_ps, _mm512_stream_ps};

    /// A line of 64 bytes, with the size and alignment of a streaming store of AVX-512.
    #[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
    #[repr(C, align(64))]
    struct Line([f32; 16]);

    #[target_feature(enable = "avx512f")]
    pub(super) fn fill_512(out: &mut [f32], value: f32) {
        let (head, lines, tail) = bytemuck::pod_align_to_mut::<f32, Line>(out);
        head.fill(value);
        tail.fill(value);
        for Line(line) in lines {
            // SAFETY: a line is 64 bytes at a multiple of 64.
            unsafe { _mm512_stream_ps(line.as_mut_ptr(), _mm512_set1_ps(value)) };
        }
        _mm_sfence();
    }

    #[target_feature(enable = "avx")]
    pub(super) fn fill_256(out: &mut [f32], value: f32) {
        let (head, lines, tail) = bytemuck::pod_align_to_mut::<f32, Line>(out);
        head.fill(value);
        tail.fill(value);
        for half in lines.iter_mut().flat_map(|Line(line)| line.as_chunks_mut::<8>().0) {
            // SAFETY: half a line is 32 bytes at a multiple of 32.
            unsafe { _mm256_stream_ps(half.as_mut_ptr(), _mm256_set1_ps(value)) };
        }
        _mm_sfence();
    }

    #[cfg(test)]
    mod tests {
        fn every_value_is_filled_and_no_more(fill: impl Fn(&mut [f32])) {
            for (first, end) in [(0, 100), (1, 99), (5, 6), (17, 50), (3, 3)] {
                let mut out = [0.0f32; 100];
                fill(&mut out[first..end]);
                let is_right = |at: usize| (out[at] == 2.0) == (first..end).contains(&at);
                assert!((0..100).all(is_right), "{first}..{end}: {out:?}");
            }
        }

        #[test]
        fn each_kind_of_store_fills_all_and_no_more() {
            if is_x86_feature_detected!("avx512f") {
                // SAFETY: the processor has AVX-512F.
                every_value_is_filled_and_no_more(|out| unsafe { super::fill_512(out, 2.0) });
            }
            if is_x86_feature_detected!("avx") {
                // SAFETY: the processor has AVX.
                every_value_is_filled_and_no_more(|out| unsafe { super::fill_256(out, 2.0) });
            }
        }
    }
}
