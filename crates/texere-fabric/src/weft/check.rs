//! Whether stitches, gauge and yarns can be a cloth.

use texere_core::{Material, Origin, RADIUS_MAX, RADIUS_MIN, Section, TWIST_LIMIT};

use super::layers::held_until;
use super::{Fate, Gauge, KnitYarn, LoopRef, Step, Stitches};
use crate::{FabricError, POINTS_MAX, SPACING_MAX, SPACING_MIN};

/// The furthest that a needle lies from the first one, in wales.
const WALES_MAX: f32 = 1e6;

/// The most wales or courses of all copies of a repeat.
const SIDE_MAX: u32 = 1 << 30;

/// Control points of a loop at least.
const LOOP_POINTS: u64 = 10;

pub(super) fn gauge(gauge: &Gauge) -> Result<(), FabricError> {
    let Gauge { wale_mm, course_mm, loop_length_mm } = *gauge;
    let lengths = [("wales", wale_mm), ("courses", course_mm), ("loops", loop_length_mm.unwrap_or(1.0))];
    match lengths.into_iter().find(|(_, mm)| !(SPACING_MIN..=SPACING_MAX).contains(mm)) {
        Some((what, mm)) => Err(FabricError::Gauge { what, mm, low: SPACING_MIN, high: SPACING_MAX }),
        None => Ok(()),
    }
}

pub(super) fn yarns(
    yarns: &[KnitYarn],
    materials: &[Material],
    sections: &[Section],
) -> Result<(), FabricError> {
    for (section, each) in sections.iter().enumerate() {
        each.validate().map_err(|source| FabricError::Section { section, source })?;
    }
    for (number, yarn) in (1..).zip(yarns) {
        let thread = Origin::Carrier(number);
        let KnitYarn { radius_mm, material, section, twist } = *yarn;
        if !(RADIUS_MIN..=RADIUS_MAX).contains(&radius_mm) {
            return Err(FabricError::Radius { thread, radius_mm, low: RADIUS_MIN, high: RADIUS_MAX });
        }
        if !(-TWIST_LIMIT..=TWIST_LIMIT).contains(&twist) {
            return Err(FabricError::Twist { thread, twist, limit: TWIST_LIMIT });
        }
        if material as usize >= materials.len() {
            return Err(FabricError::UnknownMaterial { thread, material, materials: materials.len() });
        }
        if section as usize >= sections.len() {
            return Err(FabricError::UnknownSection { thread, section, sections: sections.len() });
        }
    }
    Ok(())
}

/// Whether stitches refer only to what there is, with a yarn for each carrier.
pub(super) fn stitches(stitches: &Stitches, yarns: usize) -> Result<(), FabricError> {
    let sound = |sound: bool, what| if sound { Ok(()) } else { Err(FabricError::Stitches { what }) };
    let far = |at: f32| at.abs() <= WALES_MAX;
    let refers = |other: LoopRef| {
        (other.number as usize) < stitches.loops.len()
            && (other.repeat == [0, 0] || stitches.repeat.is_some())
            && other.repeat.iter().all(|repeats| repeats.unsigned_abs() < 1 << 16)
    };
    sound(
        stitches.repeat.is_none_or(|repeat| repeat.iter().all(|size| (1..1 << 20).contains(size))),
        "a repeat of no size",
    )?;
    sound(
        stitches.parents.iter().all(|parent| refers(*parent)),
        "a loop that is drawn through none that there is",
    )?;
    for stitch in &stitches.loops {
        let parents = &stitch.parents;
        let listed = parents.start <= parents.end && parents.end as usize <= stitches.parents.len();
        sound(listed, "a loop whose parents are not listed")?;
        sound(far(stitch.at) && far(stitch.head.at), "a loop on no needle")?;
        if let Fate::Held(child) = stitch.fate {
            sound(refers(child), "a loop that is held by none that there is")?;
            let later =
                held_until(stitches, stitch.fate).is_some_and(|course| course > i64::from(stitch.course));
            sound(later, "a loop that is held by one of an earlier course")?;
        }
    }
    for strand in &stitches.strands {
        if strand.carrier as usize >= yarns {
            return Err(FabricError::Carrier { carrier: strand.carrier + 1, yarns });
        }
        let onward = strand
            .onward
            .is_none_or(|onward| stitches.repeat.is_some() && [[1, 0], [-1, 0]].contains(&onward));
        sound(onward, "a yarn that goes on elsewhere than beside itself")?;
        let steps = strand.steps.iter().all(|step| match *step {
            Step::Loop { number, .. } => (number as usize) < stitches.loops.len(),
            Step::Float { at, .. } => far(at),
        });
        sound(steps, "a yarn that makes no loop that there is")?;
    }
    sound(!stitches.loops.is_empty() && !stitches.strands.is_empty(), "no loops")
}

/// Whether the cloth has no more control points than are taken: a low estimate, before any is made.
pub(super) fn size(stitches: &Stitches, copies: [u32; 2]) -> Result<(), FabricError> {
    let held = stitches.loops.iter().map(|stitch| {
        let until = held_until(stitches, stitch.fate).unwrap_or(0);
        until.saturating_sub(i64::from(stitch.course)).unsigned_abs()
    });
    let held: u64 = held.sum();
    let floats: u64 = stitches.strands.iter().map(|strand| floats(stitches, strand)).sum();
    let points = LOOP_POINTS * stitches.loops.len() as u64 + held + floats;
    let sides = stitches.repeat.unwrap_or([1, 1]).into_iter().zip(copies);
    if sides.into_iter().any(|(size, copies)| u64::from(size) * u64::from(copies) > u64::from(SIDE_MAX)) {
        return Err(FabricError::Stitches { what: "too many wales or courses" });
    }
    let copies = if stitches.repeat.is_some() { u64::from(copies[0]) * u64::from(copies[1]) } else { 1 };
    let points = points.saturating_mul(copies);
    if copies == 0 {
        return Err(FabricError::Stitches { what: "no copy of the repeat" });
    }
    if points > POINTS_MAX { Err(FabricError::KnitPoints { points, limit: POINTS_MAX }) } else { Ok(()) }
}

/// How many wales a yarn goes beyond one from loop to loop.
fn floats(stitches: &Stitches, strand: &super::Strand) -> u64 {
    let at = |step: &Step| match *step {
        Step::Loop { number, .. } => stitches.loops[number as usize].at,
        Step::Float { at, .. } => at,
    };
    strand.steps.windows(2).map(|pair| (at(&pair[0]) - at(&pair[1])).abs() as u64).sum()
}
