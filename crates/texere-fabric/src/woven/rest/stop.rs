//! Control points of a thread's path at rest.

/// The most control points between two crossings if a thread changes sides between them: those of
/// single cloth.
///
/// Three, five, seven and nine were tried on single cloth as mills weave it. The more points there
/// are, the nearer threads keep to their arcs. With five, denim comes to 0.971 of touching, and
/// with seven to 0.987, so that its threads need not be made thinner. With nine, it bends at 0.77
/// of its radius (`cloths_of_the_mills_come_to_rest`).
pub(super) const CHANGE_POINTS: usize = 7;

/// The number of control points in a change of sides of cloth in layers. Its threads are pushed
/// from layer to layer. With seven, stitched double twill bends at 0.68 of its radius
/// (`layers_lie_on_one_another`).
pub(super) const LAYERED_POINTS: usize = 5;

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
