//! The limits of values in a design file. Its writer keeps them as well.

use texere_core::{BENDING_LIMITS, HAIRINESS_LIMIT};

/// The largest design file that is read, bytes. A file that names each of a million threads is
/// about as large.
pub(crate) const FILE: u64 = 1 << 24;

/// The least and the greatest diameter, and the narrowest and the widest spacing, mm.
pub(crate) const LENGTH_MM: [f64; 2] = [1e-3, 1e3];

/// The finest and the coarsest yarn, tex: a single filament, and a rope.
pub(crate) const TEX: [f64; 2] = [1e-3, 1e7];

/// The least and the greatest bending stiffness, N mm².
pub(crate) const BENDING: [f64; 2] = [1e-9, BENDING_LIMITS[1] as f64];

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

/// The least and the greatest factor for a yarn's length, as `finish.length` gives it.
pub(crate) const LENGTHS: [f64; 2] = [0.5, 2.0];

/// The greatest tension that draws yarns in, as a share of their length in each pass of settling.
pub(crate) const TENSION_MOST: f64 = 0.1;

/// The least and the greatest distance of the two plates that press a knit, mm.
pub(crate) const PRESS_MM: [f64; 2] = [0.001, 1000.0];

/// The least and the most wales or courses to the cm.
pub(crate) const PER_CM: [f64; 2] = [0.01, 1000.0];

/// The least and the most needles to the inch.
pub(crate) const PER_INCH: [f64; 2] = [0.1, 100.0];

/// The shortest and the longest loop, mm.
pub(crate) const LOOP_MM: [f64; 2] = [0.01, 1000.0];

/// The most copies of a knit's repeat in either direction.
pub(crate) const COPIES_MAX: i64 = 1_000_000;

/// The least and the greatest draw-in of a warp knit: finished width over width on the needles.
pub(crate) const DRAW_IN: [f64; 2] = [0.1, 2.0];

/// The most needles by which a guide bar is offset.
pub(crate) const OFFSET_MAX: i64 = 1 << 16;

/// The most guides of a threading.
pub(crate) const GUIDES_MAX: usize = 100_000;

/// The most wales or courses of a piece of a warp knit.
pub(crate) const SIDE_MAX: i64 = 1_000_000;
