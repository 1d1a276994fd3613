//! Keys that the tables `[knit]` and `[warp_knit]` of a design file share.

use texere_fabric::weft::{Cells, Gauge};

use super::super::WriteError;
use super::format::DESIGN_FILE as FORMAT;
use super::text::{DIGITS, nearest, shortest, within};
use crate::read::limits;

/// The most digits of a number that is taken for one that a designer has chosen.
const FEW: usize = 6;

/// The most needles to the inch that are tried together with a draw-in.
const NEEDLES_TRIED: u32 = 100;

/// The keys for the distances of wales and courses. Wales are counted by the cm, or by the inch if
/// only the number to the inch has few digits. If both numbers have many digits, wales are counted
/// by the inch only if the number to the cm is not read again to the bit.
pub(super) fn gauge(
    table: &str,
    gauge: &Gauge,
    left_out: &mut Vec<String>,
) -> Result<Vec<String>, WriteError> {
    let Gauge { wale_mm, course_mm, .. } = *gauge;
    let mut inexact = |key: &str| {
        left_out.push(format!(
            "{table}.{key}: no number is read as the very distance, and the last digit differs"
        ));
    };
    let wales = match wales(wale_mm, FEW).or_else(|| wales(wale_mm, DIGITS)) {
        Some(wales) => wales,
        None => match draw_in(wale_mm).filter(|_| table == "warp_knit") {
            Some(wales) => wales,
            None => {
                inexact("wales_per_cm");
                let field = || format!("{table}.wales_per_cm");
                format!("wales_per_cm = {:?}", within(FORMAT, field, 10.0 / wale_mm, limits::PER_CM)?)
            }
        },
    };
    let (courses, is_exact) = nearest(10.0 / course_mm, |read| 10.0 / read == course_mm);
    if !is_exact {
        inexact("courses_per_cm");
    }
    within(FORMAT, || format!("{table}.courses_per_cm"), courses, limits::PER_CM)?;
    Ok(vec![wales, format!("courses_per_cm = {courses:?}")])
}

/// The key for a distance of wales, with a number of at most `digits` digits.
fn wales(wale_mm: f64, digits: usize) -> Option<String> {
    let keys = [("wales_per_cm", 10.0, limits::PER_CM), ("needles_per_inch", 25.4, limits::PER_INCH)];
    keys.into_iter().find_map(|(key, mm, [low, high])| {
        let per = shortest(mm / wale_mm, digits, |read| mm / read == wale_mm)?;
        (low..=high).contains(&per).then(|| format!("{key} = {per:?}"))
    })
}

/// Needles to the inch and a draw-in that together give a distance of wales that no number of wales
/// to the cm gives.
fn draw_in(wale_mm: f64) -> Option<String> {
    (1..=NEEDLES_TRIED).map(f64::from).find_map(|needles| {
        let share = shortest(wale_mm * needles / 25.4, DIGITS, |read| 25.4 / needles * read == wale_mm)?;
        let [low, high] = limits::DRAW_IN;
        (low..=high).contains(&share).then(|| format!("needles_per_inch = {needles:?}\ndraw_in = {share:?}"))
    })
}

/// The key for the copies of a repeat, or none for a single copy.
pub(super) fn repeat(table: &str, copies: [u32; 2]) -> Result<Option<String>, WriteError> {
    let [across, along] = copies;
    for copies in copies {
        let most = limits::COPIES_MAX as f64;
        within(FORMAT, || format!("{table}.repeat"), copies.into(), [1.0, most])?;
    }
    Ok((copies != [1, 1]).then(|| format!("repeat = [{across}, {along}]")))
}

/// The key for the number of control points of a stitch, unless it is the usual one.
pub(super) fn cells(cells: Cells) -> Option<String> {
    (cells == Cells::Even).then(|| "cells = \"even\"".into())
}
