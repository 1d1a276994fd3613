//! Settling in lanes on all cores, with the same bits as the reference.

mod bends;
mod chords;
mod contacts;
mod curves;
mod lists;
mod make;
mod steps;
mod tables;

use std::ops::ControlFlow;
use std::sync::Arc;

use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::settling::{
    Length, Pass, Place, Settler, SettlingPlan, SettlingSeen, SettlingYarn, freed, tag,
};

use super::Parallel;
use super::instruction_set::InstructionSet;
use super::simd::{Job, Simd};
use crate::asked::{self, for_all_threads, in_parts};

use bends::Own;
use contacts::{Room, Source};
use lists::{Basis, Lists};
use make::Make;
use steps::Gather;
use tables::{BACK, ChordRow, FRONT, Fixed, IntervalRow, PullRow, TASK};

/// The settler on all cores.
#[derive(Debug)]
pub(crate) struct ParallelSettler {
    set: InstructionSet,
    plan: Arc<SettlingPlan>,
    fixed: Fixed,
    /// The present places. [`FRONT`] more entries come before the first, and [`BACK`] behind the
    /// last.
    places: Vec<Place>,
    /// The places that the last pass measured, before it moved them, with the same additional
    /// entries as `places`. During a pass the next places are written here.
    seen: Vec<Place>,
    /// The places that were kept, with the same additional entries as `places`. Empty until places
    /// are kept.
    kept: Vec<Place>,
    /// The last step of each point, mm.
    steps: Vec<[f32; 4]>,
    /// The length that each interval should have, mm.
    lengths: Vec<f32>,
    intervals: Vec<IntervalRow>,
    chords: Vec<ChordRow>,
    lists: Lists,
    /// The pulls of all intervals. [`FRONT`] more entries come before the first.
    pulls: Vec<PullRow>,
}

impl ParallelSettler {
    pub(crate) fn new(Parallel(set): Parallel, plan: Arc<SettlingPlan>) -> Self {
        let (places, chords) = (plan.counts().places as usize, plan.counts().chords as usize);
        let around = |places: &[Place]| {
            let mut all = vec![Place::default(); FRONT + places.len() + BACK];
            all[FRONT..][..places.len()].copy_from_slice(places);
            all
        };
        let mut lengths = plan.lengths().to_vec();
        lengths.resize(places + BACK, 0.0);
        Self {
            set,
            fixed: Fixed::new(&plan),
            places: around(plan.places()),
            seen: around(plan.places()),
            kept: Vec::new(),
            steps: vec![[0.0; 4]; places],
            lengths,
            intervals: vec![IntervalRow::default(); places],
            chords: vec![ChordRow::default(); chords],
            lists: Lists::default(),
            pulls: vec![PullRow::NONE; FRONT + places + BACK],
            plan,
        }
    }

    /// Works out all intervals and their chords from the places.
    fn renew(&mut self, watch: WorkWatch<'_>) -> ControlFlow<()> {
        let Self { set, plan, fixed, places, intervals, chords, .. } = self;
        let (plan, fixed, places) = (&**plan, &*fixed, places.as_slice());
        let mut left = chords.as_mut_slice();
        in_parts(intervals.len(), for_all_threads(TASK), watch, |part| {
            let tasks: Vec<_> = (part.start..)
                .step_by(TASK)
                .zip(intervals[part].chunks_mut(TASK))
                .map(|(first, intervals)| {
                    let count = plan.chords()[first + intervals.len()] - plan.chords()[first];
                    let chords = left.split_off_mut(..count as usize).unwrap_or_default();
                    Make { plan, fixed, places, first, intervals, chords }
                })
                .collect();
            tasks.into_par_iter().for_each(|make| set.run(make));
        })
    }

    /// Moves every control point once, unless `watch` breaks off.
    fn move_points(&mut self, pass: &Pass, watch: WorkWatch<'_>) -> ControlFlow<(), SettlingSeen> {
        self.renew(watch)?;
        let Self { set, plan, fixed, places, seen, steps, lengths, intervals, chords, lists, pulls, .. } =
            self;
        let (set, plan, fixed, count) = (*set, &**plan, &*fixed, steps.len());
        let source = Source {
            plan,
            pass,
            fixed,
            intervals,
            chords,
            starts: &lists.starts,
            neighbours: &lists.neighbours,
        };
        let own = Own { plan, pass, intervals, lengths };
        let mut what = SettlingSeen::NOTHING;
        in_parts(count, for_all_threads(TASK), watch, |part| {
            let from = part.start;
            let all = pulls[FRONT..][part].par_chunks_mut(TASK).enumerate();
            let pulled = all.map_init(Room::default, |room, (task, pulls)| {
                let mut seen = SettlingSeen::NOTHING;
                let first = from + task * TASK;
                set.run(PullJob { source, own, first, pulls, room, seen: &mut seen });
                seen
            });
            what = what.and(pulled.reduce(|| SettlingSeen::NOTHING, SettlingSeen::and));
        })?;
        for strand in plan.strands() {
            go_on(strand, pulls);
        }
        if let Length::Free { tension } = plan.length() {
            free(plan, pulls, lengths, tension * pass.ease);
        }
        let gather = Gather { plan, pass, places, pulls };
        in_parts(count, for_all_threads(TASK), watch, |part| {
            let from = part.start;
            let next = seen[FRONT..][part.clone()].par_chunks_mut(TASK);
            let tasks = steps[part].par_chunks_mut(TASK).zip(next).enumerate();
            let stepped = tasks.map(|(task, (steps, next))| {
                let mut longest = 0.0;
                let first = from + task * TASK;
                set.run(StepJob { gather, first, steps, next, longest: &mut longest });
                longest
            });
            what.step = what.step.max(stepped.reduce(|| 0.0, f32::max));
        })?;
        for strand in plan.strands() {
            plan.renew_ends(strand, &mut seen[FRONT..][..count]);
        }
        std::mem::swap(places, seen);
        ControlFlow::Continue(what)
    }
}

/// Works out the pulls of a task's intervals.
struct PullJob<'a> {
    source: Source<'a>,
    own: Own<'a>,
    first: usize,
    pulls: &'a mut [PullRow],
    room: &'a mut Room,
    seen: &'a mut SettlingSeen,
}

impl Job for PullJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { source, own, first, pulls, room, seen } = self;
        pulls.fill(PullRow::NONE);
        source.add(simd, first, room, pulls);
        own.add(simd, first, pulls);
        for pull in pulls {
            let [_, clearance, radius, length] = pull.seen;
            *seen = seen.and(SettlingSeen { step: 0.0, clearance, radius, length });
        }
    }
}

/// Moves a task's control points.
struct StepJob<'a> {
    gather: Gather<'a>,
    first: usize,
    steps: &'a mut [[f32; 4]],
    next: &'a mut [Place],
    longest: &'a mut f32,
}

impl Job for StepJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        *self.longest = self.gather.step(simd, self.first, self.steps, self.next);
    }
}

impl Settler for ParallelSettler {
    fn plan(&self) -> &Arc<SettlingPlan> {
        &self.plan
    }

    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError> {
        let count = self.steps.len();
        self.plan.pad(places.iter().copied(), &mut self.places[FRONT..][..count]);
        self.steps.fill([0.0; 4]);
        self.lengths[..count].copy_from_slice(self.plan.lengths());
        Ok(())
    }

    fn list(&mut self, growth: f32) -> Result<u64, BackendError> {
        Ok(self.list_watched(growth, &mut asked::go_on)?.continue_value().unwrap_or(0))
    }

    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        let seen = self.move_points(pass, &mut asked::go_on).continue_value();
        Ok(seen.unwrap_or(SettlingSeen::NOTHING))
    }

    fn list_watched(
        &mut self,
        growth: f32,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), u64>, BackendError> {
        if self.renew(watch).is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let Self { set, plan, fixed, chords, lists, .. } = self;
        lists.fill(Basis { set: *set, plan, fixed, chords, growth }, watch)
    }

    fn pass_watched(
        &mut self,
        pass: &Pass,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), SettlingSeen>, BackendError> {
        Ok(self.move_points(pass, watch))
    }

    fn keep(&mut self) -> Result<(), BackendError> {
        self.kept.clone_from(&self.seen);
        Ok(())
    }

    fn recall(&mut self) -> Result<(), BackendError> {
        if self.kept.len() == self.places.len() {
            self.places.clone_from(&self.kept);
            self.steps.fill([0.0; 4]);
        }
        Ok(())
    }

    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError> {
        self.plan.unpad(&self.places[FRONT..], places);
        Ok(())
    }
}

/// Copies pulls to the intervals beyond a yarn's ends, if the yarn goes on in the next repeat. The
/// points at the yarn's ends add up the pulls of these intervals, too.
fn go_on(strand: &SettlingYarn, pulls: &mut [PullRow]) {
    if strand.shift().is_some() {
        let first = FRONT + strand.first as usize;
        let last = first + strand.points as usize - 1;
        (pulls[first - 2], pulls[first - 1]) = (pulls[last - 1], pulls[last]);
        pulls[last + 1] = pulls[first];
    }
}

/// Renews the lengths that intervals should have. It is called if lengths are free.
fn free(plan: &SettlingPlan, pulls: &[PullRow], lengths: &mut [f32], tension: f32) {
    let tasks = lengths[..plan.tags().len()].par_iter_mut().enumerate();
    tasks.filter(|(place, _)| plan.tags()[*place] & tag::INTERVAL != 0).for_each(|(place, length)| {
        let strand = &plan.strands()[plan.yarns()[place] as usize];
        let own = place as i64 - i64::from(strand.first);
        let arcs = [own - 1, own, own + 1]
            .map(|interval| strand.interval(interval).map(|place| pulls[FRONT + place].length[3]));
        *length = freed(*length, plan.lengths()[place], arcs, tension);
    });
}
