//! Which instructions the parallel backend uses, found out at run time.
#![allow(unsafe_code, reason = "calls functions that need the instructions just asked for")]

use texere_core::{PaddedPoints, Plan, Turn};

use super::runs::MeshRun;
use super::scan::scan_run;
use super::vector::Portable;
use super::{MeshJob, mesh_run};

/// A way through the scan and the mesh, and its vectors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Path {
    /// What every processor of the target has.
    Portable,
    /// x86-64 with AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
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
    fn available() -> Vec<Self> {
        #[allow(unused_mut, reason = "other processors have the portable path alone")]
        let mut paths = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            paths.push(Self::Avx2);
        }
        paths
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => "avx2",
        }
    }

    pub(super) fn scan_run(self, plan: &Plan, points: &PaddedPoints, first: u64, turns: &mut [Turn]) {
        match self {
            Self::Portable => scan_run(plan, points, first, turns),
            // SAFETY: `detect` gives this path only where the processor has AVX2.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { scan_run_avx2(plan, points, first, turns) },
        }
    }

    pub(super) fn mesh_run(self, job: &MeshJob<'_>, run: MeshRun<'_>) {
        match self {
            Self::Portable => mesh_run::<Portable>(job, run),
            // SAFETY: `detect` gives this path only where the processor has AVX2.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { mesh_run_avx2(job, run) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn mesh_run_avx2(job: &MeshJob<'_>, run: MeshRun<'_>) {
    mesh_run::<super::avx2::Avx2>(job, run);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn scan_run_avx2(plan: &Plan, points: &PaddedPoints, first: u64, turns: &mut [Turn]) {
    scan_run(plan, points, first, turns);
}
