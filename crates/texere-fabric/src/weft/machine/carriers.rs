//! Carriers: which are in, where they wait, and the passes and strands that they lay.

use std::collections::BTreeSet;

use super::super::{Direction, Step, Strand};

/// A run of stitches of the same carriers in one direction.
#[derive(Debug, Clone, Copy)]
struct Run {
    direction: Direction,
    /// Where its last stitch is, in half wales.
    at: i64,
    /// The slots of its stitches there, a bit for each row of needles.
    rows: u8,
}

impl Run {
    /// Whether a stitch there goes on in the direction of the run.
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
    /// The strand that it lays.
    strand: Option<usize>,
    run: Option<Run>,
    /// Its pass, and the set of carriers that makes it.
    pass: Option<(u32, u32)>,
    /// Where it waits, in half wales, and the carrier that has laid its yarn on both sides of it.
    waits: Option<i64>,
    caught_by: Option<u32>,
}

/// All carriers, and what they have laid.
#[derive(Debug, Default)]
pub(super) struct Carriers {
    carriers: Vec<Carrier>,
    /// The carriers that the hook holds.
    hook: BTreeSet<u32>,
    /// Where carriers wait.
    waiting: BTreeSet<(i64, u32)>,
    /// For each pass, the pass before it of its first carrier.
    pub(super) before: Vec<Option<u32>>,
    /// The yarns. Courses of floats are still numbers of passes.
    pub(super) strands: Vec<Strand>,
    repeats: bool,
}

/// Where a stitch is made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) direction: Direction,
    /// In half wales.
    pub(super) at: i64,
    /// A bit for the bed.
    pub(super) row: u8,
}

impl Carriers {
    pub(super) fn new(count: usize, repeats: bool) -> Self {
        Self { carriers: vec![Carrier::default(); count], repeats, ..Self::default() }
    }

    /// Brings a carrier in; false if it is in already.
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

    /// Takes a carrier out; false if it is not in.
    pub(super) fn take_out(&mut self, carrier: u32) -> bool {
        let own = std::mem::take(&mut self.carriers[carrier as usize]);
        if let Some(at) = own.waits {
            self.waiting.remove(&(at, carrier));
        }
        self.hook.remove(&carrier);
        own.is_in
    }

    /// Another carrier that the hook holds already, where it is to take these.
    pub(super) fn hooked_beside(&self, carriers: &[u32]) -> Option<u32> {
        let taken: BTreeSet<_> = carriers.iter().collect();
        // At most as many as are taken are among these: the search is short however many the hook holds.
        self.hook.iter().copied().find(|held| !taken.contains(held))
    }

    /// The hook takes carriers.
    pub(super) fn hook(&mut self, carriers: &[u32]) {
        self.hook.extend(carriers);
    }

    /// The hook lets go of a carrier; false if it does not hold it.
    pub(super) fn let_go(&mut self, carrier: u32) -> bool {
        self.hook.remove(&carrier)
    }

    /// Whether a carrier can make a stitch. In a repeat, those that nothing brings in come from the repeat beside.
    pub(super) fn is_in(&self, carrier: u32) -> bool {
        self.carriers[carrier as usize].is_in || self.repeats
    }

    /// The pass of the next stitch of a set of carriers. `newest` is the latest pass of which the needle holds loops.
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

    /// Moves a carrier to a stitch, which it adds to its yarn. Answers with the carrier that its yarn is caught behind.
    pub(super) fn lay(&mut self, carrier: u32, [set, pass]: [u32; 2], spot: Spot, step: Step) -> Option<u32> {
        let Spot { direction, at, row } = spot;
        let own = &mut self.carriers[carrier as usize];
        let goes_on = own.run.filter(|run| run.goes_on(direction, at, row));
        if !own.is_in && (goes_on.is_none() || own.strand.is_none()) {
            own.strand = Some(self.strands.len());
            let onward = Some([if direction == Direction::Right { 1 } else { -1 }, 0]);
            self.strands.push(Strand { carrier, steps: Vec::new(), onward });
        }
        if let Some(strand) = own.strand {
            self.strands[strand].steps.push(step);
        }
        let rows = goes_on.filter(|run| run.at == at).map_or(row, |run| run.rows | row);
        let from = goes_on.map(|run| run.at);
        own.run = Some(Run { direction, at, rows });
        own.pass = Some((pass, set));
        let caught = own.caught_by.take();
        if !self.repeats {
            self.wait(carrier, from, spot);
        }
        caught
    }

    /// Lets a carrier wait beside its stitch, and notes which others wait between that and the one before it.
    fn wait(&mut self, carrier: u32, from: Option<i64>, Spot { direction, at, .. }: Spot) {
        let beside = if direction == Direction::Right { at + 1 } else { at - 1 };
        if let Some(before) = self.carriers[carrier as usize].waits.replace(beside) {
            self.waiting.remove(&(before, carrier));
        }
        if let Some(from) = from {
            let (left, right) = (from.min(at), from.max(at));
            while let Some(&(place, other)) =
                self.waiting.range((left + 1, 0)..(right.max(left + 1), 0)).next()
            {
                self.waiting.remove(&(place, other));
                let other = &mut self.carriers[other as usize];
                other.waits = None;
                other.caught_by = Some(carrier);
            }
        }
        self.waiting.insert((beside, carrier));
    }
}
