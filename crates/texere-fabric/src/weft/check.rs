//! Checks of stitches, gauge and yarns before a cloth is made of them.

use texere_core::{Material, Origin, Section, Yarn};

use super::cells::passed_on_way;
use super::form::point_count;
use super::layers::held_until;
use super::{Direction, Fate, Gauge, KnitYarn, LoopRef, Step, Stitches, Strand, Visit, WeftError};
use crate::{FabricError, POINTS_MAX, SPACING_MAX, SPACING_MIN, yarn_check};

/// The furthest place of a needle from needle 0, in wales.
const WALES_MAX: f32 = 1e6;

/// The most wales, and the most courses, of all copies of a repeat together.
const SIDE_MAX: u32 = 1 << 30;

/// The most wales by which a loop is moved.
pub(super) const MOVED_MAX: f32 = 256.0;

/// The most loops of several repeats that settle together.
const TILED_MAX: u64 = 1 << 16;

/// Control points of a float past one needle, with the arc to the next needle.
const PASSED_POINTS: u64 = 3;
/// Control points of a turn.
const TURN_POINTS: u64 = 3;

/// The most control points of a repeat, which is laid and settles as one. Reading and laying take
/// 73 to 79 bytes for each point, a gigabyte in all. A picture of 1,024 × 1,024 stitches stays
/// within the limit, even with a second yarn that knits a single stitch. With two yarns in every
/// row, 910 × 910 stitches stay within the limit.
const REPEAT_POINTS_MAX: u64 = 12_600_000;

/// The most needles and courses that yarns may pass in a knit, apart from [`PASSED_BESIDE_A_LOOP`]
/// for each loop. Every needle or course that a yarn passes takes memory.
const PASSED_MAX: u64 = 1 << 16;
/// The needles and courses that yarns may pass for each loop of a knit.
const PASSED_BESIDE_A_LOOP: u64 = 64;

pub(crate) fn gauge(gauge: &Gauge) -> Result<(), WeftError> {
    let Gauge { wale_mm, course_mm, loop_length_mm } = *gauge;
    let lengths = [("wales", wale_mm), ("courses", course_mm), ("loops", loop_length_mm.unwrap_or(1.0))];
    match lengths.into_iter().find(|(_, mm)| !(SPACING_MIN..=SPACING_MAX).contains(mm)) {
        Some((what, mm)) => Err(WeftError::Gauge { what, mm, low: SPACING_MIN, high: SPACING_MAX }),
        None => Ok(()),
    }
}

/// Checks each yarn's radius and twist, and that its material and section exist. `origin` gives the
/// origin of a yarn by its number, counted from 0, for errors.
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

/// Checks that stitches refer only to loops, repeats and carriers that exist, that places and moves
/// are within their limits, and that each held loop is held by a loop of a later course.
pub(super) fn stitches(stitches: &Stitches, yarns: usize) -> Result<(), WeftError> {
    let sound = |sound: bool, what| if sound { Ok(()) } else { Err(WeftError::Stitches { what }) };
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
            return Err(WeftError::Carrier { carrier: strand.carrier + 1, yarns });
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

/// Checks the needles and courses that yarns pass, the size of all copies, and the number of
/// control points. The number is estimated, so that the check comes before any point is made.
pub(super) fn size(stitches: &Stitches, copies: [u32; 2]) -> Result<(), WeftError> {
    let held = stitches.loops.iter().filter_map(|stitch| {
        let until = held_until(stitches, stitch.fate)?;
        Some(until.saturating_sub(i64::from(stitch.course)).unsigned_abs())
    });
    let held: u64 = held.sum();
    let passed: u64 = stitches.strands.iter().map(|strand| passed(stitches, strand)).sum();
    let (passed, loops) = (passed.saturating_add(held.saturating_mul(2)), stitches.loops.len() as u64);
    let limit = passed_max(loops);
    if passed > limit {
        return Err(WeftError::KnitRuns { passed, loops, limit, operation: furthest(stitches) });
    }
    let points = repeat_points(points(stitches))?;
    let sides = stitches.repeat.unwrap_or([1, 1]).into_iter().zip(copies);
    if sides.into_iter().any(|(size, copies)| u64::from(size) * u64::from(copies) > u64::from(SIDE_MAX)) {
        return Err(WeftError::Stitches { what: "too many wales or courses" });
    }
    let copies = if stitches.repeat.is_some() { u64::from(copies[0]) * u64::from(copies[1]) } else { 1 };
    let points = points.saturating_mul(copies);
    if copies == 0 {
        return Err(WeftError::Stitches { what: "no copy of the repeat" });
    }
    if points > POINTS_MAX { Err(WeftError::KnitPoints { points, limit: POINTS_MAX }) } else { Ok(()) }
}

/// Returns `points`, or an error if they are more than a repeat may have.
pub(crate) fn repeat_points(points: u64) -> Result<u64, WeftError> {
    if points > REPEAT_POINTS_MAX {
        return Err(WeftError::KnitRepeat { points, limit: REPEAT_POINTS_MAX });
    }
    Ok(points)
}

/// About how many control points a knit's yarns have. Ends, turns over several courses, and needles
/// half a wale apart are left out. In a knit without these the number is exact.
fn points(stitches: &Stitches) -> u64 {
    let loops = (0..stitches.loops.len() as u32).map(|number| point_count(stitches, number));
    let strands = stitches.strands.iter().map(|strand| {
        let visit = |step: &Step| stitches.visit(step);
        let floats = strand.steps.iter().filter(|step| matches!(step, Step::Float { .. })).count() as u64;
        let joins: u64 = strand.steps.windows(2).map(|pair| join(&visit(&pair[0]), &visit(&pair[1]))).sum();
        // A yarn that goes on comes to its first needle again in the next repeat.
        let onward = strand.onward.zip(stitches.repeat).zip(strand.steps.first().zip(strand.steps.last()));
        let onward = onward.map_or(0, |(([right, _], [width, _]), (first, last))| {
            let first = visit(first);
            join(&visit(last), &Visit { at: first.at + right as f32 * width as f32, ..first })
        });
        (PASSED_POINTS - 1) * floats + joins + onward
    });
    loops.sum::<u64>() + strands.sum::<u64>()
}

/// Number of control points between two needles, with those of floats past the needles between.
fn join(one: &Visit, other: &Visit) -> u64 {
    let turns = one.direction != other.direction;
    let way = f64::from(other.at - one.at) * if one.direction == Direction::Right { 1.0 } else { -1.0 };
    PASSED_POINTS * passed_on_way(way, turns).len() as u64 + if turns { TURN_POINTS } else { 1 }
}

/// The most needles and courses that yarns may pass in a knit of `loops` loops or laps.
pub(crate) const fn passed_max(loops: u64) -> u64 {
    PASSED_MAX + PASSED_BESIDE_A_LOOP * loops
}

/// Checks the size of the piece that settles together: `tiles` copies of a repeat of `loops` loops
/// or laps.
pub(crate) fn tiled(tiles: [u32; 2], loops: u64) -> Result<(), WeftError> {
    let count = u64::from(tiles[0]) * u64::from(tiles[1]);
    if count > 1 && count.saturating_mul(loops) > TILED_MAX {
        return Err(WeftError::Copies { loops: count.saturating_mul(loops), limit: TILED_MAX });
    }
    Ok(())
}

/// Number of needles and courses that a yarn passes from step to step.
fn passed(stitches: &Stitches, strand: &Strand) -> u64 {
    ways(stitches, strand).map(|(passed, _)| passed).sum()
}

/// For each step of a yarn but the first, the needles and courses passed on the way to it, and its
/// source.
fn ways(stitches: &Stitches, strand: &Strand) -> impl Iterator<Item = (u64, u32)> {
    strand.steps.windows(2).map(|pair| {
        let [one, other] = [&pair[0], &pair[1]].map(|step| stitches.visit(step));
        let passed = (one.at - other.at).abs() as u64 + u64::from(one.course.abs_diff(other.course));
        (passed, other.source)
    })
}

/// The source of the loop at which the longest way of a yarn between two loops ends. Floats between
/// the two loops are part of the way.
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

#[cfg(test)]
mod tests {
    use super::super::{Backing, Beds, Chart, Knitted, Machine, Program};
    use super::*;

    fn chart(text: &str, beds: Beds) -> Program {
        Chart::parse(text, beds).unwrap().program().unwrap()
    }

    /// A Jacquard with this number of colours, in squares of `block` stitches.
    fn jacquard(colours: u32, block: usize, backing: Option<Backing>) -> Program {
        let colour = |wale: usize, row: usize| ((wale / block + row / block) as u32) % colours;
        Chart::jacquard(12 * block, 12 * block, backing, colour).unwrap().program().unwrap()
    }

    #[test]
    fn the_size_of_a_repeat_is_known_before_it_is_laid() {
        let mut programs = vec![
            ("plain", chart("k", Beds::One)),
            ("garter", chart("k\np", Beds::One)),
            ("rib", chart("kp", Beds::One)),
            ("tuck", chart("kt\nkk\ntk\nkk", Beds::One)),
            ("miss", chart("kmmk\nkkkk", Beds::One)),
            ("slips over four courses", chart("kkkk\nkmkm\nkmkm\nkmkm\nkmkm", Beds::One)),
            ("interlock", chart("kp\npk", Beds::Two)),
        ];
        for block in [1, 3] {
            for colours in [2, 3, 4] {
                programs.push(("single Jacquard", jacquard(colours, block, None)));
                programs.push(("bird's-eye back", jacquard(colours, block, Some(Backing::Birdseye))));
                programs.push(("ladder back", jacquard(colours, block, Some(Backing::Ladder))));
            }
        }
        for (name, program) in programs {
            let yarns = vec![KnitYarn::new(0.1); program.carriers.len()];
            let stitches = Machine::default().knit(&program).unwrap().stitches;
            let gauge = Gauge::new(1.0, 0.75);
            let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
            let estimate = points(&stitches);
            let knit = Knitted::new(stitches, gauge, yarns, materials, sections, [1, 1]).unwrap();
            let placed = knit.piece().unwrap().yarns.points().len();
            let share = estimate as f64 / placed as f64;
            assert!((0.9..1.1).contains(&share), "{name}: {estimate} for {placed}");
        }
    }
}
