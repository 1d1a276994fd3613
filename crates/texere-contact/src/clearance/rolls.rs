//! Rolls of yarns as a mesh draws them.

use std::f64::consts::TAU;

use rayon::prelude::*;
use texere_core::backend::zeroed;
use texere_core::definitions::{Sampling, Segment, Turn, neighbours, tangent_factor};
use texere_core::{ControlPoint, Frame, PlanError, Section, YARN_RINGS_MAX, Yarn, Yarns};

use super::interval::Cubic;
use crate::ContactError;
use crate::watch::Watch;

/// Rolls of all yarns whose surface depends on them.
#[derive(Debug)]
pub(super) struct Rolls {
    sampling: Sampling,
    /// Frame and twist (turns per mm) of each yarn whose roll matters.
    twists: Vec<Option<(Frame, f32)>>,
    /// The roll at the beginning of each interval. Empty if no roll matters.
    starts: Vec<Turn>,
    /// For each yarn, the turn that is taken back from ring to ring, turns. It is a closed yarn's
    /// total turn divided by its steps, and 0 for an open yarn.
    given_back: Vec<f64>,
}

/// The rolls of one interval.
#[derive(Debug, Default)]
pub(super) struct IntervalRolls {
    /// Rolls at the interval's rings and at its end, turns, without jumps. Empty if rolls don't
    /// matter.
    at_rings: Vec<f64>,
    /// For a rotation-minimising frame: the twist (turns per mm), and the turn that is taken back
    /// from ring to ring (turns).
    minimizing: Option<(f32, f64)>,
}

impl Rolls {
    /// The rolls of all `yarns` in a mesh with `sampling` and `frame`.
    ///
    /// **Errors**: [`ContactError::Settings`] for a yarn of more rings than a plan allows,
    /// [`ContactError::OutOfMemory`], and [`ContactError::Cancelled`] if the caller of `watch` asks
    /// to stop.
    pub(super) fn new(
        yarns: &Yarns,
        sampling: Sampling,
        frame: Frame,
        watch: &Watch<'_>,
    ) -> Result<Self, ContactError> {
        let layout = yarns.layout();
        let twist = |(number, yarn): (usize, &Yarn)| {
            let turns = (f64::from(yarn.twist) / TAU) as f32;
            let turns_round = layout.sections()[yarn.section as usize] == Section::Circle;
            let frame = frame.of(layout.is_steep(number));
            (!turns_round && !frame.is_level(turns)).then_some((frame, turns))
        };
        let twists: Vec<_> = layout.yarns().iter().enumerate().map(twist).collect();
        let given_back = vec![0.0; twists.len()];
        let mut rolls = Self { sampling, twists, starts: Vec::new(), given_back };
        if rolls.twists.iter().all(Option::is_none) {
            return Ok(rolls);
        }
        let mut starts: Vec<Turn> = zeroed("rolls", yarns.points().len() as u64)?;
        let mut left = starts.as_mut_slice();
        let own = layout.offsets().windows(2).map(|ends| (ends[1] - ends[0]) as usize);
        let parts: Vec<_> = own.map(|count| left.split_off_mut(..count).unwrap_or_default()).collect();
        let given_back = parts.into_par_iter().enumerate().map(|(yarn, starts)| {
            watch.advance(0)?;
            rolls.along(yarns, yarn, starts)
        });
        rolls.given_back = given_back.collect::<Result<_, _>>()?;
        rolls.starts = starts;
        Ok(rolls)
    }

    /// Whether a yarn's surface depends on its rolls.
    pub(super) fn matter(&self, yarn: usize) -> bool {
        self.twists[yarn].is_some()
    }

    /// Writes the roll at each control point of a yarn, and returns the turn that is taken back
    /// from ring to ring, turns.
    fn along(&self, yarns: &Yarns, yarn: usize, starts: &mut [Turn]) -> Result<f64, ContactError> {
        let (points, closed) = (yarns.yarn_points(yarn).unwrap_or(&[]), yarns.layout().yarns()[yarn].closed);
        let Some(twist) = self.twists[yarn] else { return Ok(0.0) };
        let rings = self.sampling.rings(points.len() as u64, closed);
        if rings > YARN_RINGS_MAX {
            return Err(PlanError::YarnRings { yarn, rings, limit: YARN_RINGS_MAX }.into());
        }
        let intervals = if closed { points.len() } else { points.len().saturating_sub(1) };
        let window = |interval: usize| neighbours(points, closed, interval);
        // In a rotation-minimising frame, the section starts with the lean of the first ring.
        let first = self.starts_at(yarns, yarn, window(0));
        let mut roll = first;
        for (interval, start) in starts.iter_mut().enumerate().take(intervals) {
            *start = roll;
            let next = (closed || interval + 1 < intervals).then(|| window(interval + 1));
            let steps = self.steps(window(interval), next, twist);
            roll = steps.into_iter().fold(roll, |roll, step| roll + step);
        }
        if !closed {
            return Ok(0.0);
        }
        let (per_interval, steps) = (self.sampling.subdivisions() + 1, (rings - 1) as u32);
        let whole = roll - first;
        for (interval, start) in (0..).zip(&mut *starts) {
            *start = *start - whole.share(interval * per_interval, steps);
        }
        Ok(f64::from(whole.turns()) / f64::from(steps))
    }

    /// The roll of a yarn's first ring. `window` holds the four control points of the first
    /// interval.
    fn starts_at(&self, yarns: &Yarns, yarn: usize, window: [ControlPoint; 4]) -> Turn {
        let carried = matches!(self.twists[yarn], Some((Frame::RotationMinimizing, _)));
        let (Some(ups), true) = (yarns.layout().ups(yarn), carried) else { return Turn::ZERO };
        let cubic = Cubic::new(window, tangent_factor(self.sampling.tension())).with_ups([ups[0], ups[1]]);
        let [_, velocity, _] = cubic.path(0.0);
        Turn::from_turns(cubic.lean(0.0, velocity.normalize_or_zero()) as f32)
    }

    /// The turns from ring to ring within an interval, and on to the first ring of the next
    /// interval. `window` and `next` hold the control points of both intervals. Without `next` the
    /// yarn ends after the interval.
    fn steps(
        &self,
        window: [ControlPoint; 4],
        next: Option<[ControlPoint; 4]>,
        (frame, twist): (Frame, f32),
    ) -> Vec<Turn> {
        let segment = Segment::new(&window, self.sampling.s());
        let count = self.sampling.subdivisions() + 1;
        let at = |ring: u32| match next {
            // If the velocity is 0 at the control point, the yarn may leave in another direction
            // than that in which it arrived.
            Some(next) if ring == count => Segment::new(&next, self.sampling.s()).sample(0.0),
            None if ring == count => segment.sample(1.0),
            _ => segment.sample(ring as f32 * self.sampling.step()),
        };
        let mut here = at(0);
        (1..=count)
            .map(|ring| {
                let next = at(ring);
                let chord = if ring == count { segment.span() } else { next.offset } - here.offset;
                let step = frame.step(here.tangent, next.tangent, chord, twist);
                here = next;
                step
            })
            .collect()
    }

    /// Rolls of the interval that begins at control point `point` of the fabric. `window` holds the
    /// interval's four control points, and `next` those of the interval after it, if the yarn goes
    /// on.
    pub(super) fn of_interval(
        &self,
        yarn: usize,
        point: usize,
        window: [ControlPoint; 4],
        next: Option<[ControlPoint; 4]>,
    ) -> IntervalRolls {
        let Some(twist) = self.twists[yarn] else { return IntervalRolls::default() };
        let given_back = self.given_back[yarn];
        let mut roll = f64::from(self.starts[point].turns());
        let mut at_rings = vec![roll];
        for step in self.steps(window, next, twist) {
            roll += f64::from(step.turns()) - given_back;
            at_rings.push(roll);
        }
        let (frame, twist) = twist;
        let minimizing = (frame == Frame::RotationMinimizing).then_some((twist, given_back));
        IntervalRolls { at_rings, minimizing }
    }
}

impl IntervalRolls {
    /// Whether the surface does not depend on rolls.
    pub(super) fn is_empty(&self) -> bool {
        self.at_rings.is_empty()
    }

    /// Whether the frame is rotation-minimising. In such a frame rolls are measured from the
    /// upright frame. In an upright frame they are measured from the frame along which the yarn is
    /// flattened, which may lean.
    pub(super) fn is_carried(&self) -> bool {
        self.minimizing.is_some()
    }

    /// The yarn's turn from the interval's beginning to its end, turns.
    pub(super) fn whole(&self) -> f64 {
        let ends = [self.at_rings.first(), self.at_rings.last()];
        let [first, last] = ends.map(|roll| roll.copied().unwrap_or_default());
        (last - first).abs()
    }

    /// The roll at `t` of the interval, turns. Beyond the interval the roll goes on at the same
    /// rate.
    pub(super) fn at(&self, cubic: &Cubic, t: f64) -> f64 {
        let Some(steps) = self.at_rings.len().checked_sub(1).filter(|steps| *steps > 0) else { return 0.0 };
        let place = t * steps as f64;
        let before = (place.max(0.0) as usize).min(steps - 1);
        let (from, share) = (self.at_rings[before], place - before as f64);
        // In a rotation-minimising frame, rolls are measured from the upright frame, which may flip
        // between two rings. The section itself does not flip, so its roll is computed at `t`
        // instead of mixed from both rings.
        let carried = self.minimizing.and_then(|(twist, given_back)| {
            let [start, velocity, _] = cubic.path(before as f64 / steps as f64);
            let [end, end_velocity, _] = cubic.path(t);
            let (tangent, end_tangent) =
                (velocity.try_normalize()?.as_vec3(), end_velocity.try_normalize()?.as_vec3());
            let chord = (end - start).as_vec3();
            let step =
                |from, to, chord| f64::from(Frame::RotationMinimizing.step(from, to, chord, twist).turns());
            let turned = if share < 0.0 {
                -step(end_tangent, tangent, -chord)
            } else {
                step(tangent, end_tangent, chord)
            };
            Some(from + turned - share * given_back)
        });
        carried.unwrap_or_else(|| from + share * (self.at_rings[before + 1] - from))
    }
}
