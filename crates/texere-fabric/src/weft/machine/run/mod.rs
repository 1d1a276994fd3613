//! Runs a program, one operation after another.

mod making;

use texere_core::backend::room_for;

use super::super::stitches::HALVES;
use super::super::{
    CarrierSet, Fate, Head, Instruction, LoopKind, LoopRef, Needle, Operation, Program, Stitch,
};
use super::beds::{Beds, Held, Slot};
use super::carriers::Carriers;
use super::courses::Above;
use super::{FAULTS_LISTED, Fault, FaultKind, Machine, NEEDLE_MAX, STACK_MAX};
use crate::FabricError;
use crate::weft::WeftError;

/// The fate of a loop, and the place of its head at its end.
pub(super) type End = (Fate, Head);

/// The state of a machine that runs a program.
#[derive(Debug)]
pub(super) struct Run<'a> {
    machine: Machine,
    program: &'a Program,
    pub(super) beds: Beds,
    pub(super) rack: f64,
    pub(super) length_mm: Option<f32>,
    pub(super) carriers: Carriers,
    /// The round of the repeat, counted from 0.
    pub(super) round: u32,
    /// Number of transfers in this round.
    moved: u32,
    /// The loops made in this round. Until the program ends, they have the number of their pass in
    /// place of their course.
    pub(super) loops: Vec<Stitch>,
    pub(super) parents: Vec<LoopRef>,
    /// For the number of each loop, the fate that a loop of this number met in this round. The loop
    /// itself may be one of an earlier round.
    pub(super) ends: Vec<Option<End>>,
    /// The pass of each loop.
    passes: Vec<u32>,
    /// Passes, with the loops that they are drawn through. Until the program ends, `below` is the
    /// number of a loop instead of a pass, because passes of earlier rounds may have had other
    /// numbers.
    aboves: Vec<Above>,
    pub(super) faults: Vec<Fault>,
    pub(super) unlisted: u64,
    /// The [`FaultKind::CastOn`] of this round, which a program gets only once; none if there is
    /// none.
    pub(super) cast_on: Option<Fault>,
    /// The [`FaultKind::OnlyLoop`] of this round, which a program gets only once, too.
    pub(super) only_loop: Option<Fault>,
    /// The source of the current operation.
    source: u32,
    /// The number of the current operation, counted from 1.
    operation: u64,
}

impl<'a> Run<'a> {
    pub(super) fn new(
        machine: Machine,
        program: &'a Program,
        beds: Beds,
        loops: usize,
    ) -> Result<Self, FabricError> {
        let mut run = Self {
            machine,
            program,
            beds,
            rack: 0.0,
            length_mm: None,
            carriers: Carriers::default(),
            round: 0,
            moved: 0,
            loops: Vec::new(),
            parents: Vec::new(),
            ends: Vec::new(),
            passes: Vec::new(),
            aboves: Vec::new(),
            faults: Vec::new(),
            unlisted: 0,
            cast_on: None,
            only_loop: None,
            source: 0,
            operation: 0,
        };
        room_for(&mut run.loops, loops, "loops")?;
        room_for(&mut run.parents, loops, "parents of loops")?;
        room_for(&mut run.ends, loops, "fates of loops")?;
        room_for(&mut run.passes, loops, "passes of loops")?;
        run.passes.resize(loops, 0);
        Ok(run)
    }

    /// Runs all operations once. Only the loops on needles, the rack and the loop length are kept
    /// from the previous round.
    pub(super) fn all(&mut self) -> Result<(), FabricError> {
        let loops = self.passes.len();
        self.carriers = Carriers::new(self.program.carriers.len(), self.program.repeat.is_some());
        (self.moved, self.unlisted) = (0, 0);
        (self.cast_on, self.only_loop) = (None, None);
        self.loops.clear();
        self.parents.clear();
        self.aboves.clear();
        self.faults.clear();
        self.ends.clear();
        self.ends.resize(loops, None);
        for (number, operation) in (1..).zip(&self.program.operations) {
            self.operation = number;
            self.source = operation.source;
            self.one(operation)?;
        }
        Ok(())
    }

    /// All pairs of passes of which one is drawn through the other, in order.
    pub(super) fn aboves(&mut self) -> Vec<Above> {
        let mut aboves = std::mem::take(&mut self.aboves);
        for above in &mut aboves {
            above.below = self.passes[above.below as usize];
        }
        aboves.sort_unstable();
        aboves.dedup();
        aboves
    }

    pub(super) fn fault(&mut self, kind: FaultKind, needle: Option<Needle>, carrier: Option<u32>) {
        if self.faults.len() == FAULTS_LISTED {
            self.unlisted += 1;
            return;
        }
        let carrier = carrier.map(|carrier| self.name(carrier));
        self.faults.push(Fault { kind, source: self.source, needle, carrier });
    }

    /// Sets the source of the faults that follow.
    pub(super) fn at_source(&mut self, source: u32) {
        self.source = source;
    }

    fn name(&self, carrier: u32) -> String {
        self.program.carriers[carrier as usize].clone()
    }

    fn one(&mut self, operation: &Operation) -> Result<(), FabricError> {
        let program = self.program;
        let CarrierSet(set) = operation.carriers;
        let carriers = program.carrier_sets.get(set as usize).map_or(&[][..], Vec::as_slice);
        match operation.instruction {
            Instruction::In => self.bring_in(carriers),
            Instruction::InHook => {
                self.free_hook(carriers);
                self.carriers.hook(carriers);
                self.bring_in(carriers);
            }
            Instruction::ReleaseHook => {
                for &carrier in carriers {
                    if !self.carriers.let_go(carrier) {
                        self.fault(FaultKind::HookWithout, None, Some(carrier));
                    }
                }
            }
            Instruction::Out | Instruction::OutHook => {
                if operation.instruction == Instruction::OutHook {
                    self.free_hook(carriers);
                }
                for &carrier in carriers {
                    if self.carriers.loops(carrier) == 1 {
                        self.only_loop(carrier);
                    }
                    if !self.carriers.take_out(carrier) {
                        self.fault(FaultKind::OutWithoutIn, None, Some(carrier));
                    }
                }
            }
            Instruction::Knit(_, needle) if carriers.is_empty() => self.drop(needle)?,
            Instruction::Drop(needle) => self.drop(needle)?,
            Instruction::Split(_, from, to) if carriers.is_empty() => self.transfer(from, to)?,
            Instruction::Transfer(from, to) => self.transfer(from, to)?,
            // Without a carrier no yarn is laid, and the needle only pulls at its loops.
            Instruction::Tuck(..) | Instruction::Miss(..) if carriers.is_empty() => {}
            Instruction::Knit(direction, needle) => {
                self.knit(set, carriers, LoopKind::Knit, direction, needle)?;
            }
            Instruction::Tuck(direction, needle) => {
                self.knit(set, carriers, LoopKind::Tuck, direction, needle)?;
            }
            Instruction::Split(direction, from, to) => self.split(set, carriers, direction, [from, to])?,
            Instruction::Miss(direction, needle) => self.miss(set, carriers, direction, needle)?,
            Instruction::Rack(rack) => self.rack(rack),
            Instruction::LoopLength(length) => {
                self.length_mm = length.map(|mm| mm as f32).filter(|mm| mm.is_finite() && *mm > 0.0);
            }
        }
        Ok(())
    }

    /// Records the fault of a carrier that is taken out after its only loop.
    fn only_loop(&mut self, carrier: u32) {
        match &mut self.only_loop {
            Some(Fault { kind: FaultKind::OnlyLoop { others }, .. }) => *others += 1,
            first => {
                let (kind, carrier) = (
                    FaultKind::OnlyLoop { others: 0 },
                    Some(self.program.carriers[carrier as usize].clone()),
                );
                *first = Some(Fault { kind, source: self.source, needle: None, carrier });
            }
        }
    }

    /// Records a fault if the hook takes carriers while it holds another.
    fn free_hook(&mut self, carriers: &[u32]) {
        if let (Some(held), Some(&carrier)) = (self.carriers.hooked_beside(carriers), carriers.first()) {
            self.fault(FaultKind::HookHolds(self.name(held)), None, Some(carrier));
        }
    }

    fn bring_in(&mut self, carriers: &[u32]) {
        for &carrier in carriers {
            if !self.carriers.bring_in(carrier) {
                self.fault(FaultKind::CarrierIn, None, Some(carrier));
            }
        }
    }

    fn rack(&mut self, rack: f64) {
        let limit = self.machine.rack_max;
        if rack.is_nan() || rack.abs() > limit {
            self.fault(FaultKind::Racked { rack, limit }, None, None);
        }
        if rack.abs() <= f64::from(NEEDLE_MAX) {
            self.rack = rack;
            self.beds.rack(rack);
        }
    }

    fn slot(&self, needle: Needle) -> Result<Slot, WeftError> {
        let error = WeftError::KnitNeedle { needle, limit: NEEDLE_MAX, operation: self.operation };
        self.beds.slot(needle).ok_or(error)
    }

    /// Lets all loops of a needle fall.
    fn drop(&mut self, needle: Needle) -> Result<(), FabricError> {
        let slot = self.slot(needle)?;
        let held = std::mem::take(self.beds.stack(slot));
        let mut fallen = 0;
        for (layer, held) in held.iter().enumerate() {
            let fate = held.split.map_or(Fate::Dropped, Fate::Held);
            fallen += u32::from(fate == Fate::Dropped);
            let head = self.head(held, needle, slot, layer);
            self.ends[held.number as usize] = Some((fate, head));
        }
        if fallen > 0 {
            self.fault(FaultKind::Dropped(fallen), Some(needle), None);
        }
        Ok(())
    }

    /// Moves all loops of a needle.
    ///
    /// Loops keep their order from the front of the machine to its back. The needles of both beds
    /// point at each other, so the loop nearest to the tip of one needle comes nearest to the stem
    /// of the other. The order of the loops on the needle is therefore reversed. All of them lie
    /// nearer to the tip than the loops that the second needle already holds.
    fn transfer(&mut self, from: Needle, to: Needle) -> Result<(), FabricError> {
        let (start, end) = (self.slot(from)?, self.slot(to)?);
        self.aim(from, to);
        if from == to {
            return Ok(());
        }
        let held = std::mem::take(self.beds.stack(start));
        self.hang(held, start, (to, end))
    }

    /// Records faults of a transfer from one needle to the other.
    fn aim(&mut self, from: Needle, to: Needle) {
        if from.bed == to.bed {
            self.fault(FaultKind::SameBed(to), Some(from), None);
        } else if self.rack.fract() != 0.0 || !self.beds.aligned(from, to) {
            self.fault(FaultKind::NotAligned { to, rack: self.rack }, Some(from), None);
        }
    }

    /// Hangs loops of another needle on the needle `to`.
    fn hang(&mut self, held: Vec<Held>, start: Slot, (to, end): (Needle, Slot)) -> Result<(), FabricError> {
        if held.is_empty() {
            return Ok(());
        }
        self.moved += 1;
        let (count, moved) = (held.len(), self.moved);
        let repeat = |held: &Held| held.repeat.saturating_add(start.repeat).saturating_sub(end.repeat);
        let turned = held.iter().rev().map(|held| Held { repeat: repeat(held), moved, ..*held });
        self.beds.stack(end).extend(turned);
        self.piled(to, end, count)
    }

    /// Records a fault if a needle has come to hold more loops than the machine's limit. Returns an
    /// error for more than [`STACK_MAX`]. `added` of the loops are new.
    fn piled(&mut self, needle: Needle, slot: Slot, added: usize) -> Result<(), FabricError> {
        let (loops, limit) = (self.beds.stack(slot).len(), self.machine.pile_max);
        if loops > STACK_MAX {
            let (what, count, limit) = ("loops on a needle", loops as u64, STACK_MAX as u64);
            return Err(WeftError::KnitSize { what, count, limit, operation: self.operation }.into());
        }
        if loops > limit as usize && loops - added <= limit as usize {
            self.fault(FaultKind::Piled { loops: loops as u32, limit }, Some(needle), None);
        }
        Ok(())
    }

    /// The head of a loop on a needle that holds `layer` loops before this one.
    pub(super) fn head(&self, held: &Held, needle: Needle, slot: Slot, layer: usize) -> Head {
        let place = self.beds.place(needle) - self.beds.shift(held.repeat.saturating_add(slot.repeat));
        let at = place as f32 / HALVES as f32;
        Head { at, bed: needle.bed, layer: layer as u16, moved: held.moved }
    }
}
