//! A plain fill, the yardstick of the mesh stage: writing is all the work that has to be done.

use rayon::prelude::*;

use super::instruction_set::InstructionSet;
use super::simd::{Job, LINE, Line, Simd};

/// Floats that one rayon item fills: a megabyte.
const FILL_FLOATS: usize = 1 << 18;

/// Fills `out` past the caches, on all threads of the present rayon pool, with the widest stores that the processor has.
///
/// No mesh of as many bytes can be written faster, so that benchmarks state a mesh's share of this.
///
/// ```
/// let mut out = vec![0.0; 1000];
/// texere_cpu::fill(&mut out, 1.5);
/// assert!(out.iter().all(|value| *value == 1.5));
/// ```
pub fn fill(out: &mut [f32], value: f32) {
    let set = InstructionSet::chosen().unwrap_or_else(|_| InstructionSet::widest());
    out.par_chunks_mut(FILL_FLOATS).for_each(|out| set.run(Fill { out, value }));
}

struct Fill<'a> {
    out: &'a mut [f32],
    value: f32,
}

impl Job for Fill<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let (head, lines, tail) = bytemuck::pod_align_to_mut::<f32, Line>(self.out);
        head.fill(self.value);
        tail.fill(self.value);
        let from = [self.value; LINE];
        lines.iter_mut().for_each(|line| simd.stream(&from, line));
        simd.fence();
    }
}
