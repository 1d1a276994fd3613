//! The step of a crossing, and the bounds of its unknowns.

use super::{CrossingBlock, CrossingState, CrossingsPlan, Set, Site};

/// The longest step of an unknown, in units.
pub const STEP: f32 = 0.1;

/// The share of a crossing's last step that is added as momentum.
pub const MOMENTUM: f32 = 0.8;

/// The least and the largest half width, in radii.
pub const HALF_WIDTH: [f32; 2] = [0.4, 3.3];

/// The least and the largest half height, in radii.
pub const HALF_HEIGHT: [f32; 2] = [0.3, 2.0];

impl CrossingsPlan {
    /// The state of a crossing after the step that `block` gives.
    #[must_use]
    pub fn moved(&self, crossing: &CrossingState, block: &CrossingBlock, site: Site) -> CrossingState {
        let step = block.step();
        let longest = step.iter().fold(0.0, |longest: f32, step| longest.max(step.abs()));
        let share = if longest > STEP { STEP / longest } else { 1.0 };
        self.bounded(crossing, step.map(|step| share * step), site)
    }

    /// The state that other crossings read of a crossing that has moved from `was` to `is`: `is`,
    /// moved on by momentum.
    #[must_use]
    pub fn ahead(&self, was: &CrossingState, is: &CrossingState, site: Site) -> CrossingState {
        let [before, after]: [[f32; 8]; 2] = [bytemuck::cast(*was), bytemuck::cast(*is)];
        let on = std::array::from_fn(|unknown| MOMENTUM * (after[unknown] - before[unknown]));
        self.bounded(is, on, site)
    }

    /// A crossing moved by `step`, within the bounds of its unknowns.
    fn bounded(&self, crossing: &CrossingState, step: [f32; 8], site: Site) -> CrossingState {
        let mut moved = *crossing;
        for set in Set::BOTH {
            let row = self.rows(set)[site.thread(set)];
            let by = |unknown: usize| step[set.first() + unknown];
            let lie = moved.thread_mut(set);
            lie.shift = (lie.shift + by(0)).clamp(-row.freedom, row.freedom);
            lie.height = (lie.height + by(1)).clamp(-row.height, row.height);
            let within = |value: f32, [low, high]: [f32; 2]| value.clamp(low * row.radius, high * row.radius);
            lie.half_width = within(lie.half_width + by(2), HALF_WIDTH);
            lie.half_height = within(lie.half_height + by(3), HALF_HEIGHT);
        }
        moved
    }
}
