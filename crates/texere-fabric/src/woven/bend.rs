//! How threads bend round the threads that they cross: depths of threads, and the shoulders of
//! threads that change sides.

use super::crossing;
use super::shape::{Set, Shape};

/// Distance of a shoulder from its crossing, as a multiple of half the width of the crossed thread
/// plus half the height of the thread itself. A shoulder is the control point beside a crossing of
/// a thread that changes sides. [`SHOULDER_MOST`] makes the distance smaller if the next crossing
/// is near, and [`STRIDE`] makes the distance larger if the next crossing is far. With half the
/// value, `the_search_for_cures_stops_when_it_is_asked_to` is red; with twice,
/// `straight_ends_have_no_crimp_and_the_weft_has_it_all`.
const SHOULDER: f32 = 0.7;

/// The largest distance of a shoulder, as a share of the way to the next crossing. It was found in
/// the trials that [`FALL`] describes. With half the value, and with twice,
/// `the_search_for_cures_stops_when_it_is_asked_to` is red.
const SHOULDER_MOST: f32 = 0.32;

/// The largest fall of a shoulder below the crossing, as a multiple of the distance between the two
/// centrelines at the crossing.
///
/// Deeper shoulders bend threads less and bring them nearer to one another. Places and depths of
/// shoulders were tried on plain weave, 3/1 and 2/2 twill, matt, satins, damask and random weaves.
/// Some places and depths keep threads at 0.99 of touching, whether the threads are alike or not,
/// round or flat. Among these, the values in this file bend threads least tightly. The tightest
/// bend of round threads of one size has a radius of 1.7 yarn radii at a pitch of 3 diameters, 1.4
/// at 2.5, 1.05 at 2, 0.95 at 1.9 and 0.83 at 1.8. Below 1.95 diameters the threads fold. Trials
/// with separate values for round threads of one size, and for shoulders beside floats, gave a
/// radius of 1.03 yarn radii at 1.8 diameters. At the least pitch at which threads are not jammed,
/// the best trial gave 0.88.
const FALL: f32 = 0.155;

/// The largest fall of a shoulder, as a share of the fall of a circle round the crossed thread.
/// With half the value, `round_threads_alike_stay_clear_from_the_least_pitch_on` is red; with
/// twice, `threads_that_are_cut_off_close_to_their_last_crossing_stay_clear`.
const FALL_OF_CIRCLE: f32 = 0.75;

/// The steepest slope that a shoulder may give a thread at a crossing between a float and a change
/// of sides. Two threads that both slope come nearer to one another beside the crossing. A slope of
/// s takes a share of about s²/2 from their distance. With half the value,
/// `a_fold_is_reported_with_its_place` is red; with twice, `doubled_ends_and_picks_just_touch`.
const TILT: f32 = 0.06;

/// The largest fall of a thread from the edge thread to the place where it leaves the cloth, as a
/// multiple of the distance between the two centrelines at the edge thread. With a larger fall the
/// thread tilts at the crossing with the edge thread, if its shoulder towards a distant neighbour
/// lies low. With half the value, and with twice, `threads_of_all_sizes_and_spacings_stay_clear` is
/// red.
const FALL_OUT: f32 = 0.2;

/// The longest step to the next control point, as a multiple of the step before.
///
/// The spline's parameter runs from 0 to 1 in every interval, long or short. After a long interval
/// the spline enters a short one at a high speed, and bends sharply where it slows down. If an
/// interval is five times as long as the next one, or longer, the spline turns back. With half the
/// value, and with twice, `a_long_float_beside_a_close_pitch_is_stepped_through` is red.
pub(super) const STRIDE: f32 = 3.34;

/// The share by which a length must differ from a stride to count as another length. A shoulder may
/// lie exactly a stride away. Rounding must not decide whether it counts as further away.
pub(super) const ROUNDING: f32 = 1e-3;

/// Threads of one thickness, with the threads that they cross.
#[derive(Clone, Copy)]
pub(super) struct Bend<'a> {
    pub(super) shape: Shape,
    /// The threads that they cross.
    pub(super) crossed: &'a Set,
    /// Half the height of the threads that bend, with the room that their twist needs, mm.
    pub(super) half_height: f32,
    /// At a crossing, the bending threads' share of the distance between the two centrelines.
    pub(super) share: f32,
}

impl Bend<'_> {
    /// Distance between the crossings `from` and `to`, mm.
    pub(super) fn pitch(&self, from: usize, to: usize) -> f32 {
        (self.crossed.at[to] - self.crossed.at[from]).abs()
    }

    /// Distance between the centrelines at crossing `number`, mm: the sum of both half heights.
    pub(super) fn apart(&self, number: usize) -> f32 {
        self.half_height + self.crossed.half_height[number]
    }

    /// Distance of the thread from the cloth's middle at crossing `number`, up or down, mm.
    pub(super) fn depth(&self, number: usize) -> f32 {
        let apart = self.apart(number);
        match self.shape {
            Shape::Crossing => self.share * apart * crossing::swing(self.crossed.pitch[number] / apart),
            Shape::Round => self.share * apart,
        }
    }

    /// The shoulder at crossing `number` towards a neighbour `pitch` away: its distance from the
    /// crossing, and its distance from the cloth's middle, mm.
    ///
    /// The thread goes a little outside a circle round the crossed thread. For flat threads the
    /// circle is stretched sideways, to the radius `across`.
    ///
    /// If the neighbour is far away, the shoulder slides down the line to the middle between the
    /// two crossings, so that no step is longer than [`STRIDE`] times the step before.
    pub(super) fn shoulder(&self, number: usize, pitch: f32) -> (f32, f32) {
        let (apart, depth) = (self.apart(number), self.depth(number));
        let across = self.crossed.half_width[number] + self.half_height;
        // Close threads far from the cloth's edge may be rounded to one place.
        if pitch <= 0.0 {
            return (0.0, 0.5 * depth);
        }
        let near = (SHOULDER * across).min(SHOULDER_MOST * pitch);
        let aside = near.max(pitch / STRIDE);
        let slid = (0.5 * pitch - aside) / (0.5 * pitch - near);
        let fall = FALL.min(FALL_OF_CIRCLE * circle(near, across)) * apart;
        (aside, (depth - fall).max(0.5 * depth) * slid)
    }

    /// Height of the shoulder at crossing `number` towards the neighbour `one`, from the cloth's
    /// middle, mm. The thread changes sides between the two. `other` is the neighbour on the other
    /// side, if any, and `both` says whether the thread changes sides there too.
    ///
    /// If `both` is set, both shoulders have the height of the higher one, so that the thread is
    /// level at the crossing. Beside a short float a shoulder falls less.
    pub(super) fn shoulder_z(&self, number: usize, one: usize, other: Option<usize>, both: bool) -> f32 {
        let (aside, z) = self.shoulder(number, self.pitch(number, one));
        let Some(other) = other else {
            let edge = if number < one { 0.0 } else { self.crossed.extent };
            let out = (edge - self.crossed.at[number]).abs();
            // If the edge is further away than the shoulder, the thread is level at the crossing.
            let level = if out < aside { self.lowest_out(number, out) - TILT * (aside + out) } else { 0.0 };
            return z.max(level).max(0.0);
        };
        let pitch = self.pitch(number, other);
        if both {
            return z.max(self.shoulder(number, pitch).1);
        }
        // A neighbour just a stride away counts as far, which makes the shoulder fall less. Without
        // this, threads of unlike spacing came to 0.9896 of touching, not 0.99.
        let far = pitch > (1.0 - ROUNDING) * STRIDE * aside;
        let step = if far { (STRIDE - 1.0) * aside } else { pitch };
        z.max(self.depth(number) - TILT * (step + aside))
    }

    /// Height of a thread where it leaves the cloth at the distance `aside` from crossing `number`,
    /// mm. If the thread changes sides on the other side of the crossing, the height is about that
    /// of the shoulder there, so that the thread is level at the crossing. If the thread keeps its
    /// side there, or the shape is [`Shape::Crossing`], the height is that at the crossing. If the
    /// edge is near, the thread falls no further than a shoulder at that distance may fall.
    pub(super) fn leaving_z(&self, number: usize, aside: f32, above: impl Fn(usize) -> bool) -> f32 {
        let depth = self.depth(number);
        let beyond = if number == 0 { 1 } else { number - 1 };
        let changes = beyond < self.crossed.at.len() && above(beyond) != above(number);
        let z = if self.shape == Shape::Round && changes {
            self.shoulder_z(number, beyond, None, false).max(self.lowest_out(number, aside))
        } else {
            depth
        };
        if above(number) { z } else { -z }
    }

    /// The least height of a thread where it leaves the cloth at the distance `aside` from crossing
    /// `number`, mm.
    fn lowest_out(&self, number: usize, aside: f32) -> f32 {
        let across = self.crossed.half_width[number] + self.half_height;
        let fall = FALL_OUT.min(FALL_OF_CIRCLE * circle(aside.min(across), across));
        self.depth(number) - fall * self.apart(number)
    }
}

/// The fall of a circle of radius `across` at the distance `aside` from its top, in radii.
fn circle(aside: f32, across: f32) -> f32 {
    1.0 - (1.0 - (aside / across).powi(2)).sqrt()
}
