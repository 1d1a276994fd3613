//! Which vector instructions the parallel backend uses, found out at run time.

#[cfg(target_arch = "x86_64")]
use super::avx2::Avx2;
#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
use super::portable::Portable;
use super::simd::{Job, Simd};

/// A set of vector instructions that this processor has.
#[derive(Debug, Clone, Copy)]
pub(super) enum InstructionSet {
    /// What every processor of the target has.
    Portable(Portable),
    /// x86-64 with AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    /// x86-64 with AVX-512, its parts F and DQ.
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

/// The environment variable that names the set to use.
const VARIABLE: &str = "TEXERE_SIMD";

impl InstructionSet {
    /// The sets that this processor has, the one with the widest vectors last.
    pub(super) fn available() -> Vec<Self> {
        #[allow(unused_mut, reason = "other processors have the portable set alone")]
        let mut sets = vec![Self::Portable(Portable)];
        #[cfg(target_arch = "x86_64")]
        sets.extend(Avx2::detect().map(Self::Avx2));
        #[cfg(target_arch = "x86_64")]
        sets.extend(Avx512::detect().map(Self::Avx512));
        sets
    }

    /// The set that `TEXERE_SIMD` names, if the processor has it, else the one with the widest vectors.
    pub(super) fn chosen() -> Self {
        let sets = Self::available();
        let wanted = std::env::var(VARIABLE).ok();
        let named = wanted.and_then(|name| sets.iter().find(|set| set.name() == name).copied());
        named.or(sets.last().copied()).unwrap_or(Self::Portable(Portable))
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Portable(_) => "portable",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => "avx512",
        }
    }

    pub(super) fn run(self, job: impl Job) {
        match self {
            Self::Portable(simd) => simd.run(job),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(simd) => simd.run(job),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(simd) => simd.run(job),
        }
    }
}
