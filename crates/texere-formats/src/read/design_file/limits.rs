//! The limits of values in a design file. Its writer keeps them as well.

use texere_core::HAIRINESS_LIMIT;

/// The largest design file that is read, bytes. A file that names each of a million threads is
/// about as large.
pub(crate) const FILE: u64 = 1 << 24;

/// The least and the greatest diameter, and the narrowest and the widest spacing, mm.
pub(crate) const LENGTH_MM: [f64; 2] = [1e-3, 1e3];

/// The finest and the coarsest yarn, tex: a single filament, and a rope.
pub(crate) const TEX: [f64; 2] = [1e-3, 1e7];

/// The hardest twist in either direction, turns per metre.
pub(crate) const TWIST_PER_M: f64 = 1e5;

/// The least and the greatest hairiness, Uster's H: the length of the fibres that stand off a yarn,
/// in cm for a cm of yarn.
pub(crate) const HAIRINESS: [f64; 2] = [0.0, HAIRINESS_LIMIT as f64];

/// Uster's H of a yarn of this twist that has no `hairiness`. A yarn without twist is treated as
/// filament, and has 0. A yarn with twist is treated as spun staple, and has 5: the middle of the
/// Uster Statistics for combed ring-spun cotton of 20 tex.
pub(crate) const fn hairiness_of(twist: f32) -> f32 {
    if twist == 0.0 { 0.0 } else { 5.0 }
}

/// The greatest factor for the tension and the pressing of woven cloth, where 1 is relaxed cloth.
pub(crate) const TIMES_MOST: f64 = 10.0;

/// The least and the greatest factor by which woven cloth is stretched.
pub(crate) const STRETCH: [f64; 2] = [0.5, 2.0];
