//! Which instructions the parallel backend uses, found out at run time.
#![allow(unsafe_code, reason = "calls functions that need the instructions just asked for")]

use super::portable::Portable;
use super::vector::Vector;

/// A way through the stages, and its vectors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Path {
    /// What every processor of the target has.
    Portable,
    /// x86-64 with AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// x86-64 with AVX-512, its parts F and DQ.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Work that is written once for all vectors.
pub(super) trait Job {
    /// Does it. It must be inlined, so that it is compiled for the instructions of its path.
    fn run<V: Vector>(self);
}

/// The environment variable that forces a path, by its name.
const VARIABLE: &str = "TEXERE_SIMD";

impl Path {
    /// The best path that this processor has, or the one that `TEXERE_SIMD` names, if this processor has it.
    pub(crate) fn detect() -> Self {
        let paths = Self::available();
        let forced = std::env::var(VARIABLE).ok();
        let named = forced.and_then(|name| paths.iter().find(|path| path.name() == name).copied());
        named.or(paths.last().copied()).unwrap_or(Self::Portable)
    }

    /// The paths that this processor has, the best one last.
    pub(crate) fn available() -> Vec<Self> {
        #[allow(unused_mut, reason = "other processors have the portable path alone")]
        let mut paths = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            paths.push(Self::Avx2);
        }
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512dq") {
            paths.push(Self::Avx512);
        }
        paths
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => "avx512",
        }
    }

    pub(super) fn run(self, job: impl Job) {
        match self {
            Self::Portable => job.run::<Portable>(),
            // SAFETY: `available`, from which all paths come, has this one only where the processor has AVX2.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { avx2(job) },
            // SAFETY: and this one only where it has AVX-512 F and DQ.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { avx512(job) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(job: impl Job) {
    job.run::<super::avx2::Avx2>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
fn avx512(job: impl Job) {
    job.run::<super::avx512::Avx512>();
}
