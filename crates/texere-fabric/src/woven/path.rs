//! Paths of threads over and under the threads that they cross.

use std::sync::Arc;

use super::bend::{Bend, ROUNDING, STRIDE};
use super::shape::Shape;

/// The path of all threads of one thickness across the threads that they cross. Everything that
/// does not depend on the sides on which a thread lies is computed once.
pub(super) struct ThreadPath<'a> {
    bend: Bend<'a>,
    /// Places where the threads enter the cloth and where they leave it, mm along the thread.
    edges: [f32; 2],
    /// The crossings, in the order in which the threads run.
    stations: Arc<[Station]>,
}

/// A crossing, and the way to the next one.
#[derive(Debug, Clone)]
pub(super) struct Station {
    /// Number of the crossed thread.
    number: usize,
    /// Place along the thread, mm.
    at: f32,
    /// Distance of the thread from the cloth's middle at the crossing, mm.
    depth: f32,
    /// Distances from the crossing to the shoulders towards the crossings before and after, mm. A
    /// shoulder is the control point beside a crossing of a thread that changes sides.
    aside: [f32; 2],
    /// Heights of the shoulders of a thread that changes sides before the crossing only, after it
    /// only, and on both sides of it, mm.
    shoulder_z: [f32; 3],
    /// Places of the three points of a change of sides to the next crossing, mm.
    change: [f32; 3],
}

/// Indices into the values that a [`Station`] has for its two sides. Only `shoulder_z` has a value
/// at [`BOTH`].
const BEFORE: usize = 0;
const AFTER: usize = 1;
const BOTH: usize = 2;

/// A control point of a thread's path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    /// Place along the thread, mm.
    pub(super) along: f32,
    /// Height, mm.
    pub(super) z: f32,
    /// The crossed thread at which, or beside which, the point lies; none at a cut end.
    pub(super) crossing: Option<usize>,
}

impl<'a> ThreadPath<'a> {
    /// The path of the threads of `bend`. `back` says whether they run against the order of the
    /// threads that they cross.
    pub(super) fn new(bend: Bend<'a>, stations: Arc<[Station]>, back: bool) -> Self {
        let edges = [0.0, bend.crossed.extent];
        Self { edges: if back { [edges[1], edges[0]] } else { edges }, stations, bend }
    }

    /// Number of control points of a thread that is cut as in [`ThreadPath::walk`]. None if the
    /// number depends on the sides on which the thread lies.
    pub(super) fn fixed_count(&self, cut: [bool; 2]) -> Option<usize> {
        let cuts = cut.into_iter().filter(|cut| *cut).count();
        (self.bend.shape == Shape::Crossing).then_some(self.stations.len() + cuts)
    }

    /// Calls `stop` with each control point in order. `above` says whether the thread lies on top
    /// of a crossed thread. `cut` says whether the thread is cut off at the cloth's edge at its
    /// beginning, and at its end.
    pub(super) fn walk(&self, above: impl Fn(usize) -> bool, cut: [bool; 2], mut stop: impl FnMut(Stop)) {
        let ([first, ..], [.., last]) = (&self.stations[..], &self.stations[..]) else { return };
        if self.bend.shape == Shape::Crossing {
            // A cut end lies at the edge of the cloth, and at the height of the cloth's middle.
            let end = |along| Stop { along, z: 0.0, crossing: None };
            cut[0].then(|| stop(end(self.edges[0])));
            self.stations.iter().for_each(|here| stop(here.stop(above(here.number))));
            cut[1].then(|| stop(end(self.edges[1])));
            return;
        }

        let mut side = above(first.number);
        let mut next_side = self.stations.get(1).map_or(side, |next| above(next.number));
        let end = |along: f32, here: &Station| {
            let z = self.bend.leaving_z(here.number, (along - here.at).abs(), &above);
            Stop { along, z, crossing: None }
        };
        if cut[0] {
            stop(end(self.edges[0], first));
            let after = (side != next_side).then_some(first.aside[AFTER]);
            Float { from: self.edges[0], to: first.at, beside: [None, after] }
                .walk([(first, side); 2], &mut stop);
        }
        // Whether the thread has changed sides on its way to the present crossing.
        let mut changed = false;
        for (step, here) in self.stations.iter().enumerate() {
            stop(here.stop(side));
            let Some(next) = self.stations.get(step + 1) else { break };
            let side_after = self.stations.get(step + 2).map_or(next_side, |after| above(after.number));
            let changes_after = next_side != side_after;
            let changes = side != next_side;
            if changes {
                let high = here.shoulder_z[if changed { BOTH } else { AFTER }];
                let low = next.shoulder_z[if changes_after { BOTH } else { BEFORE }];
                let side = if side { 1.0 } else { -1.0 };
                let heights = [side * high, 0.0, -side * low];
                let crossings = [here.number, here.number, next.number];
                for ((along, z), crossing) in here.change.into_iter().zip(heights).zip(crossings) {
                    stop(Stop { along, z, crossing: Some(crossing) });
                }
            } else {
                let beside =
                    [changed.then_some(here.aside[BEFORE]), changes_after.then_some(next.aside[AFTER])];
                let float = Float { from: here.at, to: next.at, beside };
                float.walk([(here, side), (next, next_side)], &mut stop);
            }
            (changed, side, next_side) = (changes, next_side, side_after);
        }
        if cut[1] {
            let before = changed.then_some(last.aside[BEFORE]);
            Float { from: last.at, to: self.edges[1], beside: [before, None] }
                .walk([(last, side); 2], &mut stop);
            stop(end(self.edges[1], last));
        }
    }
}

/// The crossings of threads of one thickness, in the order in which the threads run. With `back`
/// the threads run against the order of the threads that they cross.
pub(super) fn stations(bend: &Bend<'_>, back: bool) -> Arc<[Station]> {
    let count = bend.crossed.at.len();
    let number = |step: usize| if back { count - 1 - step } else { step };
    let station = |step: usize| {
        let before = step.checked_sub(1).map(number);
        let after = (step + 1 < count).then(|| number(step + 1));
        Station::new(bend, number(step), before, after)
    };
    (0..count).map(station).collect()
}

impl Station {
    fn new(bend: &Bend<'_>, number: usize, before: Option<usize>, after: Option<usize>) -> Self {
        let at = bend.crossed.at[number];
        let depth = bend.depth(number);
        let mut station = Self { number, at, depth, aside: [0.0; 2], shoulder_z: [0.0; 3], change: [0.0; 3] };
        if bend.shape == Shape::Crossing {
            return station;
        }
        for (way, one, other) in [(BEFORE, before, after), (AFTER, after, before)] {
            let Some(one) = one else { continue };
            station.aside[way] = bend.shoulder(number, bend.pitch(number, one)).0;
            station.shoulder_z[way] = bend.shoulder_z(number, one, other, false);
            station.shoulder_z[BOTH] = bend.shoulder_z(number, one, other, true);
        }
        if let Some(after) = after {
            station.change = change(bend, number, after);
        }
        station
    }

    /// The control point at the crossing of a thread that lies `above` the crossed one, or below.
    fn stop(&self, above: bool) -> Stop {
        Stop { along: self.at, z: self.z(above), crossing: Some(self.number) }
    }

    fn z(&self, above: bool) -> f32 {
        if above { self.depth } else { -self.depth }
    }
}

/// Places of the points between the neighbouring crossings `from` and `to` of a thread that changes
/// sides between them: both shoulders, and the passage through the cloth's middle between them,
/// which is nearer to the thinner crossed thread.
fn change(bend: &Bend<'_>, from: usize, to: usize) -> [f32; 3] {
    let (start, end) = (bend.crossed.at[from], bend.crossed.at[to]);
    let pitch = bend.pitch(from, to);
    let forward = (end - start).signum();
    let start = start + forward * bend.shoulder(from, pitch).0;
    let end = end - forward * bend.shoulder(to, pitch).0;
    let share = bend.apart(from) / (bend.apart(from) + bend.apart(to));
    [start, start + share * (end - start), end]
}

/// A stretch along which a thread keeps its side.
struct Float {
    from: f32,
    to: f32,
    /// Lengths of the steps before the float and after it, mm. None if the step does not lead to a
    /// shoulder.
    beside: [Option<f32>; 2],
}

impl Float {
    /// Calls `stop` with the points within the float. They lie at the heights that the thread has
    /// at the crossings `ends`. Points are needed if the steps beside the float are so short that a
    /// single step along the float would be too long. Evenly spaced threads need none.
    fn walk(&self, ends: [(&Station, bool); 2], stop: &mut impl FnMut(Stop)) {
        let forward = (self.to - self.from).signum();
        let mut left = (self.to - self.from).abs();
        // Without the margin, rounding could give points to evenly spaced threads.
        let too_long = |left: f32, step: f32| step > 0.0 && left > (1.0 + ROUNDING) * STRIDE * step;
        if !self.beside.into_iter().flatten().any(|step| too_long(left, step)) {
            return;
        }
        let [first, last] = ends.map(|(station, above)| (station.z(above), Some(station.number)));
        let mut at = self.from;
        let mut step = self.beside[0].unwrap_or(left);
        while too_long(left, step) {
            step *= STRIDE - 1.0;
            left -= step;
            at += forward * step;
            stop(Stop { along: at, z: first.0, crossing: first.1 });
        }
        // From the other end the steps grow against the thread's direction, so the last step found
        // comes first.
        let step = self.beside[1].unwrap_or(left);
        let mut steps = 0;
        let mut rest = left;
        while too_long(rest, step * (STRIDE - 1.0).powi(steps)) {
            steps += 1;
            rest -= step * (STRIDE - 1.0).powi(steps);
        }
        at += forward * rest;
        for remaining in (1..=steps).rev() {
            stop(Stop { along: at, z: last.0, crossing: last.1 });
            at += forward * step * (STRIDE - 1.0).powi(remaining);
        }
    }
}
