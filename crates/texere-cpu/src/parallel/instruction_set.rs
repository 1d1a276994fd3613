//! The vector instructions that the parallel backend uses, detected at run time.

use std::ffi::OsStr;

use texere_core::BackendError;

#[cfg(target_arch = "x86_64")]
use super::avx2::Avx2;
#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
use super::portable::Portable;
use super::simd::{Job, Simd};

/// A set of vector instructions that this processor has.
#[derive(Debug, Clone, Copy)]
pub(super) enum InstructionSet {
    /// Instructions that every processor of the target has.
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

    /// The set with the widest vectors.
    pub(super) fn widest() -> Self {
        Self::available().pop().unwrap_or(Self::Portable(Portable))
    }

    /// The set that `TEXERE_SIMD` names or, without it, the one with the widest vectors.
    ///
    /// **Errors**: [`BackendError::NoInstructionSet`] if the processor has no set of that name.
    pub(super) fn chosen() -> Result<Self, BackendError> {
        std::env::var_os(VARIABLE).map_or_else(|| Ok(Self::widest()), |name| Self::named(&name))
    }

    fn named(wanted: &OsStr) -> Result<Self, BackendError> {
        let sets = Self::available();
        sets.iter().copied().find(|set| set.name() == wanted).ok_or_else(|| BackendError::NoInstructionSet {
            variable: VARIABLE,
            wanted: wanted.to_string_lossy().into_owned(),
            found: sets.iter().map(|set| set.name()).collect(),
        })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_set_that_the_processor_has_is_found_by_its_name() {
        for set in InstructionSet::available() {
            let named = InstructionSet::named(OsStr::new(set.name()));
            assert_eq!(named.map(InstructionSet::name).ok(), Some(set.name()));
        }
    }

    #[test]
    fn a_name_that_is_no_set_of_this_processor_is_refused_with_those_that_are() {
        for wanted in ["", "AVX2", "avx2 ", "neon", "portable,avx2"] {
            let message = match InstructionSet::named(OsStr::new(wanted)) {
                Ok(set) => format!("{} was taken", set.name()),
                Err(error) => error.to_string(),
            };
            let start = format!("TEXERE_SIMD is \"{wanted}\"; this processor has: portable");
            assert!(message.starts_with(&start), "{message}");
        }
    }
}
