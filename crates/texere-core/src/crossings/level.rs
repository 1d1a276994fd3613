//! Levels of threads at crossings.

/// The most levels of a set.
pub(super) const LEVELS_MAX: u8 = 8;

/// The distance from one level to the next before the first pass, in the plan's unit. With twice
/// the value, `gradients_are_the_energys` is red; with half, no test is.
const RISE: f32 = 1.5;

/// The level on which a thread lies at a crossing, among the threads of its set. Threads of one
/// level lie side by side, and threads of different levels above or below one another. The picks of
/// a double cloth alternate between two levels. Where the layers of a figured double cloth change
/// places, its threads change levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Level {
    /// The number of the level, 0 for the lowest.
    pub number: u8,
    /// How many levels the set has here. It is 0 for a binder.
    pub of: u8,
}

impl Level {
    /// The level of all threads of single cloth.
    pub const SINGLE: Self = Self { number: 0, of: 1 };
    /// A binder passes from the face to the back, past the levels of the other threads of its set.
    /// Binders are neighbours of one another. Before the first pass they lie near the middle of the
    /// cloth.
    pub const BINDER: Self = Self { number: 0, of: 0 };

    /// The height that the level gives a thread before the first pass: above the middle of the
    /// cloth, in the plan's unit.
    pub(super) fn start(self) -> f32 {
        match self {
            Self::BINDER => 0.0,
            Self { number, of } => RISE * (f32::from(number) - 0.5 * (f32::from(of) - 1.0)),
        }
    }

    pub(super) const fn is_known(self) -> bool {
        self.of <= LEVELS_MAX && (self.number < self.of || self.of == 0 && self.number == 0)
    }
}
