//! How threads bend round those that they cross: depths of threads, and the shoulders of threads
//! that change sides.

use super::crossing;
use super::shape::{Set, Shape};

/// Distance of a shoulder from its crossing, in distances that the two centrelines keep there. A
/// shoulder is the control point beside a crossing of a thread that changes sides. It lies at most
/// [`SHOULDER_MOST`] of the way to the next crossing.
const SHOULDER: f32 = 0.7;

/// The greatest distance of a shoulder, as a share of the way to the next crossing.
const SHOULDER_MOST: f32 = 0.32;

/// The greatest fall of a shoulder below the crossing, in distances that the two centrelines keep
/// there.
///
/// Deeper shoulders bend threads less and bring them nearer to one another. Places and depths were
/// tried on plain weave, 3/1 and 2/2 twill, matt, satins, damask and random weaves. These bend
/// least tightly among those that keep threads at 0.99 of touching, alike or not, round or flat.
/// The tightest bend of round threads alike has 1.7 radii at 3 diameters, 1.4 at 2.5, 1.05 at 2,
/// 0.95 at 1.9 and 0.83 at 1.8: below 1.95 diameters they fold. Other places and depths, chosen for
/// round threads alike and others beside floats, came to 1.03 at 1.8 diameters. At the least pitch
/// 0.88 was the best.
const FALL: f32 = 0.155;

/// The greatest fall of a shoulder, as a share of the fall of a circle round the crossed thread.
const FALL_OF_CIRCLE: f32 = 0.75;

/// The steepest slope, as far as its shoulder decides, of a thread at a crossing between a float
/// and a change of sides. Two threads that both slope come nearer to one another beside the
/// crossing, by half the square of the slope each.
const TILT: f32 = 0.06;

/// The greatest fall of a thread from the edge thread to where it leaves the cloth, in distances
/// that the two centrelines keep there. With more its crossing tilts where the shoulder beside a
/// distant neighbour lies low.
const FALL_OUT: f32 = 0.2;

/// The longest step to the next control point, in steps before it.
///
/// The spline runs through all its intervals in the same time. Out of a long interval it comes into
/// a short one so fast that it bends sharply where it slows down. From a ratio of five on it turns
/// back.
pub(super) const STRIDE: f32 = 3.34;

/// The share by which a length must differ from a stride, so that rounding does not decide: a
/// shoulder may lie exactly a stride away.
pub(super) const ROUNDING: f32 = 1e-3;

/// Threads of one height, with the threads that they cross.
#[derive(Clone, Copy)]
pub(super) struct Bend<'a> {
    pub(super) shape: Shape,
    /// The threads that they cross.
    pub(super) crossed: &'a Set,
    /// Half the height of their own section, mm.
    pub(super) half_height: f32,
    /// Their share of the distance that two centrelines keep at a crossing.
    pub(super) share: f32,
}

impl Bend<'_> {
    /// Distance of the crossings `from` and `to`, mm.
    pub(super) fn pitch(&self, from: usize, to: usize) -> f32 {
        (self.crossed.at[to] - self.crossed.at[from]).abs()
    }

    /// Distance between the centrelines at crossing `number`: half the heights of both sections
    /// together, mm.
    pub(super) fn room(&self, number: usize) -> f32 {
        self.half_height + self.crossed.half_height[number]
    }

    /// Distance of the thread from the cloth's middle at crossing `number`, up or down, mm.
    pub(super) fn depth(&self, number: usize) -> f32 {
        let room = self.room(number);
        match self.shape {
            Shape::Crossing => self.share * room * crossing::swing(self.crossed.pitch[number] / room),
            Shape::Round => self.share * room,
        }
    }

    /// The shoulder at crossing `number` towards a neighbour `pitch` away: its distance from the
    /// crossing and from the cloth's middle, mm.
    ///
    /// The thread goes a little outside a circle round the crossed thread. Flat threads stretch
    /// that circle to `across`.
    ///
    /// Where the neighbour is far away the shoulder slides down the line to the middle between the
    /// two, so that no step is longer than [`STRIDE`] times the step before.
    pub(super) fn shoulder(&self, number: usize, pitch: f32) -> (f32, f32) {
        let (room, depth) = (self.room(number), self.depth(number));
        let across = self.crossed.half_width[number] + self.half_height;
        // Close threads far from the edge may lie in one place once rounded.
        if pitch <= 0.0 {
            return (0.0, 0.5 * depth);
        }
        let near = (SHOULDER * across).min(SHOULDER_MOST * pitch);
        let aside = near.max(pitch / STRIDE);
        let slid = (0.5 * pitch - aside) / (0.5 * pitch - near);
        let fall = FALL.min(FALL_OF_CIRCLE * circle(near, across)) * room;
        (aside, (depth - fall).max(0.5 * depth) * slid)
    }

    /// Height of the shoulders at crossing `number`, from the cloth's middle, mm. The thread
    /// changes sides between that crossing and the neighbour `one`. `other` is the neighbour on the
    /// other side, if any, and `both` says whether the thread changes sides there too.
    ///
    /// If it does, both shoulders have the height of the higher one, so that the thread is level at
    /// the crossing. Beside a short float a shoulder falls less.
    pub(super) fn shoulder_z(&self, number: usize, one: usize, other: Option<usize>, both: bool) -> f32 {
        let (aside, z) = self.shoulder(number, self.pitch(number, one));
        let Some(other) = other else {
            let edge = if number < one { 0.0 } else { self.crossed.extent };
            let out = (edge - self.crossed.at[number]).abs();
            // An edge further away than the shoulder leaves the thread level at the crossing.
            let level = if out < aside { self.lowest_out(number, out) - TILT * (aside + out) } else { 0.0 };
            return z.max(level).max(0.0);
        };
        let pitch = self.pitch(number, other);
        if both {
            return z.max(self.shoulder(number, pitch).1);
        }
        // A neighbour just a stride away makes the shoulder fall less. Without that, threads of
        // unlike spacing came to 0.9896 of touching, not 0.99.
        let far = pitch > (1.0 - ROUNDING) * STRIDE * aside;
        let step = if far { (STRIDE - 1.0) * aside } else { pitch };
        z.max(self.depth(number) - TILT * (step + aside))
    }

    /// Height of a thread where it leaves the cloth `aside` of crossing `number`, mm. It is about
    /// that of the shoulder on the other side, so that the thread is level at the crossing, or that
    /// of the float there. Where the edge is near the thread falls no further than a shoulder so
    /// near may.
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

    /// The least height of a thread where it leaves the cloth `aside` of crossing `number`, mm.
    fn lowest_out(&self, number: usize, aside: f32) -> f32 {
        let across = self.crossed.half_width[number] + self.half_height;
        let fall = FALL_OUT.min(FALL_OF_CIRCLE * circle(aside.min(across), across));
        self.depth(number) - fall * self.room(number)
    }
}

/// The fall of a circle of radius `across` at `aside` of its top, in radii.
fn circle(aside: f32, across: f32) -> f32 {
    1.0 - (1.0 - (aside / across).powi(2)).sqrt()
}
