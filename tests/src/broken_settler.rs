//! Broken settlers. Each does one thing wrong, and the comparison with `cpu-serial` has to find the
//! fault.

use std::sync::Arc;

use glam::Vec3;
use texere_core::BackendError;
use texere_core::settling::{
    Chord, Gathered, Interval, Length, Listed, Pass, Place, Pull, Settler, SettlingPlan, SettlingSeen, freed,
    moves, tag,
};

/// The fault of a broken settler.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SettlingSabotage {
    /// No fault.
    None,
    /// The chord with the most neighbours ignores all of them.
    LostContacts,
    /// Positions beyond the ends of yarns that go on in a repeat lack the shift of the repeat.
    LostShift,
    /// Lists of neighbours are never renewed.
    StaleList,
    /// A point gathers its pulls from the wrong intervals: each lies one too early on the yarn.
    WrongSlot,
}

impl SettlingSabotage {
    /// All faults.
    pub const ALL: [Self; 4] = [Self::LostContacts, Self::LostShift, Self::StaleList, Self::WrongSlot];
}

/// A settler with code of its own. It compares every chord with every other, and is broken as its
/// [`SettlingSabotage`] says.
#[derive(Debug)]
pub struct SabotagedSettler {
    sabotage: SettlingSabotage,
    plan: Arc<SettlingPlan>,
    places: Vec<Place>,
    seen: Vec<Place>,
    kept: Vec<Place>,
    steps: Vec<Vec3>,
    lengths: Vec<f32>,
    /// The neighbours of each chord.
    neighbours: Vec<Vec<u32>>,
}

/// For each place, the interval that begins there, if one does; and all chords with their places.
type Lines = (Vec<Option<Interval>>, Vec<(usize, Chord)>);

impl SabotagedSettler {
    /// A settler for a plan.
    #[must_use]
    pub fn new(sabotage: SettlingSabotage, plan: Arc<SettlingPlan>) -> Self {
        Self {
            sabotage,
            places: plan.places().to_vec(),
            seen: Vec::new(),
            kept: Vec::new(),
            steps: vec![Vec3::ZERO; plan.places().len()],
            lengths: plan.lengths().to_vec(),
            neighbours: Vec::new(),
            plan,
        }
    }

    fn lines(&self) -> Lines {
        let plan = &self.plan;
        let begins = |place: usize| plan.tags()[place] & tag::INTERVAL != 0;
        let intervals: Vec<_> = (0..self.places.len())
            .map(|place| begins(place).then(|| plan.interval(&self.places, place)))
            .collect();
        let mut chords = Vec::new();
        for (place, interval) in intervals.iter().enumerate() {
            let pieces = plan.chords()[place + 1] - plan.chords()[place];
            let own = interval.iter().flat_map(|interval| (0..pieces).map(move |piece| (interval, piece)));
            chords.extend(
                own.map(|(interval, piece)| (place, Chord::new(interval, piece, pieces, plan.scale()))),
            );
        }
        (intervals, chords)
    }

    fn pulls(&self, pass: &Pass) -> Vec<Pull> {
        let (intervals, chords) = self.lines();
        let listed = |number: u32| listed(&self.plan, &intervals, &chords, number);
        let lost = match self.sabotage {
            SettlingSabotage::LostContacts => {
                (0..chords.len()).max_by_key(|&chord| self.neighbours[chord].len())
            }
            _ => None,
        };
        let mut pulls = vec![Pull::none(); self.places.len()];
        for (place, interval) in intervals.iter().enumerate() {
            let Some(interval) = interval else { continue };
            let own = self.plan.chords()[place]..self.plan.chords()[place + 1];
            for chord in own.clone().filter(|&chord| Some(chord as usize) != lost) {
                for &neighbour in &self.neighbours[chord as usize] {
                    if let (Some(one), Some(other)) = (listed(chord), listed(neighbour)) {
                        pulls[place].meet(&self.plan, pass, [one, other]);
                    }
                }
            }
            let own = (self.plan.tags()[place], own.len() as u32);
            pulls[place].own(&self.plan, pass, own, interval, self.lengths[place]);
        }
        pulls
    }

    fn renew_ends(&self, next: &mut [Place]) {
        for strand in self.plan.strands() {
            self.plan.renew_ends(strand, next);
            if self.sabotage == SettlingSabotage::LostShift && strand.shift().is_some() {
                let (first, last) = (strand.first as usize, (strand.first + strand.points) as usize - 1);
                (next[first - 1], next[last + 1], next[last + 2]) =
                    (next[last], next[first], next[first + 1]);
            }
        }
    }
}

fn listed<'a>(
    plan: &SettlingPlan,
    intervals: &'a [Option<Interval>],
    chords: &'a [(usize, Chord)],
    number: u32,
) -> Option<Listed<'a>> {
    let (place, chord) = chords.get(number as usize)?;
    Some(Listed::new(plan, number, chord, *place, intervals[*place].as_ref()?))
}

impl Settler for SabotagedSettler {
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
        if self.sabotage != SettlingSabotage::StaleList || self.neighbours.is_empty() {
            let (intervals, chords) = self.lines();
            let listed = |number: u32| listed(&self.plan, &intervals, &chords, number);
            let all = 0..chords.len() as u32;
            let near = |one: u32, other: u32| match (listed(one), listed(other)) {
                (Some(chord), Some(beside)) => {
                    one != other && self.plan.are_neighbours(chord, beside, growth)
                }
                _ => false,
            };
            let neighbours = all.clone().map(|one| all.clone().filter(|&other| near(one, other)).collect());
            self.neighbours = neighbours.collect();
        }
        Ok(self.neighbours.iter().map(|own| own.len() as u64).sum())
    }

    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        let pulls = self.pulls(pass);
        let plan = Arc::clone(&self.plan);
        let mut seen = SettlingSeen::NOTHING;
        for (place, pull) in
            pulls.iter().enumerate().filter(|(place, _)| plan.tags()[*place] & tag::INTERVAL != 0)
        {
            let length = (pull.arc - self.lengths[place]).abs() / self.lengths[place];
            seen =
                seen.and(SettlingSeen { step: 0.0, clearance: pull.clearance, radius: pull.radius, length });
        }
        let mut next = self.places.clone();
        let early = i64::from(self.sabotage == SettlingSabotage::WrongSlot);
        for strand in plan.strands() {
            for point in 0..i64::from(strand.points) {
                let place = (i64::from(strand.first) + point) as usize;
                let pull = |interval: i64| strand.interval(interval - early).map(|place| &pulls[place]);
                if let Length::Free { tension } = plan.length()
                    && plan.tags()[place] & tag::INTERVAL != 0
                {
                    let arcs = [-1, 0, 1].map(|beside| pull(point + beside).map(|pull| pull.arc));
                    let tension = tension * pass.ease;
                    self.lengths[place] = freed(self.lengths[place], plan.lengths()[place], arcs, tension);
                }
                if moves(plan.tags()[place]) {
                    let gathered = Gathered([1, 0, -1, -2].map(|beside| pull(point + beside)));
                    let step = gathered.step(&plan, pass, &self.places[place], self.steps[place]);
                    self.steps[place] = step;
                    next[place] = self.places[place].moved(plan.scale().step(step));
                    seen.step = seen.step.max(step.length());
                }
            }
        }
        self.renew_ends(&mut next);
        self.seen = std::mem::replace(&mut self.places, next);
        Ok(seen)
    }

    fn keep(&mut self) -> Result<(), BackendError> {
        self.kept.clone_from(&self.seen);
        Ok(())
    }

    fn recall(&mut self) -> Result<(), BackendError> {
        if !self.kept.is_empty() {
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
