//! The yarns in both shapes, interval by interval.

use std::ops::Range;

use glam::{DVec2, DVec3, Vec3A};
use rayon::prelude::*;
use texere_core::backend::room_for;
use texere_core::definitions::tangent_factor;
use texere_core::{Boundary, ControlPoint, YarnError, Yarns};

use super::passage::{WINDOW_INTERVALS, WINDOW_REACH};
use super::strand::Strand;
use crate::ContactError;
use crate::grid::Bounds;

/// Number of control points whose moves one task adds up.
const SUMMED: usize = 1 << 14;

/// One of the two shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Before,
    After,
}

/// Consecutive intervals of one yarn.
#[derive(Debug)]
pub(super) struct Span {
    yarn: usize,
    intervals: Range<usize>,
}

/// Motion of an interval against the cloth as a whole, and the margin within which other intervals
/// count as near.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Motion {
    /// The furthest motion of any place of the interval, mm.
    moved: f32,
    /// Two intervals are near if they come within the sum of their margins, mm.
    pub(super) margin: f32,
}

impl Motion {
    /// Whether the interval has moved further than its margin. If two intervals have met without
    /// being near before, at least one of them has moved further than its margin.
    pub(super) fn is_far(&self) -> bool {
        self.moved > self.margin
    }
}

/// Yarns in two shapes. An interval's number is that of the control point that it starts
/// from, counted over the fabric.
#[derive(Debug)]
pub(super) struct Shapes<'a> {
    yarns: [&'a Yarns; 2],
    boundary: &'a Boundary,
    /// The factor of the spline's tangents.
    s: f64,
    /// The motion of each interval, by its number.
    motions: Vec<Motion>,
}

impl<'a> Shapes<'a> {
    /// The shapes `before` and `after`, with the motion of each interval.
    ///
    /// **Errors**: [`ContactError::OtherLayout`], [`ContactError::Yarns`] for another tension,
    /// [`ContactError::OutOfMemory`].
    pub(super) fn new(
        before: &'a Yarns,
        after: &'a Yarns,
        boundary: &'a Boundary,
    ) -> Result<Self, ContactError> {
        let [one, other] = [before, after].map(|yarns| yarns.layout());
        if one.offsets() != other.offsets() || one.yarns() != other.yarns() {
            let ends = one.offsets().iter().zip(other.offsets()).skip(1);
            let both = one.yarns().iter().zip(other.yarns()).zip(ends);
            let alike = both.take_while(|((one, other), (end, other_end))| one == other && end == other_end);
            return Err(ContactError::OtherLayout { yarn: alike.count() });
        }
        let [tension, given] = [one.tension(), other.tension()];
        if given != tension {
            return Err(YarnError::OtherTension { given, tension }.into());
        }
        let s = tangent_factor(tension);
        let mut shapes = Self { yarns: [before, after], boundary, s, motions: Vec::new() };
        let mut motions = Vec::new();
        room_for(&mut motions, before.points().len(), "how far control points have moved")?;
        let shift = shift(before.points(), after.points()).as_vec3a();
        (0..before.points().len())
            .into_par_iter()
            .map(|number| shapes.measure(number, shift))
            .collect_into_vec(&mut motions);
        shapes.motions = motions;
        Ok(shapes)
    }

    /// A yarn before and after.
    pub(super) fn strands(&self, yarn: usize) -> [Strand<'a>; 2] {
        let onward = DVec2::from_array(self.boundary.onward_mm(yarn)).extend(0.0);
        let ends = self.boundary.ends()[yarn];
        self.yarns.map(|yarns| Strand {
            points: yarns.yarn_points(yarn).unwrap_or(&[]),
            ends,
            onward,
            s: self.s,
        })
    }

    /// The yarn that an interval belongs to, and the interval's number in it.
    pub(super) fn yarn_of(&self, number: usize) -> (usize, usize) {
        let offsets = self.yarns[0].layout().offsets();
        let yarn = offsets.partition_point(|&start| start <= number as u64).saturating_sub(1);
        (yarn, number - offsets[yarn] as usize)
    }

    /// The source of an interval's middle, as [`YarnPlace`](texere_core::YarnPlace) defines it.
    /// None if the yarns before have no sources.
    pub(super) fn source(&self, yarn: usize, interval: usize) -> Option<u32> {
        let range = self.yarns[0].range(yarn)?;
        let nearer = range.start + (interval + 1) % range.len();
        self.yarns[0].sources()?.get(nearer).copied()
    }

    /// All intervals in order, in spans of `most` at most.
    pub(super) fn spans(&self, most: usize) -> Vec<Span> {
        let yarns = self.boundary.ends().iter().zip(self.yarns[0].layout().offsets().windows(2)).enumerate();
        yarns
            .flat_map(|(yarn, (ends, offsets))| {
                let count = ends.intervals((offsets[1] - offsets[0]) as usize);
                let span = move |start: usize| Span { yarn, intervals: start..(start + most).min(count) };
                (0..count).step_by(most).map(span)
            })
            .collect()
    }

    /// The numbers of a span's intervals, each with a box in one shape that holds the interval and
    /// its margin.
    pub(super) fn rooms(&self, span: &Span, shape: Shape) -> impl Iterator<Item = (usize, Bounds)> {
        let strand = self.strands(span.yarn)[shape as usize];
        let first = self.yarns[0].layout().offsets()[span.yarn] as usize;
        span.intervals.clone().map(move |interval| {
            let number = first + interval;
            (number, room(strand.hull(interval).bounds(), self.motions[number].margin))
        })
    }

    /// The motion of interval `number`.
    pub(super) fn motion(&self, number: usize) -> Motion {
        self.motions[number]
    }

    /// Whether any interval has moved further than its margin.
    pub(super) fn any_is_far(&self) -> bool {
        self.motions.par_iter().any(Motion::is_far)
    }

    /// The motion of interval `number` against the mean motion `shift`.
    ///
    /// If two places move along straight lines and meet on the way, their distance before is no
    /// more than their motion against one another. The margin is the interval's motion, but at most
    /// a quarter of half a window.
    fn measure(&self, number: usize, shift: Vec3A) -> Motion {
        let (yarn, interval) = self.yarn_of(number);
        let strands = self.strands(yarn);
        if interval >= strands[0].ends.intervals(strands[0].points.len()) {
            return Motion::default();
        }
        let [before, after] = strands.each_ref().map(|strand| strand.hull(interval).chords());
        let moved = before.iter().zip(after).map(|(from, to)| (to - *from - shift).length_squared());
        let moved = moved.fold(0.0, f32::max).sqrt();
        let half = strands.iter().map(|strand| strand.half(interval)).fold(0.0, f32::max);
        let length = before[0].distance(before[1]) + before[1].distance(before[2]);
        // The linking integral of two windows that lie a quarter of a window apart is a third of
        // that of a passage.
        let most = (WINDOW_INTERVALS as f32 / 8.0 * length).max(WINDOW_REACH as f32 / 2.0 * half);
        Motion { moved, margin: moved.min(most) }
    }
}

/// A box with a margin round it, and a little more for rounding.
pub(super) fn room([low, high]: [Vec3A; 2], margin: f32) -> Bounds {
    let margin = margin + 4.0 * f32::EPSILON * low.abs().max(high.abs());
    Bounds { low: low - margin, high: high + margin }
}

/// Mean motion of all points, mm. It is the same to the bit for any number of threads.
fn shift(before: &[ControlPoint], after: &[ControlPoint]) -> DVec3 {
    let sum = |(before, after): (&[ControlPoint], &[ControlPoint])| -> DVec3 {
        let moves = before.iter().zip(after);
        moves.map(|(from, to)| to.position().as_dvec3() - from.position().as_dvec3()).sum()
    };
    let sums: Vec<DVec3> = before.par_chunks(SUMMED).zip(after.par_chunks(SUMMED)).map(sum).collect();
    sums.into_iter().sum::<DVec3>() / before.len().max(1) as f64
}
