//! The knitting machine, which runs a program and records which loop is drawn through which.

mod beds;
mod carriers;
mod courses;
mod drawn;
mod fault;
mod floats;
mod limits;
mod run;

pub use fault::{Fault, FaultKind};
pub(super) use limits::CARRIERS_MAX;
use limits::{FAULTS_LISTED, LOOPS_MAX};
pub use limits::{Machine, NEEDLE_MAX, STACK_MAX};

use super::{Fate, Instruction, Operation, Program, Step, Stitches};
use crate::FabricError;
use crate::weft::WeftError;
use beds::{Beds, Held, Slot};
use run::Run;

/// The most rounds that a repeat is knitted after its first round, until the same loops hang on
/// needles at the end of two consecutive rounds. Most programs take two rounds in all. If loops are
/// transferred in every round without being knitted, a program takes more.
const ROUNDS_MAX: u32 = 8;

/// The result of a knitting program.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Knit {
    /// The loops and yarns of the cloth.
    pub stitches: Stitches,
    /// Faults of the program in the order of their sources. There are 1000 at most, apart from one
    /// [`FaultKind::CastOn`] and one [`FaultKind::OnlyLoop`]. For a repeat they are the faults of
    /// its last round, which occur again in every later round.
    pub faults: Vec<Fault>,
    /// Number of faults that are not listed.
    pub unlisted: u64,
}

impl Machine {
    /// Runs a program.
    ///
    /// A program that is a repeat runs round after round, until the same loops hang on its needles
    /// at the end of two consecutive rounds, but for at most 8 rounds after the first. The last
    /// round gives the cloth. Each pass of a carrier is a strand that goes on in the repeat beside
    /// it, unless the program itself brings the carrier in.
    ///
    /// No fault stops the machine. [`FaultKind`] says what the machine does instead.
    ///
    /// **Errors**: [`WeftError::KnitSize`] for too many loops, carriers, sets of carriers, needles
    /// of a repeat, loops on one needle, or loops that others are drawn through,
    /// [`WeftError::KnitNeedle`] for needles beyond [`NEEDLE_MAX`], [`WeftError::KnitCarriers`] for
    /// carriers that the program does not have, and [`FabricError::OutOfMemory`].
    ///
    /// ```
    /// use texere_fabric::weft::{CarrierSet, Direction, Fate, Instruction, LoopRef, Machine, Needle, Operation, Program};
    /// let knit = Instruction::Knit(Direction::Right, Needle::front(0));
    /// let one = Operation { instruction: knit, carriers: CarrierSet(1), source: 0 };
    /// let program = Program {
    ///     carriers: vec!["1".into()],
    ///     carrier_sets: vec![vec![], vec![0]],
    ///     operations: vec![one],
    ///     repeat: Some(1),
    /// };
    /// let stitches = Machine::default().knit(&program)?.stitches;
    /// // The loop of the next round is drawn through the loop of this round.
    /// assert_eq!(stitches.loops[0].fate, Fate::Held(LoopRef { number: 0, repeat: [0, 1] }));
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    pub fn knit(&self, program: &Program) -> Result<Knit, FabricError> {
        let loops = check(program)?;
        let (low, width) = beds_of(program)?;
        let mut run = Run::new(*self, program, Beds::new(low, width, program.repeat.is_some())?, loops)?;
        run.all()?;
        if program.repeat.is_some() {
            let mut hung = state(&run);
            while run.round < ROUNDS_MAX {
                run.round += 1;
                run.all()?;
                let next = state(&run);
                if std::mem::replace(&mut hung, next) == hung {
                    break;
                }
            }
        }
        let width = program.repeat.map(|_| width);
        finish(run, width, self.float_max)
    }
}

/// The state in which the next round begins: the loops on each needle with their age in rounds, the
/// rack and the loop length.
fn state(run: &Run<'_>) -> (Vec<(usize, Held)>, f64, Option<f32>) {
    let since = |held: &Held| Held { round: run.round - held.round, ..*held };
    let stacks = run.beds.stacks().iter().enumerate();
    let hung = stacks.flat_map(|(index, stack)| stack.iter().map(move |held| (index, since(held))));
    (hung.collect(), run.rack, run.length_mm)
}

/// Checks the carriers of all operations, and the numbers of carriers, sets and loops. Returns the
/// number of loops that the program makes.
fn check(program: &Program) -> Result<usize, WeftError> {
    let size = |what, count: usize, limit: usize, operation| {
        let (count, limit) = (count as u64, limit as u64);
        if count > limit { Err(WeftError::KnitSize { what, count, limit, operation }) } else { Ok(()) }
    };
    size("carriers", program.carriers.len(), CARRIERS_MAX, 0)?;
    size("sets of carriers", program.carrier_sets.len(), CARRIERS_MAX, 0)?;
    let mut loops = 0_usize;
    for (number, operation) in (1..).zip(&program.operations) {
        let unknown = WeftError::KnitCarriers { operation: number };
        let none = Vec::new();
        let set = match program.carrier_sets.get(operation.carriers.0 as usize) {
            Some(set) => set,
            // Set 0 is empty, even if the program has no sets.
            None if operation.carriers.0 == 0 => &none,
            None => return Err(unknown),
        };
        if set.iter().any(|carrier| *carrier as usize >= program.carriers.len()) {
            return Err(unknown);
        }
        if let Instruction::Knit(..) | Instruction::Tuck(..) | Instruction::Split(..) = operation.instruction
        {
            loops = loops.saturating_add(set.len());
            size("loops", loops, LOOPS_MAX, number)?;
        }
    }
    Ok(loops)
}

/// The lowest needle of the beds, and the number of needles from it to the highest one.
fn beds_of(program: &Program) -> Result<(i32, i32), WeftError> {
    let (mut low, mut high) = (i32::MAX, i32::MIN);
    for (operation, Operation { instruction, .. }) in (1..).zip(&program.operations) {
        let needles = match *instruction {
            Instruction::Knit(_, needle)
            | Instruction::Tuck(_, needle)
            | Instruction::Miss(_, needle)
            | Instruction::Drop(needle) => [needle; 2],
            Instruction::Split(_, from, to) | Instruction::Transfer(from, to) => [from, to],
            _ => continue,
        };
        for needle in needles {
            if needle.number.unsigned_abs() > NEEDLE_MAX.unsigned_abs() {
                return Err(WeftError::KnitNeedle { needle, limit: NEEDLE_MAX, operation });
            }
            (low, high) = (low.min(needle.number), high.max(needle.number));
        }
    }
    match program.repeat {
        Some(width) => match i32::try_from(width) {
            Ok(wales @ 1..=NEEDLE_MAX) => Ok((0, wales)),
            _ => {
                let (what, limit) = ("needles in a repeat", NEEDLE_MAX as u64);
                Err(WeftError::KnitSize { what, count: u64::from(width), limit, operation: 0 })
            }
        },
        None if low > high => Ok((0, 1)),
        None => Ok((low, high - low + 1)),
    }
}

/// Completes the run at the end of the program, when the courses, fates and heads of all loops and
/// the faults of the whole program are known.
fn finish(mut run: Run<'_>, width: Option<i32>, float_max: u32) -> Result<Knit, FabricError> {
    left(&mut run, width.is_some());
    let aboves = run.aboves();
    let (courses, height) = courses::courses(&run.carriers.before, &aboves, width.is_some());
    for (stitch, end) in run.loops.iter_mut().zip(&run.ends) {
        stitch.course = courses[stitch.course as usize];
        if let Some((fate, head)) = *end {
            (stitch.fate, stitch.head) = (fate, head);
        }
    }
    for step in run.carriers.strands.iter_mut().flat_map(|strand| &mut strand.steps) {
        if let Step::Float { course, .. } = step {
            *course = courses[*course as usize];
        }
    }
    drawn::back(&mut run, width)?;
    // A carrier whose yarn no loop holds lays no yarn.
    run.carriers.strands.retain(|strand| !strand.steps.is_empty());
    floats::long(&mut run, width, float_max);
    let repeat = width.zip(height).map(|(width, height)| [width.unsigned_abs(), height]);
    let strands = std::mem::take(&mut run.carriers.strands);
    run.faults.extend(run.cast_on.take().into_iter().chain(run.only_loop.take()));
    run.faults.sort_by_key(|fault| fault.source);
    let stitches = Stitches { loops: run.loops, parents: run.parents, strands, repeat };
    Ok(Knit { stitches, faults: run.faults, unlisted: run.unlisted })
}

/// Records the loops that hang on needles at the end.
fn left(run: &mut Run<'_>, repeats: bool) {
    let stacks = run.beds.stacks().iter().enumerate();
    let hung: Vec<(usize, Vec<Held>)> =
        stacks.filter(|(_, stack)| !stack.is_empty()).map(|(index, stack)| (index, stack.clone())).collect();
    if !repeats {
        let loops: usize = hung.iter().map(|(_, stack)| stack.len()).sum();
        if let Some(&(index, ref stack)) = hung.first() {
            run.at_source(run.loops[stack[0].number as usize].source);
            run.fault(FaultKind::LeftOnNeedles(loops as u32), Some(run.beds.needle(index)), None);
        }
    }
    for (index, stack) in hung {
        let (needle, slot) = (run.beds.needle(index), Slot { index, repeat: 0 });
        // A loop of the first or the second round that still hangs here after all rounds was never
        // knitted. Loops of the second round count as well, because the first round may begin with
        // loops on other needles than later rounds do.
        if repeats && stack.iter().any(|held| run.round - held.round + 1 >= ROUNDS_MAX) {
            run.at_source(run.loops[stack[0].number as usize].source);
            run.fault(FaultKind::NeverKnits, Some(needle), None);
        }
        for (layer, held) in stack.iter().enumerate() {
            if !repeats || run.ends[held.number as usize].is_none() {
                run.ends[held.number as usize] = Some((Fate::OnNeedle, run.head(held, needle, slot, layer)));
            }
        }
    }
}
