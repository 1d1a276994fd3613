//! The limits of drafts. The writer of WIF keeps them as well.

/// The largest file of a draft that is read, bytes. In WIF, a lift plan of 10,000 picks by 5,000
/// hooks takes about half as much, if each pick lifts half of the hooks.
pub(crate) const FILE_MAX: u64 = 1 << 28;

/// The most threads of a warp or weft.
pub(crate) const THREADS_MAX: u32 = 1_000_000;

/// The least and the greatest spacing or thickness that is allowed, mm. A design file has the same
/// limits.
pub(crate) const LENGTH_MM: [f64; 2] = [1e-3, 1e3];
