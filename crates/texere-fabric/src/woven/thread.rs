//! Threads of a cloth, as they are given.

use texere_core::{RADIUS_MAX, RADIUS_MIN};

/// The least spacing of a thread, mm: the thinnest radius that is taken for a yarn.
pub const SPACING_MIN: f64 = RADIUS_MIN as f64;

/// The most spacing of a thread, mm: a kilometre.
pub const SPACING_MAX: f64 = RADIUS_MAX as f64;

/// One end or one pick: what it is like, and how far it lies from the one before.
///
/// ```
/// use texere_fabric::Thread;
/// let red = Thread { material: 1, ..Thread::new(0.5, 0.1) };
/// assert_eq!(red.section, 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thread {
    /// Distance to the thread before, mm; half of it lies outside the first thread.
    pub spacing_mm: f64,
    /// Radius, mm.
    pub radius_mm: f32,
    /// Index into the materials.
    pub material: u32,
    /// Index into the sections.
    pub section: u32,
    /// Twist, rad per mm; positive is Z twist.
    pub twist: f32,
}

impl Thread {
    /// An untwisted thread of the first material and the first section.
    #[must_use]
    pub const fn new(spacing_mm: f64, radius_mm: f32) -> Self {
        Self { spacing_mm, radius_mm, material: 0, section: 0, twist: 0.0 }
    }
}
