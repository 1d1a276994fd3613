//! Checks of guide bars: whether each bar is valid, whether all repeat within the cloth, and
//! whether the cloth has loops and an allowed size.

use texere_core::Origin;

use super::laps::laps;
use super::{Bar, LapKind, NEEDLES_MOST, PlacedLap, WarpError};
use crate::settling::settled_together;
use crate::weft::WeftError;
use crate::weft::check::{passed_max, repeat_points, tiled};
use crate::{FabricError, POINTS_MAX, SPACING_MAX, SPACING_MIN};

/// The most guide bars.
const BARS_MAX: usize = 64;

/// The most needles by which a bar may be offset to either side.
const OFFSET_MAX: i32 = 1 << 16;

/// The most wales, and the most courses, of a cloth with all its copies.
const SIDE_MAX: u64 = 1 << 30;

/// The most laps of a cloth before it is copied.
const LAPS_MAX: u64 = 1 << 26;

/// A low estimate of the mean number of control points of a lap. A loop has more, an inlay may have
/// one.
const LAP_POINTS: u64 = 2;

/// Control points of a loop.
const LOOP_POINTS: u64 = 9;

/// Checks that bars are valid, and refer only to yarns that exist.
pub(super) fn bars(bars: &[Bar], yarns: usize) -> Result<(), WarpError> {
    if !(1..=BARS_MAX).contains(&bars.len()) {
        return Err(WarpError::Bars { bars: bars.len(), limit: BARS_MAX });
    }
    for (bar, each) in (1..).zip(bars) {
        if let Some(yarn) = each.threading.guides().iter().flatten().find(|yarn| **yarn as usize >= yarns) {
            return Err(WarpError::GuideYarn { bar, yarn: u64::from(*yarn) + 1, yarns });
        }
        if each.offset.unsigned_abs() > OFFSET_MAX.unsigned_abs() {
            return Err(WarpError::BarOffset { bar, offset: each.offset, limit: OFFSET_MAX });
        }
        if let Some(mm) = each.run_in_mm.filter(|mm| !(SPACING_MIN..=SPACING_MAX).contains(mm)) {
            return Err(WarpError::RunIn { bar, mm, low: SPACING_MIN, high: SPACING_MAX });
        }
        let (courses, chain) = (each.jacquard.as_ref().map(|image| image.courses()), each.chain.courses());
        if let Some(courses) = courses.filter(|courses| *courses != chain) {
            return Err(WarpError::JacquardCourses { bar, courses, chain });
        }
        if let Some((course, lap)) = each.displaced().find(|(_, lap)| lap.overlap().abs() > NEEDLES_MOST) {
            return Err(WarpError::JacquardLap { bar, course: course + 1, lap, limit: NEEDLES_MOST });
        }
    }
    Ok(())
}

/// The first guide that holds the yarn with the number `yarn`, counted from 0. The origin is
/// [`Origin::Unknown`] if no guide holds this yarn.
pub(super) fn first_guide(bars: &[Bar], yarn: u32) -> Origin {
    let guide = |bar: &Bar| bar.threading.guides().iter().position(|threaded| *threaded == Some(yarn));
    let found = (1..).zip(bars).find_map(|(bar, each)| Some((bar, guide(each)?)));
    found.map_or(Origin::Unknown, |(bar, guide)| Origin::Guide { bar, guide: guide as u32 + 1 })
}

/// The numbers of wales and courses after which the patterns of all bars repeat. `size` has to be a
/// multiple of both.
pub(super) fn repeat(bars: &[Bar], size: [u32; 2]) -> Result<[u32; 2], WarpError> {
    let periods = bars.iter().map(|bar| {
        let [guides, rounds] = bar.jacquard.as_ref().map_or([1, 1], |image| image.size());
        let threading = [bar.threading.period() as u64, bar.chain.courses() as u64 * u64::from(rounds)];
        [common(threading[0], u64::from(guides)), threading[1]]
    });
    let repeat = periods.fold([1, 1], |all, own| [0, 1].map(|axis| common(all[axis], own[axis])));
    for (axis, what) in ["wale", "course"].into_iter().enumerate() {
        if size[axis] == 0 || !u64::from(size[axis]).is_multiple_of(repeat[axis]) {
            return Err(WarpError::WarpRepeat { what, size: size[axis], multiple: repeat[axis] });
        }
    }
    Ok(repeat.map(|count| count as u32))
}

/// The least common multiple, or `u64::MAX` if it does not fit.
fn common(one: u64, other: u64) -> u64 {
    let (mut greatest, mut rest) = (one, other);
    while rest > 0 {
        (greatest, rest) = (rest, greatest % rest);
    }
    (one / greatest.max(1)).saturating_mul(other)
}

/// Checks that the cloth has loops and copies, underlaps that are not too long in all, and not too
/// many laps, wales, courses or control points. The number of points is estimated, so that the
/// check comes before any point is made.
pub(super) fn size(
    bars: &[Bar],
    repeat: [u32; 2],
    piece: [u32; 2],
    copies: [u32; 2],
) -> Result<(), FabricError> {
    let area = |size: [u32; 2]| u64::from(size[0]) * u64::from(size[1]);
    let placed = area(piece).saturating_mul(bars.len() as u64);
    let points = placed.saturating_mul(LAP_POINTS).saturating_mul(area(copies));
    let far = (0..2).any(|axis| u64::from(piece[axis]) * u64::from(copies[axis]) > SIDE_MAX);
    if placed > LAPS_MAX {
        return Err(WarpError::Laps { laps: placed, limit: LAPS_MAX }.into());
    }
    if points > POINTS_MAX {
        return Err(WeftError::KnitPoints { points, limit: POINTS_MAX }.into());
    }
    if far {
        return Err(WeftError::Stitches { what: "too many wales or courses" }.into());
    }
    if copies.contains(&0) {
        return Err(WeftError::Stitches { what: "no copy of the repeat" }.into());
    }
    let (mut loops, mut inlays, mut passed, mut points) = (0_u64, 0_u64, 0_u64, 0_u64);
    for placed in laps(bars, repeat[0], repeat[1]) {
        loops += u64::from(placed.lap.overlap().unsigned_abs());
        inlays += u64::from(placed.kind() == LapKind::Inlay);
        passed += u64::from(placed.underlap.unsigned_abs());
        points += lap_points(&placed);
        repeat_points(points)?;
    }
    if loops == 0 {
        return Err(WarpError::NoLoops.into());
    }
    let laps = loops + inlays;
    let limit = passed_max(laps);
    if passed > limit {
        return Err(WeftError::KnitRuns { passed, loops: laps, limit, operation: None }.into());
    }
    let whole = [0, 1].map(|axis| piece[axis] * copies[axis] / repeat[axis]);
    let tiles = settled_together(repeat, whole);
    Ok(tiled(tiles, u64::from(repeat[0]) * u64::from(repeat[1]) * bars.len() as u64)?)
}

/// About how many control points a lap and its underlap have. An underlap is divided into pieces of
/// 0.4 wales (`PIECE` of path.rs).
fn lap_points(placed: &PlacedLap) -> u64 {
    let [needles, underlap] =
        [placed.lap.overlap(), placed.underlap].map(|count| u64::from(count.unsigned_abs()));
    match placed.kind() {
        LapKind::Inlay => 1 + underlap,
        LapKind::Overlap | LapKind::TwoNeedle => {
            LOOP_POINTS * needles + (5 * underlap).div_ceil(2).saturating_sub(1)
        }
    }
}

#[cfg(test)]
mod tests {
    use texere_core::{Material, Section};

    use super::super::{Chain, WarpKnitted};
    use super::*;
    use crate::weft::{Gauge, KnitYarn};

    #[test]
    fn the_size_of_a_repeat_is_known_before_it_is_laid() {
        for bars in [
            &["1-0/1-2//"][..],
            &["1-0/2-3//", "1-2/1-0//"],
            &["0-1/1-0//", "1-0/4-5//"],
            &["1-0/0-1//", "0-0/4-4//"],
            &["2-0/2-4//"],
            &["(1-0/1-2)x4/2-3/2-1//", "5-4/1-0//"],
        ] {
            let bars: Vec<_> = bars.iter().map(|chain| Bar::new(Chain::parse(chain, 1).unwrap())).collect();
            let courses = bars.iter().map(|bar| bar.chain.courses()).max().unwrap() as u32;
            let laps = laps(&bars, 8, courses).map(|placed| lap_points(&placed)).sum::<u64>();
            let (yarns, sections) = (vec![KnitYarn::new(0.04)], vec![Section::Circle]);
            let gauge = Gauge::new(1.0, 0.75);
            let materials = vec![Material::default()];
            let cloth =
                WarpKnitted::new(bars, gauge, 8, courses, yarns, materials, sections, [1, 1]).unwrap();
            let repeat = cloth.repeat().unwrap();
            let copies = u64::from(repeat.copies[0]) * u64::from(repeat.copies[1]);
            let points = repeat.piece.yarns.points().len() as u64 * copies;
            let share = laps as f64 / points as f64;
            assert!((0.8..1.2).contains(&share), "{laps} for {points}");
        }
    }
}
