//! The terms of the energy of crossings.
//!
//! The energy is a sum of terms. Each term is a weight times the square of a residual, which is 0
//! if a condition holds. The conditions are that a thread is straight, level and even, has its
//! shape and its area, and is clear of the threads beside it. A pass is one step of the
//! Gauss-Newton method for the sum of all terms, at every crossing at once.
//!
//! ```text
//! for each crossing:
//!     block = no equations                  8 unknowns: shift, height, half width, half height
//!                                                       of the end, then of the pick
//!     for the end, then the pick:
//!         own        section has the shape that it tends to; height is 0; area is the yarn's,
//!                    and no less than its fibres fill
//!         bends      second differences along the thread are 0
//!         steps      first differences along the thread are 0
//!         for the crossing before and the one after, and the next ones of the same level:
//!             meeting: on the same side     the thread clears the shoulder under its upper end
//!                      on the other side    it fits between the two threads that it passes
//!         for the nearest threads of its level, before and after:
//!             neighbour                     they are clear side by side
//!         for the threads beside it, if they have another level:
//!             stacked                       they are clear as ellipses
//!     contact        end and pick lie one on top of the other, and touch if they are of one layer
//! ```
//!
//! A term that depends on several crossings is computed at each of them. Each crossing keeps the
//! slopes by its own unknowns only, so that terms are gathered and nothing is scattered. In the
//! energy each term counts once.

use super::contacts::{Contact, MARGIN, NEAR};
use super::here::{HEIGHT, Here, SHIFT, THICKNESS, WIDTH};
use super::{CrossingBlock, CrossingState, CrossingsPass, CrossingsPlan, Row, Set, Site};

/// The weight of second differences of heights, times the fourth power of a diameter over the third
/// power of a pitch. With half the value, and with twice, no test is red.
pub const BEND: f32 = 1.0;
/// The weight of second differences of shifts, in the same units as [`BEND`]. It is higher than
/// [`BEND`] because skewed threads collide at corners that the passage term does not cover. 5, 20,
/// 80 and 120 were tried. With 80, denim lacks a hundredth of its room
/// (`cloths_of_the_mills_come_to_rest` of texere-fabric).
pub const SIDEWAYS_BEND: f32 = 120.0;

/// The weight of first differences of heights, times the square of a diameter over a pitch. With
/// half the value, and with twice, no test is red.
pub const TENSION: f32 = 1.0;
/// The weight of first differences of shifts, in the same units as [`TENSION`]. With twice the
/// value, `layers_lie_on_one_another` is red; with half, no test is.
pub const SIDEWAYS_TENSION: f32 = 0.1;

/// The weight of heights, times the square of a diameter, by which a finish presses the cloth flat.
/// With 0, `energy_goes_down_while_penalties_stay` fails.
pub const PRESS: f32 = 0.6;

/// The weight of first differences of half widths and half heights along a thread, in radii. With
/// 0, a 2/2 twill does not come to rest (`cloths_of_the_mills_come_to_rest`).
pub const SMOOTH: f32 = 3.0;

/// The weight of area that a section has lost. With half the value, and with twice,
/// `plied_threads_rest_near_single_ones` is red.
pub const AREA_LOSS: f32 = 6.0;
/// The weight of area that a section lacks to its least area, as a multiple of the weight of
/// penalties, so that contacts give way before fibres do. 1, 3 and 10 were tried, and differ
/// little.
pub const SOLID: f32 = 10.0;
/// The weight of area that a section has gained. With half the value, `turns_do_not_fold` is red;
/// with twice, `layers_lie_on_one_another`.
pub const AREA_GAIN: f32 = 100.0;

impl CrossingsPlan {
    /// The equations of the crossing at `site`, gathered from all terms that depend on the
    /// crossing. `crossings` are the states of all crossings.
    ///
    /// **Panics** if `crossings` has fewer crossings than the plan.
    #[must_use]
    pub fn block(&self, pass: &CrossingsPass, crossings: &[CrossingState], site: Site) -> CrossingBlock {
        let mut block = CrossingBlock::NOTHING;
        let both =
            Set::BOTH.map(|set| Here { plan: self, pass, all: crossings, site, set, row: set.first() });
        // The contact is seen first. Passages and neighbours that are clearer than the contact can
        // be left out.
        let contact = Contact::new(&both);
        block.see(contact.clearance());
        for here in both {
            let set = here.set;
            here.own(&mut block);
            here.bends(&mut block);
            here.steps(&mut block);
            for steps in [-1, 1] {
                here.meeting(&mut block, steps);
            }
            for (sign, steps) in here.of_level(set) {
                here.neighbour(&mut block, sign * steps);
                if steps != 1 {
                    here.stacked(&mut block, sign);
                }
            }
            for (sign, steps) in here.of_level(set.other()) {
                if steps > 1 {
                    here.meeting(&mut block, sign * steps);
                }
            }
        }
        contact.add(&mut block);
        for here in both {
            if here.thread_row().freedom == 0.0 {
                block.hold(here.row + SHIFT);
            }
        }
        block
    }
}

impl Here<'_> {
    /// Adds the thread's own terms: shape, area, least area, and press.
    fn own(&self, block: &mut CrossingBlock) {
        let (lie, row) = (self.thread(self.site), self.row);
        let Row { radius, least_area, aspect, shape, .. } = *self.thread_row();
        let (wide, thick) = (lie.half_width / radius, lie.half_height / radius);
        let slopes = [(row + WIDTH, 1.0 / radius), (row + THICKNESS, -aspect / radius)];
        block.add(shape, 1.0, wide - aspect * thick, slopes);
        let gain = wide * thick - self.pass.area;
        // A section a little below its full area grows no faster than a section beyond its full
        // area shrinks. Otherwise the section would grow beyond its area in one pass, and shrink
        // back in the next, without end.
        let weight = if gain < -NEAR { AREA_LOSS } else { AREA_GAIN };
        let residual = if gain < 0.0 { AREA_LOSS / weight * gain } else { gain };
        let slopes = [(row + WIDTH, thick / radius), (row + THICKNESS, wide / radius)];
        block.add(weight, 1.0, residual, slopes);
        let room = wide * thick - least_area * self.pass.area - MARGIN;
        if room < NEAR {
            block.add(SOLID * self.pass.penalty, 1.0, room.min(0.0), slopes);
        }
        let press = PRESS * self.plan.press() * 4.0 * radius * radius;
        block.add(press, 1.0, lie.height, [(row + HEIGHT, 1.0)]);
    }

    /// Adds bending: second differences along the thread, at this crossing and at the crossings
    /// before and after.
    fn bends(&self, block: &mut CrossingBlock) {
        let thread = self.thread_row();
        let square = 4.0 * thread.radius * thread.radius;
        for middle in [-1, 0, 1] {
            let Some(before) = self.along(middle - 1) else { continue };
            let Some(at) = self.along(middle) else { continue };
            let Some(after) = self.along(middle + 1) else { continue };
            let pitch = 0.5 * (self.pitch(before) + self.pitch(at));
            let stiff = thread.stiffness * square * square / (pitch * pitch * pitch);
            // The slopes of a second difference are 1, -2 and 1.
            let (slope, share) = if middle == 0 { (-2.0, 2.0) } else { (1.0, 4.0) };
            let (before, at, after) = (self.thread(before), self.thread(at), self.thread(after));
            let bend = before.height - 2.0 * at.height + after.height;
            block.add(BEND * stiff, share, bend, [(self.row + HEIGHT, slope)]);
            let bend = before.shift - 2.0 * at.shift + after.shift;
            block.add(SIDEWAYS_BEND * stiff, share, bend, [(self.row + SHIFT, slope)]);
        }
    }

    /// Adds first differences along the thread: tension, and the evenness of sections. A taut
    /// thread that changes sides between two crossed threads pulls these two apart, so that ends
    /// and picks that work as one close up.
    fn steps(&self, block: &mut CrossingBlock) {
        let (lie, radius) = (self.thread(self.site), self.thread_row().radius);
        let tension = self.plan.tension(self.set) * 4.0 * radius * radius;
        let smooth = SMOOTH / (radius * radius);
        for steps in [-1, 1] {
            let Some(site) = self.along(steps) else { continue };
            let other = self.thread(site);
            let gap = self.pitch(if steps < 0 { site } else { self.site });
            let (taut, crossed, sign) = (tension / gap, self.set.other(), steps as f32);
            let [from, to] = [self.site, site].map(|site| self.crossing(site).thread(crossed).shift);
            let span = gap + sign * (to - from);
            let shorter = (gap / span).sqrt();
            let rise = shorter * (lie.height - other.height);
            let slopes = [(self.row + HEIGHT, shorter), (crossed.first() + SHIFT, 0.5 * sign * rise / span)];
            block.add(TENSION * taut, 2.0, rise, slopes);
            block.add(SIDEWAYS_TENSION * taut, 2.0, lie.shift - other.shift, [(self.row + SHIFT, 1.0)]);
            block.add(smooth, 2.0, lie.half_width - other.half_width, [(self.row + WIDTH, 1.0)]);
            block.add(smooth, 2.0, lie.half_height - other.half_height, [(self.row + THICKNESS, 1.0)]);
        }
    }
}
