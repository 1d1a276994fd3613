//! The step of a crossing, and the bounds of its unknowns.

use super::{CrossingBlock, CrossingState, CrossingsPlan, Set, Site};

/// The longest step of an unknown, in units. 0.1, 0.05, 0.02 and 0.01 were tried. With 0.1, 2/2
/// twill at 1.06 times Ashenhurst's sett never comes to rest, and swings by 0.05
/// (`dense_twill_comes_to_rest`).
pub const STEP: f32 = 0.02;

/// The share of a crossing's last step that is added as momentum. 0.8, 0.9, 0.95, 0.98 and 0.99
/// were tried. Denim takes 270 passes with 0.95, and 165 passes with 0.98.
pub const MOMENTUM: f32 = 0.98;

/// The least cosine of the angle between a crossing's last step and the energy's gradient at which
/// the step adds no momentum. Between a cosine of 0 and this one, momentum fades. If momentum ended
/// at once, rounding could decide whether there is any. 0.02, 0.1 and 0.5 were tried, and differ
/// little.
pub const UPHILL: f32 = 0.1;

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

    /// The state that the next pass reads of a crossing that has moved from `was` to `is`. It is
    /// `is`, moved on by momentum. `block` has the equations of the step. Momentum that would lead
    /// uphill in the energy fades or is dropped ([`UPHILL`]). Otherwise denim never comes to rest.
    ///
    /// **Source**: O'Donoghue and Candès, "Adaptive restart for accelerated gradient schemes",
    /// Foundations of Computational Mathematics 15, 2015, here for each crossing by itself.
    #[must_use]
    pub fn ahead(
        &self,
        was: &CrossingState,
        is: &CrossingState,
        block: &CrossingBlock,
        site: Site,
    ) -> CrossingState {
        let [before, after]: [[f32; 8]; 2] = [bytemuck::cast(*was), bytemuck::cast(*is)];
        let gone: [f32; 8] = std::array::from_fn(|unknown| after[unknown] - before[unknown]);
        let dot = |one: &[f32; 8], other: &[f32; 8]| {
            one.iter().zip(other).fold(0.0, |sum: f32, (one, other)| sum + one * other)
        };
        let rise = dot(&gone, &block.gradient);
        let steepest = (dot(&gone, &gone) * dot(&block.gradient, &block.gradient)).sqrt();
        let kept = if rise > 0.0 { (1.0 - rise / (UPHILL * steepest)).max(0.0) } else { 1.0 };
        let momentum = MOMENTUM * kept;
        let on = gone.map(|gone| momentum * gone);
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
