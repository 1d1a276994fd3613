//! The reference settler: one interval after the other on one thread.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::{IVec3, Vec3};
use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::settling::{
    Chord, Gathered, Interval, Length, Listed, Pass, Place, Pull, Settler, SettlingPlan, SettlingSeen, freed,
    moves, tag,
};

use crate::asked::{self, in_parts};
use crate::cells::{Extent, Grid, owners};

/// The number of intervals, chords or control points between two questions to the caller whether to
/// go on.
const PART: usize = 256;

/// The reference settler.
#[derive(Debug)]
pub(crate) struct SerialSettler {
    plan: Arc<SettlingPlan>,
    places: Vec<Place>,
    /// The last step of each point, mm.
    steps: Vec<Vec3>,
    /// The length that each interval should have, mm.
    lengths: Vec<f32>,
    /// The places that the last pass measured, before it moved them.
    seen: Vec<Place>,
    /// The places that were kept; empty until places are kept.
    kept: Vec<Place>,
    /// The interval at each place.
    intervals: Vec<Interval>,
    /// The chords of all intervals.
    chords: Vec<Chord>,
    /// For each chord, the place at which its interval begins.
    owners: Vec<u32>,
    /// The position of each chord's first neighbour in `neighbours`, and at the end the number of
    /// all neighbours.
    starts: Vec<u32>,
    neighbours: Vec<u32>,
    pulls: Vec<Pull>,
}

impl SerialSettler {
    /// Allocates the memory for `plan`.
    pub(crate) fn new(plan: Arc<SettlingPlan>) -> Self {
        let (places, chords) = (plan.counts().places as usize, plan.counts().chords as usize);
        Self {
            places: plan.places().to_vec(),
            steps: vec![Vec3::ZERO; places],
            lengths: plan.lengths().to_vec(),
            seen: Vec::new(),
            kept: Vec::new(),
            intervals: Vec::with_capacity(places),
            chords: Vec::with_capacity(chords),
            owners: owners(&plan),
            starts: Vec::new(),
            neighbours: Vec::new(),
            pulls: vec![Pull::none(); places],
            plan,
        }
    }

    /// Works out all intervals and their chords from the places.
    fn renew(&mut self, watch: WorkWatch<'_>) -> ControlFlow<()> {
        let plan = &self.plan;
        self.intervals.clear();
        self.chords.clear();
        in_parts(self.places.len(), PART, watch, |part| {
            for place in part {
                if plan.tags()[place] & tag::INTERVAL == 0 {
                    // No interval begins here. The place may be the last of all, with none behind
                    // it.
                    self.intervals.push(Interval::new(&[self.places[place]; 4], plan.scale(), plan.s()));
                    continue;
                }
                let interval = plan.interval(&self.places, place);
                let count = plan.chords()[place + 1] - plan.chords()[place];
                let chords = (0..count).map(|piece| Chord::new(&interval, piece, count, plan.scale()));
                self.chords.extend(chords);
                self.intervals.push(interval);
            }
        })
    }

    fn listed(&self, chord: u32) -> Listed<'_> {
        let place = self.owners[chord as usize] as usize;
        Listed::new(&self.plan, chord, &self.chords[chord as usize], place, &self.intervals[place])
    }

    /// What pulls at the interval that begins at `place`.
    fn pull(&self, pass: &Pass, place: usize) -> Pull {
        let plan = &*self.plan;
        let mut pull = Pull::none();
        for chord in plan.chords()[place]..plan.chords()[place + 1] {
            let range = self.starts[chord as usize] as usize..self.starts[chord as usize + 1] as usize;
            for &neighbour in &self.neighbours[range] {
                pull.meet(plan, pass, [self.listed(chord), self.listed(neighbour)]);
            }
        }
        let chords = plan.chords()[place + 1] - plan.chords()[place];
        pull.own(plan, pass, (plan.tags()[place], chords), &self.intervals[place], self.lengths[place]);
        pull
    }

    /// Moves every control point once, unless `watch` breaks off.
    fn move_points(&mut self, pass: &Pass, watch: WorkWatch<'_>) -> ControlFlow<(), SettlingSeen> {
        self.renew(watch)?;
        let mut seen = SettlingSeen::NOTHING;
        in_parts(self.places.len(), PART, watch, |part| {
            for place in part.filter(|place| self.plan.tags()[*place] & tag::INTERVAL != 0) {
                let pull = self.pull(pass, place);
                let length = self.lengths[place];
                let off = (pull.arc - length).abs() / length;
                let Pull { clearance, radius, .. } = pull;
                seen = seen.and(SettlingSeen { step: 0.0, clearance, radius, length: off });
                self.pulls[place] = pull;
            }
        })?;
        let plan = Arc::clone(&self.plan);
        let mut next = self.places.clone();
        for strand in plan.strands() {
            for point in 0..i64::from(strand.points) {
                if (point as usize).is_multiple_of(PART) {
                    watch()?;
                }
                let place = strand.first as usize + point as usize;
                let pull = |interval: i64| strand.interval(interval).map(|place| &self.pulls[place]);
                if let Length::Free { tension } = plan.length()
                    && plan.tags()[place] & tag::INTERVAL != 0
                {
                    let arcs =
                        [point - 1, point, point + 1].map(|interval| pull(interval).map(|pull| pull.arc));
                    let tension = tension * pass.ease;
                    self.lengths[place] = freed(self.lengths[place], plan.lengths()[place], arcs, tension);
                }
                if !moves(plan.tags()[place]) {
                    continue;
                }
                let gathered = Gathered([pull(point + 1), pull(point), pull(point - 1), pull(point - 2)]);
                let step = gathered.step(&plan, pass, &self.places[place], self.steps[place]);
                self.steps[place] = step;
                next[place] = self.places[place].moved(plan.scale().step(step));
                seen.step = seen.step.max(step.length_squared().sqrt());
            }
            plan.renew_ends(strand, &mut next);
        }
        self.seen = std::mem::replace(&mut self.places, next);
        ControlFlow::Continue(seen)
    }
}

impl Settler for SerialSettler {
    fn plan(&self) -> &Arc<SettlingPlan> {
        &self.plan
    }

    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError> {
        self.plan.pad(places.iter().copied(), &mut self.places);
        self.steps.fill(Vec3::ZERO);
        self.lengths.copy_from_slice(self.plan.lengths());
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
        let plan = &*self.plan;
        let scale = plan.scale();
        let middles: Vec<IVec3> = self.chords.iter().map(|chord| chord.middle(scale)).collect();
        let lengths = self.chords.iter().map(|chord| chord.span.length_squared().sqrt());
        let known = middles.iter().zip(lengths);
        let extent = known.fold(Extent::NOTHING, |extent, (middle, length)| extent.with(*middle, length));
        let grid = Grid::new(plan, growth, &extent);
        // The cell and the number of each chord, sorted by cells.
        let mut sorted: Vec<(u32, u32)> = middles.iter().map(|middle| grid.cell(*middle)).zip(0..).collect();
        sorted.sort_unstable();
        let (mut starts, mut neighbours) = (vec![0], Vec::new());
        let mut beside = Vec::new();
        for (chord, middle) in (0_u32..).zip(&middles) {
            if (chord as usize).is_multiple_of(PART) && watch().is_break() {
                return Ok(ControlFlow::Break(()));
            }
            beside.clear();
            for cells in grid.beside(grid.cell(*middle)) {
                let [start, end] =
                    [cells.start, cells.end].map(|bound| sorted.partition_point(|(cell, _)| *cell < bound));
                beside.extend(sorted[start..end].iter().map(|(_, other)| *other));
            }
            beside.sort_unstable();
            let near = |other: &u32| {
                *other != chord && plan.are_neighbours(self.listed(chord), self.listed(*other), growth)
            };
            neighbours.extend(beside.iter().copied().filter(near));
            plan.allow_neighbours(neighbours.len() as u64)?;
            starts.push(neighbours.len() as u32);
        }
        (self.starts, self.neighbours) = (starts, neighbours);
        Ok(ControlFlow::Continue(self.neighbours.len() as u64))
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
            self.steps.fill(Vec3::ZERO);
        }
        Ok(())
    }

    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError> {
        self.plan.unpad(&self.places, places);
        Ok(())
    }
}
