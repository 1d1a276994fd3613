//! Yarn that no loop holds: its carrier draws it back.
//!
//! A yarn is held by its loops, and at places where another yarn has caught it. Between two places
//! that hold it the yarn is taut, and floats past the needles between them. Yarn that was laid
//! further out, on the way to the place where the carrier was parked, is drawn back and is no part
//! of the cloth. Neither is yarn before the first place that holds it, or after the last one. A
//! loop that was drawn through nothing and fell off its needle does not hold its yarn.

use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::super::{Direction, Fate, LoopRef, Step};
use super::FaultKind;
use super::run::Run;

/// Removes yarn that nothing holds, and the loops of that yarn. A repeat is `width` needles wide.
///
/// **Errors**: [`OutOfMemory`].
pub(super) fn back(run: &mut Run<'_>, width: Option<i32>) -> Result<(), OutOfMemory> {
    let holding = holding(run)?;
    let mut caught = std::mem::take(&mut run.carriers.caught);
    caught.sort_unstable();
    let (mut caught, mut held, mut loose) = (&caught[..], Vec::new(), Vec::new());
    for (number, strand) in run.carriers.strands.iter_mut().enumerate() {
        let (own, others) = caught.split_at(caught.partition_point(|&[strand, _]| strand == number));
        caught = others;
        let loops = &run.loops;
        let place = |step: &Step| match *step {
            Step::Loop { number, direction } => (loops[number as usize].at, direction),
            Step::Float { at, direction, .. } => (at, direction),
        };
        held.clear();
        room_for(&mut held, strand.steps.len(), "what holds a yarn")?;
        for (index, step) in strand.steps.iter().enumerate() {
            let holds = match *step {
                Step::Loop { number, .. } => holding[number as usize],
                Step::Float { .. } => own.binary_search(&[number, index]).is_ok(),
            };
            if holds {
                held.push((index, place(step).0));
            }
        }
        let round = strand.onward.zip(width).map(|([right, _], width)| (right * width) as f32);
        let ends = round.and_then(|round| Some([held.last()?.1 - round, held.first()?.1 + round]));
        match strand.steps.first() {
            // A yarn that goes on from repeat to repeat and that nothing holds lies straight across
            // all repeats.
            Some(_) if held.is_empty() && round.is_some() => continue,
            Some(&Step::Float { source, .. }) if held.is_empty() => loose.push((strand.carrier, source)),
            _ => {}
        }
        let (mut index, mut ahead, mut from) = (0, held.iter().peekable(), ends.map(|[before, _]| before));
        strand.steps.retain(|step| {
            let (at, direction) = place(step);
            let stays = if ahead.next_if(|(next, _)| *next == index).is_some() {
                true
            } else {
                let to = ahead.peek().map(|(_, at)| *at).or(ends.map(|[_, after]| after));
                from.zip(to).is_some_and(|(from, to)| match direction {
                    Direction::Right => from < at && at < to,
                    Direction::Left => from > at && at > to,
                })
            };
            from = if stays { Some(at) } else { from };
            index += 1;
            stays
        });
    }
    for (carrier, source) in loose {
        run.at_source(source);
        run.fault(FaultKind::Loose, None, Some(carrier));
    }
    leave_out(run)
}

/// For each loop, whether it holds its yarn. A dropped loop does not hold its yarn if it was drawn
/// through nothing and nothing was drawn through it.
fn holding(run: &Run<'_>) -> Result<Vec<bool>, OutOfMemory> {
    let mut holding = Vec::new();
    room_for(&mut holding, run.loops.len(), "what holds a yarn")?;
    holding.extend(run.loops.iter().map(|stitch| stitch.fate != Fate::Dropped || !stitch.parents.is_empty()));
    for parent in &run.parents {
        holding[parent.number as usize] = true;
    }
    Ok(holding)
}

/// Removes loops that no yarn makes any more. None of these is drawn through another loop.
fn leave_out(run: &mut Run<'_>) -> Result<(), OutOfMemory> {
    let steps = || run.carriers.strands.iter().flat_map(|strand| &strand.steps);
    let made = steps().filter(|step| matches!(step, Step::Loop { .. })).count();
    if made == run.loops.len() {
        return Ok(());
    }
    // The new numbers of the loops that stay.
    let mut numbers: Vec<Option<u32>> = Vec::new();
    room_for(&mut numbers, run.loops.len(), "numbers of loops")?;
    numbers.resize(run.loops.len(), None);
    for step in steps() {
        if let Step::Loop { number, .. } = *step {
            numbers[number as usize] = Some(0);
        }
    }
    for (number, own) in (0..).zip(numbers.iter_mut().flatten()) {
        *own = number;
    }
    let renumber = |number: &mut u32| *number = numbers[*number as usize].unwrap_or(*number);
    let refer = |other: &mut LoopRef| renumber(&mut other.number);
    run.parents.iter_mut().for_each(refer);
    for step in run.carriers.strands.iter_mut().flat_map(|strand| &mut strand.steps) {
        if let Step::Loop { number, .. } = step {
            renumber(number);
        }
    }
    let mut own = numbers.iter();
    run.loops.retain_mut(|stitch| {
        if let Fate::Held(child) = &mut stitch.fate {
            refer(child);
        }
        own.next().is_some_and(Option::is_some)
    });
    Ok(())
}
