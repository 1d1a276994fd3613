//! Yarn carriers: whether each is in, the place where it waits, and the passes and strands that it
//! lays.

use std::collections::BTreeSet;

use super::super::{Direction, Needle, Step, Strand};

/// A run: stitches of the same carriers in one direction.
#[derive(Debug, Clone, Copy)]
struct Run {
    direction: Direction,
    /// Place of the run's last stitch, in half wales.
    at: i64,
    /// The rows of needles that have stitches at this place: one bit for each row.
    rows: u8,
    /// Place of the run's last loop, in half wales; none before its first loop.
    looped: Option<i64>,
}

impl Run {
    /// Whether a stitch at the place `at` and in `row` goes on in the direction of the run.
    fn goes_on(&self, direction: Direction, at: i64, row: u8) -> bool {
        let further = match direction {
            Direction::Right => at - self.at,
            Direction::Left => self.at - at,
        };
        self.direction == direction && (further > 0 || further == 0 && self.rows & row == 0)
    }
}

/// A yarn carrier.
#[derive(Debug, Clone, Default)]
struct Carrier {
    is_in: bool,
    /// Index of the strand that the carrier lays.
    strand: Option<usize>,
    run: Option<Run>,
    /// The carrier's last pass, and the set of carriers that made it.
    pass: Option<(u32, u32)>,
    /// Number of loops that the carrier has made since it came in.
    loops: u64,
    /// The direction and the needle of the carrier's last loop, if that needle was empty.
    cast_on: Option<(Direction, Needle)>,
    /// The place where the carrier waits, in half wales.
    waits: Option<i64>,
    /// The carrier that has laid its yarn on both sides of this carrier.
    caught_by: Option<u32>,
}

/// All carriers, with the passes and strands that they have laid.
#[derive(Debug, Default)]
pub(super) struct Carriers {
    carriers: Vec<Carrier>,
    /// The carriers whose yarns the hook holds.
    hook: BTreeSet<u32>,
    /// The places where carriers wait, each with its carrier.
    waiting: BTreeSet<(i64, u32)>,
    /// For each pass, the previous pass of its first carrier.
    pub(super) before: Vec<Option<u32>>,
    /// The yarns. Until the program ends, floats have the number of their pass in place of their
    /// course.
    pub(super) strands: Vec<Strand>,
    /// For each time that a yarn was caught, the last step before the yarn went on: the index of
    /// the strand, and the index of the step.
    pub(super) caught: Vec<[usize; 2]>,
    repeats: bool,
}

/// Place and direction of a stitch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) direction: Direction,
    /// The place of the stitch, in half wales.
    pub(super) at: i64,
    /// One bit, for the stitch's row of needles.
    pub(super) row: u8,
}

impl Carriers {
    pub(super) fn new(count: usize, repeats: bool) -> Self {
        Self { carriers: vec![Carrier::default(); count], repeats, ..Self::default() }
    }

    /// Brings a carrier in. False if it is already in.
    pub(super) fn bring_in(&mut self, carrier: u32) -> bool {
        let own = &mut self.carriers[carrier as usize];
        if own.is_in {
            return false;
        }
        own.is_in = true;
        own.strand = Some(self.strands.len());
        self.strands.push(Strand { carrier, steps: Vec::new(), onward: None });
        true
    }

    /// Number of loops that a carrier has made since it came in.
    pub(super) fn loops(&self, carrier: u32) -> u64 {
        self.carriers[carrier as usize].loops
    }

    /// Counts a loop of a carrier. Returns the needle that took the yarn just before, if it stands
    /// beside this needle, took the yarn in the same direction, and both needles were empty.
    pub(super) fn cast_on(
        &mut self,
        carrier: u32,
        direction: Direction,
        needle: Needle,
        is_empty: bool,
    ) -> Option<Needle> {
        let own = &mut self.carriers[carrier as usize];
        own.loops += 1;
        let (_, other) = std::mem::replace(&mut own.cast_on, is_empty.then_some((direction, needle)))
            .filter(|&(way, _)| way == direction)?;
        let next = other.number + if direction == Direction::Right { 1 } else { -1 };
        (is_empty && Needle { number: next, ..other } == needle).then_some(other)
    }

    /// Takes a carrier out. False if it is not in.
    pub(super) fn take_out(&mut self, carrier: u32) -> bool {
        let own = std::mem::take(&mut self.carriers[carrier as usize]);
        if let Some(at) = own.waits {
            self.waiting.remove(&(at, carrier));
        }
        self.hook.remove(&carrier);
        own.is_in
    }

    /// A carrier that the hook holds and that is not among `carriers`.
    pub(super) fn hooked_beside(&self, carriers: &[u32]) -> Option<u32> {
        let taken: BTreeSet<_> = carriers.iter().collect();
        // The search skips only carriers that are in `taken`, so that it is short however many
        // carriers the hook holds.
        self.hook.iter().copied().find(|held| !taken.contains(held))
    }

    /// Gives the yarns of carriers to the hook.
    pub(super) fn hook(&mut self, carriers: &[u32]) {
        self.hook.extend(carriers);
    }

    /// Lets the hook release a carrier's yarn. False if the hook does not hold the yarn.
    pub(super) fn let_go(&mut self, carrier: u32) -> bool {
        self.hook.remove(&carrier)
    }

    /// Whether a carrier can make a stitch. In a repeat, a carrier that nothing brings in comes
    /// from the repeat beside it.
    pub(super) fn is_in(&self, carrier: u32) -> bool {
        self.carriers[carrier as usize].is_in || self.repeats
    }

    /// The pass of the next stitch of a set of carriers: the carriers' last pass, or a new one.
    /// `newest` is the latest pass that has loops on the needle.
    pub(super) fn pass(&mut self, set: u32, carriers: &[u32], spot: Spot, newest: Option<u32>) -> u32 {
        let Some(&first) = carriers.first() else { return 0 };
        let Carrier { run, pass, .. } = self.carriers[first as usize];
        let goes_on = run.is_some_and(|run| run.goes_on(spot.direction, spot.at, spot.row));
        match pass {
            Some((pass, of)) if of == set && goes_on && newest.is_none_or(|newest| newest < pass) => pass,
            _ => {
                let next = self.before.len() as u32;
                self.before.push(pass.map(|(pass, _)| pass));
                next
            }
        }
    }

    /// Starts the carriers of a set. They move together: none of them waits while another goes
    /// past.
    pub(super) fn set_off(&mut self, carriers: &[u32]) {
        for &carrier in carriers {
            if let Some(at) = self.carriers[carrier as usize].waits.take() {
                self.waiting.remove(&(at, carrier));
            }
        }
    }

    /// Moves a carrier to a stitch, and adds the stitch to its yarn. [`Carriers::set_off`] comes
    /// first. Returns the carrier whose yarn has caught the yarn of this carrier.
    pub(super) fn lay(&mut self, carrier: u32, [set, pass]: [u32; 2], spot: Spot, step: Step) -> Option<u32> {
        let Spot { direction, at, row } = spot;
        let own = &mut self.carriers[carrier as usize];
        let goes_on = own.run.filter(|run| run.goes_on(direction, at, row));
        if !own.is_in && (goes_on.is_none() || own.strand.is_none()) {
            own.strand = Some(self.strands.len());
            let onward = Some([if direction == Direction::Right { 1 } else { -1 }, 0]);
            self.strands.push(Strand { carrier, steps: Vec::new(), onward });
        }
        let caught = own.caught_by.take();
        if let Some(strand) = own.strand {
            let steps = &mut self.strands[strand].steps;
            if caught.is_some() {
                self.caught.push([strand, steps.len().saturating_sub(1)]);
            }
            steps.push(step);
        }
        let rows = goes_on.filter(|run| run.at == at).map_or(row, |run| run.rows | row);
        let before = goes_on.and_then(|run| run.looped);
        let looped = if matches!(step, Step::Loop { .. }) { Some(at) } else { before };
        own.run = Some(Run { direction, at, rows, looped });
        own.pass = Some((pass, set));
        if !self.repeats {
            if let (Some(from), Some(to)) = (before, looped) {
                self.catch(carrier, [from.min(to), from.max(to)]);
            }
            let beside = if direction == Direction::Right { at + 1 } else { at - 1 };
            self.carriers[carrier as usize].waits = Some(beside);
            self.waiting.insert((beside, carrier));
        }
        caught
    }

    /// Records the carriers that wait between two consecutive loops of carrier `by`, whose yarn
    /// catches theirs. Yarn that is carried past its last loop is drawn back, and catches nothing.
    fn catch(&mut self, by: u32, [left, right]: [i64; 2]) {
        while let Some(&(place, other)) = self.waiting.range((left + 1, 0)..(right.max(left + 1), 0)).next() {
            self.waiting.remove(&(place, other));
            let other = &mut self.carriers[other as usize];
            other.waits = None;
            other.caught_by = Some(by);
        }
    }
}
