//! The limits of what a design file may say, which its writer keeps, too.

use texere_core::HAIRINESS_LIMIT;

/// The largest design file that is read, bytes: one that names each of a million threads takes as
/// much.
pub(crate) const FILE: u64 = 1 << 24;

/// Thinnest and thickest diameter, and narrowest and widest spacing, that a design file may ask
/// for, mm.
pub(crate) const LENGTH_MM: [f64; 2] = [1e-3, 1e3];

/// Finest and coarsest yarn, tex: a single filament, and a rope.
pub(crate) const TEX: [f64; 2] = [1e-3, 1e7];

/// Hardest twist, turns per metre either way.
pub(crate) const TWIST_PER_M: f64 = 1e5;

/// Baldest and hairiest yarn, Uster's H.
pub(crate) const HAIRINESS: [f64; 2] = [0.0, HAIRINESS_LIMIT as f64];

/// Uster's H where nothing is said, of a yarn of this twist: without any it is filament, else spun
/// staple. Of that it is what combed ring-spun cotton of 20 tex has in the middle of the Uster
/// Statistics.
pub(crate) const fn hairiness_of(twist: f32) -> f32 {
    if twist == 0.0 { 0.0 } else { 5.0 }
}

/// The most times relaxed cloth's that woven cloth is taut or pressed.
pub(crate) const TIMES_MOST: f64 = 10.0;

/// How many times as long woven cloth may become.
pub(crate) const STRETCH: [f64; 2] = [0.5, 2.0];
