//! Making loops and laying yarn.

use texere_core::backend::room_for;

use super::super::super::stitches::HALVES;
use super::super::super::{Bed, Direction, Fate, Head, LoopKind, LoopRef, Needle, Step, Stitch};
use super::super::beds::{Held, Slot};
use super::super::carriers::Spot;
use super::super::courses::Above;
use super::super::limits::PARENTS_MAX;
use super::super::{Fault, FaultKind};
use super::Run;
use crate::FabricError;
use crate::weft::WeftError;

/// A stitch to be made.
#[derive(Debug, Clone, Copy)]
struct Order {
    kind: LoopKind,
    direction: Direction,
    needle: Needle,
    slot: Slot,
}

impl Run<'_> {
    /// Knits or tucks on a needle.
    pub(super) fn knit(
        &mut self,
        set: u32,
        carriers: &[u32],
        kind: LoopKind,
        direction: Direction,
        needle: Needle,
    ) -> Result<(), FabricError> {
        let slot = self.slot(needle)?;
        let order = Order { kind, direction, needle, slot };
        let mut held = std::mem::take(self.beds.stack(slot));
        let first = self.make(set, carriers, order, &held)?;
        if kind == LoopKind::Knit {
            for (layer, loop_held) in held.iter().enumerate() {
                let head = self.head(loop_held, needle, slot, layer);
                let child = self.child(first, loop_held, slot);
                self.ends[loop_held.number as usize] = Some((Fate::Held(child), head));
            }
            held.clear();
        }
        self.place(held, first, carriers.len(), slot);
        if kind == LoopKind::Tuck { self.piled(needle, slot, carriers.len()) } else { Ok(()) }
    }

    pub(super) fn split(
        &mut self,
        set: u32,
        carriers: &[u32],
        direction: Direction,
        [from, to]: [Needle; 2],
    ) -> Result<(), FabricError> {
        let (start, end) = (self.slot(from)?, self.slot(to)?);
        self.aim(from, to);
        let mut held = std::mem::take(self.beds.stack(start));
        let order = Order { kind: LoopKind::Split, direction, needle: from, slot: start };
        let first = self.make(set, carriers, order, &held)?;
        for loop_held in &mut held {
            loop_held.split = Some(self.child(first, loop_held, start));
        }
        self.hang(held, start, (to, end))?;
        let under = std::mem::take(self.beds.stack(start));
        self.place(under, first, carriers.len(), start);
        self.piled(from, start, carriers.len())
    }

    pub(super) fn miss(
        &mut self,
        set: u32,
        carriers: &[u32],
        direction: Direction,
        needle: Needle,
    ) -> Result<(), FabricError> {
        self.slot(needle)?;
        self.check_in(carriers, needle);
        let spot = self.spot(direction, needle);
        let pass = self.carriers.pass(set, carriers, spot, None);
        let (at, bed) = (spot.at as f32 / HALVES as f32, needle.bed);
        let float = Step::Float { at, bed, course: pass, direction, source: self.source };
        self.carriers.set_off(carriers);
        for &carrier in carriers {
            self.lay(carrier, [set, pass], spot, float, needle);
        }
        Ok(())
    }

    /// Puts new loops on a needle, on top of the loops that it holds.
    fn place(&mut self, mut held: Vec<Held>, first: u32, count: usize, slot: Slot) {
        // The needle lies in the repeat of `slot`, but the list of the slot is that of the needle
        // in repeat 0. Counted from that needle, the new loops belong to the repeat `-slot.repeat`.
        let new = Held { number: 0, round: self.round, repeat: -slot.repeat, moved: 0, split: None };
        held.extend((first..).take(count).map(|number| Held { number, ..new }));
        *self.beds.stack(slot) = held;
    }

    /// A reference to the loop `number`, with its repeat relative to `held`, a loop that it is
    /// drawn through.
    fn child(&self, number: u32, held: &Held, slot: Slot) -> LoopRef {
        let repeat = [-held.repeat.saturating_add(slot.repeat), (self.round - held.round) as i32];
        LoopRef { number, repeat }
    }

    fn spot(&self, direction: Direction, needle: Needle) -> Spot {
        let row = 1 << (2 * u8::from(needle.bed == Bed::Back) + u8::from(needle.slider));
        Spot { direction, at: self.beds.place(needle), row }
    }

    /// Makes a loop with the yarn of each carrier. Returns the number of the first loop.
    fn make(&mut self, set: u32, carriers: &[u32], order: Order, held: &[Held]) -> Result<u32, FabricError> {
        let Order { kind, direction, needle, slot } = order;
        self.check_in(carriers, needle);
        if needle.slider {
            self.fault(FaultKind::OnSlider, Some(needle), None);
        }
        let spot = self.spot(direction, needle);
        let own = |held: &&Held| held.round == self.round;
        let newest = held.iter().filter(own).map(|held| self.passes[held.number as usize]).max();
        let pass = self.carriers.pass(set, carriers, spot, newest);
        for held in held {
            let (below, rounds) = (held.number, self.round - held.round);
            let pass_of = |above: &Above| self.passes[above.below as usize];
            let same = |last: &Above| {
                last.pass == pass
                    && [last.rounds, rounds] == [0, 0]
                    && pass_of(last) == self.passes[below as usize]
            };
            if !self.aboves.last().is_some_and(same) {
                self.aboves.push(Above { pass, below, rounds });
            }
        }
        let first = self.loops.len() as u32;
        let start = self.parents.len();
        if kind != LoopKind::Tuck {
            if start + held.len() > PARENTS_MAX {
                let (what, count) = ("loops that others are drawn through", (start + held.len()) as u64);
                let (limit, operation) = (PARENTS_MAX as u64, self.operation);
                return Err(WeftError::KnitSize { what, count, limit, operation }.into());
            }
            let round = self.round;
            let parent = |held: &Held| LoopRef {
                number: held.number,
                repeat: [held.repeat.saturating_add(slot.repeat), held.round as i32 - round as i32],
            };
            room_for(&mut self.parents, held.len(), "parents of loops")?;
            self.parents.extend(held.iter().map(parent));
        }
        let parents = start as u32..self.parents.len() as u32;
        let at = spot.at as f32 / HALVES as f32;
        let opposite = self.beds.opposite(needle);
        self.carriers.set_off(carriers);
        self.cast_on(carriers, direction, needle, held.is_empty());
        for (plate, &carrier) in carriers.iter().enumerate() {
            let number = self.loops.len() as u32;
            self.passes[number as usize] = pass;
            let head = Head { at, bed: needle.bed, layer: 0, moved: 0 };
            self.loops.push(Stitch {
                kind,
                bed: needle.bed,
                at,
                opposite,
                course: pass,
                plate: plate as u16,
                parents: parents.clone(),
                head,
                fate: Fate::OnNeedle,
                length_mm: self.length_mm,
                source: self.source,
            });
            self.lay(carrier, [set, pass], spot, Step::Loop { number, direction }, needle);
        }
        Ok(first)
    }

    /// Records neighbouring needles that are cast on one after the other. A program that is a
    /// repeat gets no such fault.
    fn cast_on(&mut self, carriers: &[u32], direction: Direction, needle: Needle, is_empty: bool) {
        let mut found = None;
        for &carrier in carriers {
            let beside = self.carriers.cast_on(carrier, direction, needle, is_empty);
            found = found.or(beside.map(|beside| (carrier, beside)));
        }
        let Some((carrier, beside)) = found.filter(|_| self.program.repeat.is_none()) else { return };
        match &mut self.cast_on {
            Some(Fault { kind: FaultKind::CastOn { others, .. }, .. }) => *others += 1,
            first => {
                let (kind, carrier) = (
                    FaultKind::CastOn { beside, others: 0 },
                    Some(self.program.carriers[carrier as usize].clone()),
                );
                *first = Some(Fault { kind, source: self.source, needle: Some(needle), carrier });
            }
        }
    }

    /// Brings in carriers that are about to make a stitch and are not in. Records a fault for each
    /// of them.
    fn check_in(&mut self, carriers: &[u32], needle: Needle) {
        for &carrier in carriers {
            if !self.carriers.is_in(carrier) {
                self.fault(FaultKind::CarrierNotIn, Some(needle), Some(carrier));
                self.carriers.bring_in(carrier);
            }
        }
    }

    fn lay(&mut self, carrier: u32, pass: [u32; 2], spot: Spot, step: Step, needle: Needle) {
        if let Some(other) = self.carriers.lay(carrier, pass, spot, step) {
            self.fault(FaultKind::Tangled(self.name(other)), Some(needle), Some(carrier));
        }
    }
}
