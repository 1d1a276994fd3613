//! Control points of a thread's path at rest.

/// Number of control points between two crossings if a thread changes sides between them.
///
/// Three and five were tried on cloths as mills weave them. With three the cloths come to 0.945 to
/// 0.99 of touching, with five to 0.955 to 0.994. When threads are then made thinner
/// (`certificate.rs`), cloths with three points lose up to 6 % of their area, and cloths with five
/// up to 4 %.
pub(super) const CHANGE_POINTS: usize = 5;

/// A control point of a thread's path, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    pub(super) along: f64,
    pub(super) across: f64,
    pub(super) z: f64,
    pub(super) halves: [f64; 2],
    /// The crossed thread at which, or beside which, the point lies; none at a cut end.
    pub(super) crossing: Option<usize>,
}

impl Stop {
    /// The place on the straight line to `other` that lies at `along`.
    pub(super) fn towards(&self, other: &Self, along: f64) -> Self {
        let share = (along - self.along) / (other.along - self.along);
        let mix = |one: f64, two: f64| one + share * (two - one);
        Self {
            along,
            across: mix(self.across, other.across),
            z: mix(self.z, other.z),
            halves: [0, 1].map(|half| mix(self.halves[half], other.halves[half])),
            crossing: None,
        }
    }
}
