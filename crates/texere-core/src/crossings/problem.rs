//! The problem that is settled: the drawdown and the threads of a cloth.

use super::Level;

/// A thread of the warp or the weft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingThread {
    /// The distance from the middle of this thread to that of the next thread of its set, mm. For
    /// the last thread, it is the distance to the first thread of the next repeat.
    pub pitch: f32,
    /// The diameter of a circle with the area of the thread's section, mm, before the section loses
    /// any area.
    pub diameter: f32,
    /// The stiffness against bending, 1 for a cotton yarn of its diameter.
    pub stiffness: f32,
    /// How firmly the section keeps its shape, 1 for a cotton yarn of ordinary twist. A firmer
    /// section tends to be rounder.
    pub firmness: f32,
    /// The ratio of width to thickness of the section when nothing presses it, 1 for a round yarn.
    pub flatness: f32,
    /// The least area that the thread's section keeps, as a share of its area, from 0 to 1. A
    /// section is as small as that when its fibres can't be packed more closely. It is 0.75 for a
    /// cotton yarn.
    pub least_area: f32,
}

impl CrossingThread {
    /// A cotton thread of ordinary twist, round when nothing presses it.
    #[must_use]
    pub const fn new(pitch: f32, diameter: f32) -> Self {
        Self { pitch, diameter, stiffness: 1.0, firmness: 1.0, flatness: 1.0, least_area: 0.75 }
    }
}

/// Woven cloth that is to come to rest.
///
/// ```
/// use texere_core::crossings::{Crossings, CrossingsPlan, CrossingThread};
/// // Plain weave, two ends and two picks a repeat; threads of 0.2 mm every 0.4 mm.
/// let thread = CrossingThread::new(0.4, 0.2);
/// let plain = Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]);
/// assert_eq!(CrossingsPlan::new(&plain)?.crossings(), 4);
/// # Ok::<(), texere_core::CrossingsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Crossings {
    pub(crate) ups: Vec<bool>,
    pub(crate) threads: [Vec<CrossingThread>; 2],
    pub(crate) levels: [Vec<Level>; 2],
    pub(crate) repeats: [bool; 2],
    pub(crate) tension: [f32; 2],
    pub(crate) press: f32,
    pub(crate) held: bool,
    pub(crate) passes: u32,
}

impl Crossings {
    /// Cloth that repeats without end along both axes. `ups` says for each crossing whether the
    /// warp lies on the face, pick after pick, and end after end in each pick.
    #[must_use]
    pub const fn new(ups: Vec<bool>, warp: Vec<CrossingThread>, weft: Vec<CrossingThread>) -> Self {
        Self {
            ups,
            threads: [warp, weft],
            levels: [Vec::new(), Vec::new()],
            repeats: [true; 2],
            tension: [1.0; 2],
            press: 1.0,
            held: false,
            passes: 400,
        }
    }

    /// Sets the levels of end and pick at each crossing, in the order of the drawdown. By default
    /// the cloth is single.
    #[must_use]
    pub fn levels(mut self, warp: Vec<Level>, weft: Vec<Level>) -> Self {
        self.levels = [warp, weft];
        self
    }

    /// Sets whether the cloth goes on beyond its last end, and beyond its last pick. If not,
    /// nothing holds the cloth's edge. By default the cloth goes on beyond both.
    #[must_use]
    pub const fn repeats(mut self, ends: bool, picks: bool) -> Self {
        self.repeats = [ends, picks];
        self
    }

    /// Sets the tension of warp and weft, 0 to 10, 1 for relaxed cloth. A higher tension
    /// straightens one set at the cost of the other.
    #[must_use]
    pub const fn tension(mut self, warp: f32, weft: f32) -> Self {
        self.tension = [warp, weft];
        self
    }

    /// Sets the strength with which a finish presses the cloth flat, 0 to 10, 1 for relaxed cloth.
    #[must_use]
    pub const fn press(mut self, press: f32) -> Self {
        self.press = press;
        self
    }

    /// Holds all threads in their places: no thread shifts sideways. By default threads shift.
    #[must_use]
    pub const fn held(mut self) -> Self {
        self.held = true;
        self
    }

    /// Sets the largest number of passes, 1 to a million. Threads grow to their full area in the
    /// first fifty.
    #[must_use]
    pub const fn passes(mut self, passes: u32) -> Self {
        self.passes = passes;
        self
    }
}
