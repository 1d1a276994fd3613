//! Threads of a cloth, and their places, which follow from their spacings.

use texere_core::Halves;

use crate::COTTON_LEAST_AREA;

/// The least spacing of a thread, mm: a nanometre.
pub const SPACING_MIN: f64 = 1e-6;

/// The largest spacing of a thread, mm: a kilometre.
pub const SPACING_MAX: f64 = 1e6;

/// The least flatness of a thread: ten times as high as wide.
pub(super) const FLATNESS_MIN: f32 = 0.1;

/// The largest flatness of a thread: ten times as wide as high.
pub(super) const FLATNESS_MAX: f32 = 10.0;

/// The least stiffness of a thread, as a multiple of that of cotton.
pub(super) const STIFFNESS_MIN: f32 = 0.01;

/// The largest stiffness of a thread, as a multiple of that of cotton.
pub(super) const STIFFNESS_MAX: f32 = 100.0;

/// The least firmness of a thread's section, as a multiple of that of cotton.
pub(super) const FIRMNESS_MIN: f32 = 0.01;

/// The largest firmness of a thread's section, as a multiple of that of cotton.
pub(super) const FIRMNESS_MAX: f32 = 100.0;

/// One end or one pick: its yarn, and the width of the strip of cloth that it takes.
///
/// ```
/// use texere_fabric::Thread;
/// let red = Thread { material: 1, ..Thread::new(0.5, 0.1) };
/// assert_eq!(red.section, 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thread {
    /// Width of the strip of cloth that the thread takes, mm. The thread lies in the middle of its
    /// strip, so that the distance of two neighbours is half the sum of their spacings.
    pub spacing_mm: f64,
    /// Radius of the yarn when it is round, mm.
    pub radius_mm: f32,
    /// Width over height in the cloth, from 0.1 to 10; 1 for a round thread. The thread keeps the
    /// area of the round yarn. Its section stays inside the flattened outline, also where it turns
    /// with the twist. When the cloth comes to rest, pressure makes the thread flatter still.
    pub flatness: f32,
    /// Stiffness against bending when the cloth comes to rest, from 0.01 to 100; 1 for a cotton
    /// yarn of the same diameter.
    pub stiffness: f32,
    /// How firmly the section keeps its shape when the cloth comes to rest, from 0.01 to 100; 1 for
    /// a cotton yarn of ordinary twist. Hard twist makes a yarn firmer, and its section stays
    /// rounder; filament without twist spreads flat
    /// ([`firmness_from_twist`](crate::firmness_from_twist)).
    pub firmness: f32,
    /// The least area that the yarn's section keeps when the cloth comes to rest, as a share of the
    /// area of the round yarn, from 0 to 1: fibres can't be packed more closely
    /// ([`Fibre::least_area`](crate::Fibre::least_area)).
    pub least_area: f32,
    /// Index into the materials.
    pub material: u32,
    /// Index into the sections.
    pub section: u32,
    /// Twist, rad per mm; positive is Z twist.
    /// [`twist_from_turns_per_m`](crate::twist_from_turns_per_m) gives it.
    pub twist: f32,
}

impl Thread {
    /// A round, untwisted thread of cotton, of the first material and the first section.
    #[must_use]
    pub const fn new(spacing_mm: f64, radius_mm: f32) -> Self {
        Self {
            spacing_mm,
            radius_mm,
            flatness: 1.0,
            stiffness: 1.0,
            firmness: 1.0,
            least_area: COTTON_LEAST_AREA,
            material: 0,
            section: 0,
            twist: 0.0,
        }
    }

    /// Half the thread's width and half its height in the cloth, mm, for a circular section.
    #[must_use]
    pub fn halves_mm(&self) -> [f32; 2] {
        let flatter = self.flatness.sqrt();
        [self.radius_mm * flatter, self.radius_mm / flatter]
    }

    /// Half the thread's width and half its height, as half floats of control points.
    pub(super) fn halves(&self) -> Halves {
        let [width, height] = self.halves_mm();
        Halves::new(width, height)
    }
}

/// Middles of a set's threads, mm from the cloth's edge. Each thread lies in the middle of a strip
/// as wide as its own spacing.
///
/// **Source**: WIF 1.1 (Nielsen 1997) calls a thread's spacing the room that it takes in the cloth.
pub(super) fn middles(threads: &[Thread]) -> impl Iterator<Item = f64> {
    let (mut at, mut before) = (0.0, 0.0);
    threads.iter().map(move |thread| {
        at += (before + thread.spacing_mm) / 2.0;
        before = thread.spacing_mm;
        at
    })
}

/// Distance from each thread of a set to the next one, mm.
pub(crate) fn pitches(threads: &[Thread]) -> impl Iterator<Item = f64> {
    threads.iter().zip(threads.iter().skip(1)).map(|(one, next)| (one.spacing_mm + next.spacing_mm) / 2.0)
}
