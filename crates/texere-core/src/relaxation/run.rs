//! The course of a relaxation: yarns grow to their thickness, then all moves until the forces
//! balance.

use std::ops::ControlFlow;

use glam::{DMat3, DVec2, DVec3};

use super::descent::{Descent, dot};
use super::stiffness::Stiffness;
use super::{Elastic, Energy, RelaxationPlan, RelaxationSeen, RelaxationState, Relaxer};
use crate::BackendError;
use crate::work_watch::WorkWatch;

/// The shares of their thickness with which yarns grow, while the repeat is held. Without growth,
/// the yarns of lace, which pierce one another at the start, are pushed through one another.
const GROWTHS: [f64; 5] = [0.3, 0.5, 0.7, 0.85, 1.0];

/// The most steps at each share of growth. With half the value, and with twice, no test is red.
const GROWTH_STEPS: u32 = 60;

/// The largest force at rest, as a share of the largest force that presses on an interval. With
/// half the value, and with twice, no test is red.
const BALANCED: f64 = 1e-3;

/// The least force that others are compared with, as a share of `B / r²`: the force that bends a
/// yarn of stiffness B over the radius r of its core. Yarns in a knit press with some hundredths of
/// that force. The bound lets yarns that touch nowhere come to rest. With half the value, and with
/// twice, no test is red.
const FAINT: f64 = 1e-3;

/// The longest step, as a share of the radius that the thinnest core has grown to. If steps while
/// yarns grow may be as long as later ones, net stays as narrow as its needles. With half the
/// value, and with twice, no test is red.
const STEP: f64 = 0.2;

/// The number of steps after which the stiffness of yarns is worked out anew. With 5, lace takes a
/// fifth more steps; with 30, rib takes a quarter more.
const STIFFENED: u32 = 10;

/// The stiffness of a strain, as a share of the mean stiffness of a control point. With 1, tuck
/// takes twice as many steps to rest; with 0.01, jersey does.
const STRAINED: f64 = 0.1;

/// The least fall of energy that a step must reach, as a share of the fall that the slope promises.
/// With half the value, and with twice, no test is red.
const FALL: f64 = 1e-4;

/// The factor by which a step is made shorter if it did not let the energy fall enough. With half
/// the value, and with twice, no test is red.
const SHORTER: f64 = 0.4;

/// The most lengths of a step that are tried, the first of them its full length. With half the
/// value, and with twice, no test is red.
const TRIES: u32 = 12;

/// The result of a relaxation.
#[derive(Debug, Clone)]
pub struct Relaxed {
    /// Whether the forces balance: no force at a control point is more than a thousandth of the
    /// largest force with which yarns press on an interval. If yarns hardly touch, the bound is a
    /// millionth of the force that bends the yarn over the radius of its core.
    pub at_rest: bool,
    /// Number of steps at full thickness, after the yarns have grown.
    pub steps: u32,
    /// Number of states that were measured, also while yarns grew.
    pub measured: u32,
    /// The places and the repeat in the end.
    pub state: RelaxationState,
    /// The energy in the end.
    pub energy: Energy,
    /// The largest sum of all forces at a control point, N: what is left unbalanced there. The
    /// forces on the repeat count, too: each as if shared out among all points.
    pub unbalanced: f64,
    /// The largest force with which yarns press on an interval, N.
    pub pressed: f64,
    /// By how much the energy grows with the repeat's length along x and y when all points move
    /// with it, N. Divided by the repeat's other length it is the force per width of a strained
    /// cloth.
    pub pull: DVec2,
}

/// Relaxes yarns on a device. They grow from 0.3 of their thickness while the repeat is held.
/// Then the repeat's lengths become free, unless the plan holds them.
///
/// `watch` is called with the state before each step, and without it while a state is measured. If
/// it breaks off, the result is `Break`.
///
/// **Errors**: [`BackendError`] of the device.
pub fn relax(
    plan: &RelaxationPlan,
    relaxer: &mut dyn Relaxer,
    mut watch: impl FnMut(Option<&RelaxationState>) -> ControlFlow<()>,
) -> Result<ControlFlow<(), Relaxed>, BackendError> {
    let mut state = plan.start().clone();
    let mut measured = 0;
    for growth in GROWTHS {
        let mut run = Run::new(plan, relaxer, state, growth, [true; 2]);
        let ControlFlow::Continue(grown) = run.descend(GROWTH_STEPS, &mut watch)? else {
            return Ok(ControlFlow::Break(()));
        };
        measured += run.measured;
        state = grown.state;
    }
    let relaxed = relax_grown(plan, relaxer, state, plan.held, watch)?;
    Ok(relaxed.map_continue(|relaxed| Relaxed { measured: relaxed.measured + measured, ..relaxed }))
}

/// Relaxes yarns that have grown to their thickness, from `state`, a state of the plan's yarns. The
/// repeat keeps its length along the axes that `held` names, whatever the plan says. A cloth is
/// strained if its repeat is longer than at rest, and held.
///
/// `watch` is that of [`relax`].
///
/// **Panics** if `state` has another number of control points than the plan.
///
/// **Errors**: [`BackendError`] of the device.
pub fn relax_grown(
    plan: &RelaxationPlan,
    relaxer: &mut dyn Relaxer,
    state: RelaxationState,
    held: [bool; 2],
    mut watch: impl FnMut(Option<&RelaxationState>) -> ControlFlow<()>,
) -> Result<ControlFlow<(), Relaxed>, BackendError> {
    let mut run = Run::new(plan, relaxer, state, 1.0, held);
    Ok(run.descend(plan.steps, &mut watch)?.map_continue(|ended| Relaxed {
        at_rest: ended.at_rest,
        steps: ended.steps,
        measured: run.measured,
        state: ended.state,
        energy: ended.energy,
        unbalanced: ended.unbalanced,
        pressed: ended.pressed,
        pull: ended.pull,
    }))
}

/// A search for the least energy. Its unknowns lie in one list. First come x, y and z of every
/// control point, as if the repeat had the lengths of `start`. Then comes for each axis the
/// logarithm of the repeat's length over that of `start`, times `scale`.
struct Run<'a> {
    plan: &'a RelaxationPlan,
    relaxer: &'a mut dyn Relaxer,
    start: RelaxationState,
    growth: f64,
    held: [bool; 2],
    /// The unknown of an axis for a strain of 1, mm: the mean distance of neighbouring points,
    /// times the root of the number of points. With this scale a strain is as stiff as a point. A
    /// strain of 1 moves each point away from its neighbour by their distance, and there are as
    /// many such pairs as points.
    scale: f64,
    /// The radius of the thinnest core, mm.
    core: f64,
    /// The least force that others are compared with, N.
    faint: f64,
    measured: u32,
}

/// A measured state.
struct Seen {
    at: Vec<f64>,
    state: RelaxationState,
    energy: Energy,
    /// The slopes by all unknowns.
    slopes: Vec<f64>,
    unbalanced: f64,
    pressed: f64,
    pull: DVec2,
    /// The contact stiffness of each interval.
    stiffness: Vec<DMat3>,
    /// Number of steps so far, and whether the forces balance.
    steps: u32,
    at_rest: bool,
}

impl<'a> Run<'a> {
    fn new(
        plan: &'a RelaxationPlan,
        relaxer: &'a mut dyn Relaxer,
        start: RelaxationState,
        growth: f64,
        held: [bool; 2],
    ) -> Self {
        let points = start.points.len().max(1) as f64;
        let length: f64 = plan.yarns().iter().map(|yarn| yarn.length).sum();
        let core = plan.elastic().iter().map(|elastic| elastic.core).fold(f64::INFINITY, f64::min);
        let held = [0, 1].map(|axis| held[axis] || start.repeat[axis] == 0.0);
        let scale = length / points * points.sqrt();
        let bend = |elastic: &Elastic| elastic.bending / (elastic.core * elastic.core);
        let faint = FAINT * plan.elastic().iter().map(bend).fold(f64::INFINITY, f64::min);
        Self { plan, relaxer, start, growth, held, scale, core, faint, measured: 0 }
    }

    /// The factors by which the repeat is longer than at the start.
    fn factors(&self, at: &[f64]) -> DVec2 {
        (DVec2::from_slice(&at[at.len() - 2..]) / self.scale).exp()
    }

    fn state(&self, at: &[f64]) -> RelaxationState {
        let points = at[..at.len() - 2].chunks_exact(3).map(DVec3::from_slice).collect();
        RelaxationState { points, repeat: self.start.repeat }.stretched(self.factors(at))
    }

    /// Measures the state `at`.
    fn measure(&mut self, at: Vec<f64>, watch: WorkWatch<'_>) -> Result<ControlFlow<(), Seen>, BackendError> {
        let state = self.state(&at);
        let ControlFlow::Continue(seen) = self.relaxer.measure(&state, self.growth, watch)? else {
            return Ok(ControlFlow::Break(()));
        };
        self.measured += 1;
        let RelaxationSeen { energy, mut slopes, repeat, pressed, stiffness } = seen;
        // Held points move with the repeat, too.
        let mut strain = repeat * state.repeat;
        for (slope, point) in slopes.iter().zip(&state.points) {
            strain += slope.truncate() * point.truncate();
        }
        for point in self.plan.pinned() {
            slopes[*point as usize] = DVec3::ZERO;
        }
        self.mirror(&mut slopes);
        let free = DVec2::from(self.held.map(|held| if held { 0.0 } else { 1.0 }));
        let pulls = strain * free / self.scale;
        let largest = slopes.iter().map(|slope| slope.length()).fold(0.0, f64::max);
        let is_finite = energy.sum().is_finite() && slopes.iter().all(|slope| slope.is_finite());
        let unbalanced = if is_finite { largest.max(pulls.abs().max_element()) } else { f64::INFINITY };
        let factors = self.factors(&at).extend(1.0);
        let all = slopes.iter().flat_map(|slope| (*slope * factors).to_array()).chain(pulls.to_array());
        Ok(ControlFlow::Continue(Seen {
            slopes: all.collect(),
            energy,
            unbalanced,
            pressed,
            pull: DVec2::select(state.repeat.cmpgt(DVec2::ZERO), strain / state.repeat, DVec2::ZERO),
            at,
            state,
            stiffness,
            steps: 0,
            at_rest: false,
        }))
    }

    /// Makes at most `steps` steps, each of which lets the energy fall.
    fn descend(
        &mut self,
        steps: u32,
        watch: &mut dyn FnMut(Option<&RelaxationState>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<(), Seen>, BackendError> {
        let at = self.start.points.iter().flat_map(DVec3::to_array).chain([0.0; 2]).collect();
        let ControlFlow::Continue(mut seen) = self.measure(at, &mut || watch(None))? else {
            return Ok(ControlFlow::Break(()));
        };
        let mut descent = Descent::default();
        let ControlFlow::Continue(mut stiffness) = self.stiffness(&seen, &mut || watch(None))? else {
            return Ok(ControlFlow::Break(()));
        };
        let (mut stiffened, mut renew) = (0, false);
        loop {
            seen.at_rest = seen.unbalanced <= BALANCED * seen.pressed.max(self.faint);
            if seen.at_rest || seen.steps == steps || !seen.unbalanced.is_finite() {
                break;
            }
            if watch(Some(&seen.state)).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            if renew || seen.steps == stiffened + STIFFENED {
                let ControlFlow::Continue(made) = self.stiffness(&seen, &mut || watch(None))? else {
                    return Ok(ControlFlow::Break(()));
                };
                (stiffness, stiffened, renew) = (made, seen.steps, false);
            }
            let way = self.way(&descent, &stiffness, &seen);
            match self.search(&way, &seen, &mut || watch(None))? {
                ControlFlow::Break(()) => return Ok(ControlFlow::Break(())),
                ControlFlow::Continue(Some(next)) => {
                    descent.learn(difference(&next.at, &seen.at), difference(&next.slopes, &seen.slopes));
                    seen = Seen { steps: seen.steps + 1, ..next };
                }
                // The energy falls in no way that is known: what is remembered may be to blame.
                ControlFlow::Continue(None) if descent.is_new() && stiffened == seen.steps => break,
                ControlFlow::Continue(None) => {
                    descent.forget();
                    renew = true;
                }
            }
        }
        Ok(ControlFlow::Continue(seen))
    }

    /// The stiffness of yarns alone in a state.
    fn stiffness(
        &self,
        seen: &Seen,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), Stiffness>, BackendError> {
        Stiffness::new(self.plan, &seen.state, &seen.stiffness, watch)
    }

    /// Replaces forces by the step that they make, worked out from the stiffness of each yarn
    /// alone.
    fn give(&self, stiffness: &Stiffness, seen: &Seen, forces: &mut [f64]) {
        let factors = self.factors(&seen.at).extend(1.0).to_array();
        let (points, strains) = forces.split_at_mut(forces.len() - 2);
        let scale = |points: &mut [f64]| {
            points.iter_mut().zip(factors.iter().cycle()).for_each(|(point, factor)| *point /= factor);
        };
        scale(points);
        stiffness.solve(points);
        scale(points);
        for point in self.plan.pinned() {
            points[3 * *point as usize..][..3].fill(0.0);
        }
        if self.plan.mirror().is_some() {
            let mut steps: Vec<DVec3> = points.chunks_exact(3).map(DVec3::from_slice).collect();
            self.mirror(&mut steps);
            points.chunks_exact_mut(3).zip(steps).for_each(|(point, step)| step.write_to_slice(point));
        }
        strains.iter_mut().for_each(|strain| *strain /= STRAINED * stiffness.mean());
    }

    /// Makes vectors at control points equal to their mirror images, if the yarns are.
    fn mirror(&self, vectors: &mut [DVec3]) {
        let Some(images) = self.plan.mirror() else { return };
        let own = vectors.to_vec();
        for (vector, image) in vectors.iter_mut().zip(images) {
            let image = own[*image as usize];
            *vector = 0.5 * (*vector + DVec3::new(-image.x, image.y, image.z));
        }
    }

    /// The next step, unless it turns out too long.
    fn way(&self, descent: &Descent, stiffness: &Stiffness, seen: &Seen) -> Vec<f64> {
        let mut way = descent.direction(&seen.slopes, |forces| self.give(stiffness, seen, forces));
        let points = way[..way.len() - 2].chunks_exact(3).map(|way| DVec3::from_slice(way).length());
        let longest = points.fold(0.0, f64::max);
        // A strain moves the furthest points most. Only the move of neighbours against one another
        // counts. They are taken to be 20 radii of a core apart.
        let strain = way[way.len() - 2..].iter().fold(0.0_f64, |most, way| most.max(way.abs())) / self.scale;
        let moved = longest.max(strain * 20.0 * self.core);
        let most = STEP * self.growth * self.core;
        if moved > most {
            let factor = most / moved;
            way.iter_mut().for_each(|way| *way *= factor);
        }
        way
    }

    /// Tries `way`, then shorter ways in that direction, until one lets the energy fall. None if
    /// none does.
    fn search(
        &mut self,
        way: &[f64],
        seen: &Seen,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), Option<Seen>>, BackendError> {
        let slope = dot(way, &seen.slopes);
        let mut share = 1.0;
        for _ in 0..TRIES {
            let at: Vec<f64> = seen.at.iter().zip(way).map(|(at, way)| at + share * way).collect();
            let falls = slope < 0.0 && at != seen.at;
            if !falls {
                break;
            }
            let ControlFlow::Continue(next) = self.measure(at, watch)? else {
                return Ok(ControlFlow::Break(()));
            };
            let falls = next.energy.sum() <= seen.energy.sum() + FALL * share * slope;
            if falls && next.unbalanced.is_finite() {
                return Ok(ControlFlow::Continue(Some(next)));
            }
            share *= SHORTER;
        }
        Ok(ControlFlow::Continue(None))
    }
}

fn difference(to: &[f64], from: &[f64]) -> Vec<f64> {
    to.iter().zip(from).map(|(to, from)| to - from).collect()
}
