//! Whether stitches, gauge and yarns can be a cloth.

use texere_core::{Material, Origin, Section, Yarn};

use super::layers::held_until;
use super::{Fate, Gauge, KnitYarn, LoopRef, Step, Stitches, Strand};
use crate::{FabricError, POINTS_MAX, SPACING_MAX, SPACING_MIN, yarn_check};

/// The furthest that a needle lies from the first one, in wales.
const WALES_MAX: f32 = 1e6;

/// The most wales or courses of all copies of a repeat.
const SIDE_MAX: u32 = 1 << 30;

/// How many wales a loop is moved at most.
pub(super) const MOVED_MAX: f32 = 256.0;

/// The most loops of several repeats that settle together.
const TILED_MAX: u64 = 1 << 16;

/// Control points of a loop at least, and of a needle or a course that its yarn passes.
const LOOP_POINTS: u64 = 10;
const PASSED_POINTS: u64 = 3;

/// The most control points of a repeat, which is laid and settles as one: a gigabyte, for laying takes up to 70 bytes for each. That is a picture
/// of 1,060 × 1,060 stitches, or of 870 × 870 with two yarns.
const REPEAT_POINTS_MAX: u64 = 14 << 20;

/// The most needles and courses that yarns pass: so many, and so many more for each loop. All of them take memory.
const PASSED_MAX: u64 = 1 << 16;
const PASSED_BESIDE_A_LOOP: u64 = 64;

pub(crate) fn gauge(gauge: &Gauge) -> Result<(), FabricError> {
    let Gauge { wale_mm, course_mm, loop_length_mm } = *gauge;
    let lengths = [("wales", wale_mm), ("courses", course_mm), ("loops", loop_length_mm.unwrap_or(1.0))];
    match lengths.into_iter().find(|(_, mm)| !(SPACING_MIN..=SPACING_MAX).contains(mm)) {
        Some((what, mm)) => Err(FabricError::Gauge { what, mm, low: SPACING_MIN, high: SPACING_MAX }),
        None => Ok(()),
    }
}

/// Whether yarns are sound; `origin` names the one with a number, from 0.
pub(crate) fn yarns(
    yarns: &[KnitYarn],
    origin: impl Fn(u32) -> Origin,
    materials: &[Material],
    sections: &[Section],
) -> Result<(), FabricError> {
    yarn_check::sections(sections)?;
    for (number, yarn) in (0..).zip(yarns) {
        let KnitYarn { radius_mm, material, section, twist } = *yarn;
        let yarn = Yarn { material, section, closed: false, twist, origin: origin(number) };
        yarn_check::yarn(&yarn, radius_mm, materials, sections)?;
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
        sound(
            (stitch.head.at - stitch.at).abs() <= MOVED_MAX,
            "a loop that is moved over more than 256 needles",
        )?;
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
    let held = stitches.loops.iter().filter_map(|stitch| {
        let until = held_until(stitches, stitch.fate)?;
        Some(until.saturating_sub(i64::from(stitch.course)).unsigned_abs())
    });
    let held: u64 = held.sum();
    let passed: u64 = stitches.strands.iter().map(|strand| passed(stitches, strand)).sum();
    let (passed, loops) = (passed.saturating_add(held.saturating_mul(2)), stitches.loops.len() as u64);
    let limit = passed_max(loops);
    if passed > limit {
        return Err(FabricError::KnitRuns { passed, loops, limit, told: furthest(stitches) });
    }
    let points = repeat_points(loops, passed)?;
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

/// Control points of a repeat of so many loops whose yarns pass so many needles and courses, about, unless they are too many to be laid as
/// one.
pub(crate) fn repeat_points(loops: u64, passed: u64) -> Result<u64, FabricError> {
    let points = LOOP_POINTS.saturating_mul(loops).saturating_add(PASSED_POINTS.saturating_mul(passed));
    if points > REPEAT_POINTS_MAX {
        return Err(FabricError::KnitRepeat { points, limit: REPEAT_POINTS_MAX });
    }
    Ok(points)
}

/// How many needles and courses yarns may pass between so many loops or laps.
pub(crate) const fn passed_max(loops: u64) -> u64 {
    PASSED_MAX + PASSED_BESIDE_A_LOOP * loops
}

/// Whether the repeats of so many loops or laps that settle together are not too many.
pub(crate) fn tiled(tiles: [u32; 2], loops: u64) -> Result<(), FabricError> {
    let count = u64::from(tiles[0]) * u64::from(tiles[1]);
    if count > 1 && count.saturating_mul(loops) > TILED_MAX {
        return Err(FabricError::Copies { loops: count.saturating_mul(loops), limit: TILED_MAX });
    }
    Ok(())
}

/// How many needles a yarn passes from loop to loop, and how many courses.
fn passed(stitches: &Stitches, strand: &Strand) -> u64 {
    ways(stitches, strand).map(|(passed, _)| passed).sum()
}

/// How far a yarn goes from each step to the next, in needles and courses, and the source of that.
fn ways(stitches: &Stitches, strand: &Strand) -> impl Iterator<Item = (u64, u32)> {
    strand.steps.windows(2).map(|pair| {
        let [one, other] = [&pair[0], &pair[1]].map(|step| stitches.visit(step));
        let passed = (one.at - other.at).abs() as u64 + u64::from(one.course.abs_diff(other.course));
        (passed, other.source)
    })
}

/// The source of the loop after the longest way of a yarn from one to the next, whatever it floats past in between.
fn furthest(stitches: &Stitches) -> Option<u32> {
    let mut longest = (0, None);
    for strand in &stitches.strands {
        let mut way = 0;
        for ((passed, source), step) in ways(stitches, strand).zip(strand.steps.iter().skip(1)) {
            way += passed;
            if matches!(step, Step::Loop { .. }) {
                if way > longest.0 {
                    longest = (way, Some(source));
                }
                way = 0;
            }
        }
    }
    longest.1
}
