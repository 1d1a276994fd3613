//! The course of one thread over and under those that it crosses.

use texere_core::Section;

use super::{Thread, crossing};

/// How many control points a thread gets, and where.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Shape, Thread, Weave, Woven};
/// let thread = Thread::new(0.4, 0.1);
/// let plain = Weave::parse("plain")?.drawdown(3, 2)?;
/// let mut cloth =
///     Woven::new(plain, vec![thread; 3], vec![thread; 2], vec![Material::default()], vec![Section::Circle])?;
/// cloth.set_shape(Shape::Crossing);
/// assert_eq!(cloth.point_count(), 3 * 4 + 2 * 5);
/// // Each end changes sides once, each pick twice.
/// cloth.set_shape(Shape::Round);
/// assert_eq!(cloth.point_count(), 3 * (4 + 3) + 2 * (5 + 6));
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Shape {
    /// One control point a crossing, and one before and after: the paper's count. Threads swing out further than they
    /// are thick, so that the corners that the spline cuts stay clear; floats bulge.
    Crossing,
    /// Threads bend round one another as round threads do, and floats lie flat: three more control points wherever a
    /// thread changes sides (and a few within floats that are long beside a close pitch).
    #[default]
    Round,
}

/// The threads of one direction, as tables for those that cross them.
pub(super) struct Set {
    /// Where each thread lies, mm.
    pub(super) at: Vec<f32>,
    /// Half the width of each thread's section, mm.
    pub(super) half_width: Vec<f32>,
    /// Half the height of each thread's section, mm.
    pub(super) half_height: Vec<f32>,
    /// Mean distance of each thread to its neighbours, mm.
    pitch: Vec<f32>,
    /// Sum of all spacings, mm: where a yarn that crosses them ends.
    pub(super) extent: f32,
}

impl Set {
    pub(super) fn new(threads: &[Thread], sections: &[Section]) -> Self {
        let widths: Vec<f32> = sections.iter().map(Section::half_width).collect();
        let heights: Vec<f32> = sections.iter().map(Section::half_height).collect();
        // The first thread lies half its spacing inside the cloth, the last half its own.
        let mut edge = -threads.first().map_or(0.0, |thread| thread.spacing_mm) / 2.0;
        let at = threads.iter().map(|thread| {
            edge += thread.spacing_mm;
            edge as f32
        });
        let at = at.collect();
        let last = threads.last().map_or(0.0, |thread| thread.spacing_mm);
        let after = threads.iter().skip(1).map(|thread| thread.spacing_mm).chain([last]);
        let size = |of: &[f32]| {
            threads.iter().map(|thread| thread.radius_mm * of[thread.section as usize]).collect()
        };
        Self {
            at,
            half_width: size(&widths),
            half_height: size(&heights),
            pitch: threads
                .iter()
                .zip(after)
                .map(|(own, after)| ((own.spacing_mm + after) / 2.0) as f32)
                .collect(),
            extent: (edge + last / 2.0) as f32,
        }
    }
}

/// How far from a crossing, in distances that the two centrelines keep there, a thread that changes sides has its
/// shoulder; at most [`SHOULDER_MOST`] of the way.
const SHOULDER: f32 = 0.7;

/// The most of the way to the next crossing that a shoulder may be away.
const SHOULDER_MOST: f32 = 0.32;

/// How far a shoulder lies below the crossing at most, in distances that the two centrelines keep there.
///
/// Deeper shoulders bend threads less and bring them nearer to one another. Of the places and depths tried on plain weave,
/// 3/1 and 2/2 twill, matt, satins, damask and random weaves these bend least tightly among those that keep threads at
/// 0.99 of touching, alike or not, round or flat. Of round threads alike the tightest bend has 1.7 radii at 3 diameters,
/// 1.4 at 2.5, 1.05 at 2, 0.95 at 1.9 and 0.83 at 1.8: below 1.95 diameters they fold. Three points need not: with
/// places and depths of their own for round threads alike, and others beside floats, 1.03 was found at 1.8 diameters.
/// But at the least pitch 0.88 was the best.
const FALL: f32 = 0.155;

/// The most that a shoulder falls, in what a circle round the crossed thread has fallen there.
const FALL_OF_CIRCLE: f32 = 0.75;

/// How steeply a thread may lie at a crossing between a float and a change of sides, as far as its shoulder decides: two
/// threads that both do come nearer to one another beside the crossing, by half the square of it each.
const TILT: f32 = 0.06;

/// How far a thread falls at most from the edge thread to where it leaves the cloth, in distances that the two
/// centrelines keep there. Further, and its crossing tilts where the shoulder beside a distant neighbour lies low.
const FALL_OUT: f32 = 0.2;

/// The longest step to the next control point, in steps before it.
///
/// The spline runs through all of its intervals in the same time: out of a long one it comes into a short one so fast
/// that it bends sharply where it slows down, from five on so that it turns back.
const STRIDE: f32 = 3.34;

/// One thread and what it crosses.
pub(super) struct Course<'a> {
    pub(super) shape: Shape,
    /// The threads that it crosses.
    pub(super) crossed: &'a Set,
    /// Half the height of its own section, mm.
    pub(super) half_height: f32,
    /// Its share of the distance that two centrelines keep at a crossing.
    pub(super) share: f32,
    /// Whether it runs against the order of the crossed threads.
    pub(super) back: bool,
}

/// A control point of a thread's course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    /// Place along the thread, mm.
    pub(super) along: f32,
    /// Height, mm.
    pub(super) z: f32,
    /// The crossed thread at which, or next to which, it lies; none at a cut end.
    pub(super) crossing: Option<usize>,
}

impl Course<'_> {
    /// Calls `stop` with each control point in order. `above` says on which side of each crossed thread the thread lies,
    /// `cut` whether it is cut off at the cloth's edge at its beginning and at its end.
    pub(super) fn walk(&self, above: impl Fn(usize) -> bool, cut: [bool; 2], mut stop: impl FnMut(Stop)) {
        let at = &self.crossed.at;
        let count = at.len();
        let number = |step: usize| if self.back { count - 1 - step } else { step };
        let edge = |first: bool| if first == self.back { self.crossed.extent } else { 0.0 };
        let (first, last) = (number(0), number(count - 1));
        // The shoulder of the last change of sides, from the crossing that it led to.
        let mut arrived = None;
        if cut[0] {
            let after = (count > 1).then(|| self.leaving(first, number(1), &above)).flatten();
            stop(Stop { along: edge(true), z: self.cut_z(first, &above), crossing: None });
            self.float(edge(true), at[first], [None, after], [first; 2], &above, &mut stop);
        }
        for step in 0..count {
            let here = number(step);
            let z = self.level(here, above(here));
            stop(Stop { along: at[here], z, crossing: Some(here) });
            if step + 1 == count {
                break;
            }
            let next = number(step + 1);
            if self.leaving(here, next, &above).is_some() {
                self.change_sides(here, next, &above, &mut stop);
                arrived = self.leaving(next, here, &above);
            } else {
                let after =
                    (step + 2 < count).then(|| self.leaving(next, number(step + 2), &above)).flatten();
                self.float(at[here], at[next], [arrived.take(), after], [here, next], &above, &mut stop);
            }
        }
        if cut[1] {
            self.float(at[last], edge(false), [arrived, None], [last; 2], &above, &mut stop);
            stop(Stop { along: edge(false), z: self.cut_z(last, &above), crossing: None });
        }
    }

    /// How far from crossing `from` the thread has its shoulder towards `to`, mm, if it changes sides between them.
    fn leaving(&self, from: usize, to: usize, above: impl Fn(usize) -> bool) -> Option<f32> {
        let changes = self.shape == Shape::Round && above(from) != above(to);
        changes.then(|| self.shoulder(from, (self.crossed.at[to] - self.crossed.at[from]).abs()).0)
    }

    /// Distance between the centrelines at crossing `number`: half the heights of both sections together, mm.
    fn room(&self, number: usize) -> f32 {
        self.half_height + self.crossed.half_height[number]
    }

    /// How far the thread lies from the cloth's middle at crossing `number`, up or down, mm.
    fn depth(&self, number: usize) -> f32 {
        let room = self.room(number);
        match self.shape {
            Shape::Crossing => self.share * room * crossing::swing(self.crossed.pitch[number] / room),
            Shape::Round => self.share * room,
        }
    }

    /// The shoulder at crossing `number` towards a neighbour `pitch` away: how far from the crossing, and its distance
    /// from the cloth's middle, mm.
    ///
    /// The thread goes a little outside of a circle round the crossed one, which flat threads stretch to `across`.
    ///
    /// Where the neighbour is far away, it slides down the line to the middle between the two, so that no step is longer
    /// than [`STRIDE`] shorter ones.
    fn shoulder(&self, number: usize, pitch: f32) -> (f32, f32) {
        let (room, depth) = (self.room(number), self.depth(number));
        let across = self.crossed.half_width[number] + self.half_height;
        // Close threads far from the edge may lie in one place once rounded.
        if pitch <= 0.0 {
            return (0.0, 0.5 * depth);
        }
        let near = (SHOULDER * across).min(SHOULDER_MOST * pitch);
        let aside = near.max(pitch / STRIDE);
        let slid = (0.5 * pitch - aside) / (0.5 * pitch - near);
        let circle = 1.0 - (1.0 - (near / across).powi(2)).sqrt();
        let fall = FALL.min(FALL_OF_CIRCLE * circle) * room;
        (aside, (depth - fall).max(0.5 * depth) * slid)
    }

    /// Height of the shoulders at crossing `number`, from the cloth's middle, mm, if it has any.
    ///
    /// Where the thread changes sides both before and after, it is that of the higher one, so that at the crossing itself
    /// the thread is level. Beside a short float a shoulder falls less.
    fn shoulder_z(&self, number: usize, above: impl Fn(usize) -> bool) -> Option<f32> {
        let at = &self.crossed.at;
        let pitch = |other: usize| (at[other] - at[number]).abs();
        let changes = |other: &usize| above(*other) != above(number);
        let (before, after) = (number.checked_sub(1), Some(number + 1).filter(|next| *next < at.len()));
        let (one, float) = match (before.filter(changes), after.filter(changes)) {
            (None, None) => return None,
            (Some(before), Some(after)) => {
                let [before, after] = [before, after].map(|other| self.shoulder(number, pitch(other)).1);
                return Some(before.max(after));
            }
            (Some(before), None) => (before, after),
            (None, Some(after)) => (after, before),
        };
        let (aside, z) = self.shoulder(number, pitch(one));
        let least = float.map_or(0.0, |float| {
            let step = if pitch(float) > STRIDE * aside { (STRIDE - 1.0) * aside } else { pitch(float) };
            self.depth(number) - TILT * (step + aside)
        });
        Some(z.max(least))
    }

    /// The points between the neighbours `from` and `to`, on different sides of which the thread lies.
    fn change_sides(
        &self,
        from: usize,
        to: usize,
        above: impl Fn(usize) -> bool,
        stop: &mut impl FnMut(Stop),
    ) {
        let (start, end) = (self.crossed.at[from], self.crossed.at[to]);
        let pitch = (end - start).abs();
        let (leave, reach) = (self.shoulder(from, pitch).0, self.shoulder(to, pitch).0);
        let [high, low] = [from, to].map(|number| self.shoulder_z(number, &above).unwrap_or(0.0));
        let forward = (end - start).signum();
        let side = if above(from) { 1.0 } else { -1.0 };
        let (start, end) = (start + forward * leave, end - forward * reach);
        // Nearer to the thinner of the two.
        let rooms = [self.room(from), self.room(to)];
        let share = rooms[0] / (rooms[0] + rooms[1]);
        stop(Stop { along: start, z: side * high, crossing: Some(from) });
        stop(Stop { along: start + share * (end - start), z: 0.0, crossing: Some(from) });
        stop(Stop { along: end, z: -side * low, crossing: Some(to) });
    }

    /// The points within a float from `start` to `end`, next to the crossings `sides`, where the steps before and after
    /// it (`beside`, mm) are so short that a single step would be too long. Evenly spaced threads need none.
    fn float(
        &self,
        start: f32,
        end: f32,
        beside: [Option<f32>; 2],
        sides: [usize; 2],
        above: impl Fn(usize) -> bool,
        stop: &mut impl FnMut(Stop),
    ) {
        // A share of 1e-3 more, so that rounding adds no point where threads are evenly spaced.
        let too_long = |left: f32, step: f32| step > 0.0 && left > 1.001 * STRIDE * step;
        let forward = (end - start).signum();
        let level = |number| self.level(number, above(number));
        let mut left = (end - start).abs();
        let mut at = start;
        let mut step = beside[0].unwrap_or(left);
        while too_long(left, step) {
            step *= STRIDE - 1.0;
            left -= step;
            at += forward * step;
            stop(Stop { along: at, z: level(sides[0]), crossing: Some(sides[0]) });
        }
        // From the other end the steps grow against the thread's direction: the last one found comes first.
        let step = beside[1].unwrap_or(left);
        let mut steps = 0;
        let mut rest = left;
        while too_long(rest, step * (STRIDE - 1.0).powi(steps)) {
            steps += 1;
            rest -= step * (STRIDE - 1.0).powi(steps);
        }
        at += forward * rest;
        for remaining in (1..=steps).rev() {
            stop(Stop { along: at, z: level(sides[1]), crossing: Some(sides[1]) });
            at += forward * step * (STRIDE - 1.0).powi(remaining);
        }
    }

    /// Height of the thread at crossing `number`, mm.
    fn level(&self, number: usize, above: bool) -> f32 {
        if above { self.depth(number) } else { -self.depth(number) }
    }

    /// Height of the thread where it is cut off next to crossing `number`, mm.
    fn cut_z(&self, number: usize, above: impl Fn(usize) -> bool) -> f32 {
        match self.shape {
            Shape::Crossing => 0.0,
            Shape::Round => self.leaving_z(number, above),
        }
    }

    /// Height of the thread where it leaves the cloth next to crossing `number`, mm: about that of the shoulder on the
    /// other side, so that it is level at the crossing, or that of the float there.
    pub(super) fn leaving_z(&self, number: usize, above: impl Fn(usize) -> bool) -> f32 {
        let shoulder = if self.shape == Shape::Round { self.shoulder_z(number, &above) } else { None };
        let depth = self.depth(number);
        let z = shoulder.map_or(depth, |z| z.max(depth - FALL_OUT * self.room(number)));
        if above(number) { z } else { -z }
    }
}
