//! Rolls of yarns as they are drawn.

use std::f64::consts::TAU;

use rayon::prelude::*;
use texere_core::{ControlPoint, Frame, Sampling, Section, Segment, Turn, Yarn, Yarns};

use super::line::neighbours;

/// The rolls of all yarns whose surface depends on them.
#[derive(Debug)]
pub(super) struct Rolls {
    sampling: Sampling,
    frame: Frame,
    /// Turns per mm of each yarn whose roll matters.
    twists: Vec<Option<f32>>,
    /// The roll where each interval begins; empty where no roll matters.
    starts: Vec<Turn>,
    /// What each ring of a closed yarn gives back of the yarn's whole turn, turns.
    given_back: Vec<f64>,
}

impl Rolls {
    pub(super) fn new(yarns: &Yarns, sampling: Sampling, frame: Frame) -> Self {
        let layout = yarns.layout();
        let twist = |yarn: &Yarn| {
            let turns = (f64::from(yarn.twist) / TAU) as f32;
            let turns_round = layout.sections()[yarn.section as usize] == Section::Circle;
            (!turns_round && !frame.is_level(turns)).then_some(turns)
        };
        let twists: Vec<_> = layout.yarns().iter().map(twist).collect();
        let mut rolls =
            Self { sampling, frame, twists, starts: Vec::new(), given_back: vec![0.0; layout.yarns().len()] };
        if rolls.twists.iter().all(Option::is_none) {
            return rolls;
        }
        let each: Vec<(Vec<Turn>, f64)> =
            (0..layout.yarns().len()).into_par_iter().map(|yarn| rolls.along(yarns, yarn)).collect();
        rolls.given_back = each.iter().map(|(_, given_back)| *given_back).collect();
        rolls.starts = each.into_iter().flat_map(|(starts, _)| starts).collect();
        rolls
    }

    /// Whether a yarn's surface depends on its rolls.
    pub(super) fn matter(&self, yarn: usize) -> bool {
        self.twists[yarn].is_some()
    }

    /// The roll at each control point of a yarn, and what each ring gives back.
    fn along(&self, yarns: &Yarns, yarn: usize) -> (Vec<Turn>, f64) {
        let (points, closed) = (yarns.yarn_points(yarn).unwrap_or(&[]), yarns.layout().yarns()[yarn].closed);
        let mut starts = vec![Turn::ZERO; points.len()];
        let Some(twist) = self.twists[yarn] else { return (starts, 0.0) };
        let intervals = if closed { points.len() } else { points.len().saturating_sub(1) };
        let mut roll = Turn::ZERO;
        for (interval, start) in starts.iter_mut().enumerate().take(intervals) {
            *start = roll;
            let steps = self.steps(neighbours(points, closed, interval), twist);
            roll = steps.into_iter().fold(roll, |roll, step| roll + step);
        }
        if !closed {
            return (starts, 0.0);
        }
        let per_interval = self.sampling.subdivisions() + 1;
        let rings = intervals as u32 * per_interval;
        for (interval, start) in (0..).zip(&mut starts) {
            *start = *start - roll.share(interval * per_interval, rings);
        }
        (starts, f64::from(roll.turns()) / f64::from(rings))
    }

    /// By how much each ring of an interval is turned against the one before, and the next interval's first one.
    fn steps(&self, window: [ControlPoint; 4], twist: f32) -> Vec<Turn> {
        let segment = Segment::new(&window, self.sampling.s());
        let count = self.sampling.subdivisions() + 1;
        let at =
            |ring: u32| segment.sample(if ring == count { 1.0 } else { ring as f32 * self.sampling.step() });
        let mut here = at(0);
        (1..=count)
            .map(|ring| {
                let next = at(ring);
                let chord = if ring == count { segment.span() } else { next.offset } - here.offset;
                let step = self.frame.step(here.tangent, next.tangent, chord, twist);
                here = next;
                step
            })
            .collect()
    }

    /// The rolls at the rings of the interval that begins at control point `point` of the fabric and is steered by `window`, turns,
    /// without jumps; none where they don't matter.
    pub(super) fn of_interval(&self, yarn: usize, point: usize, window: [ControlPoint; 4]) -> Vec<f64> {
        let Some(twist) = self.twists[yarn] else { return Vec::new() };
        let mut roll = f64::from(self.starts[point].turns());
        let mut rolls = vec![roll];
        for step in self.steps(window, twist) {
            roll += f64::from(step.turns()) - self.given_back[yarn];
            rolls.push(roll);
        }
        rolls
    }
}
