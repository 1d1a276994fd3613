//! The needles that a yarn comes to: the needles of its program, and the needles that it floats
//! past on its way between them.

use std::ops::Range;

use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::layers::{Layers, STEP};
use super::{Bed, Direction, Step, Stitches};

/// What a yarn does at a needle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// Number of the loop that the yarn makes; none for a float.
    pub(super) number: Option<u32>,
    /// Place of the needle, in wales. The place and the course may lie beyond the repeat.
    pub(super) at: f32,
    pub(super) course: i64,
    pub(super) bed: Bed,
    /// Direction of the carriage: 1 to the right, -1 to the left.
    pub(super) direction: f64,
    /// Height of the yarn among the yarns that share its course, from -0.5 for the lowest to 0.5
    /// for the highest.
    pub(super) lift: f64,
    /// Height of the room that the yarns of the course share, in yarn diameters.
    pub(super) sharing: f64,
    /// Number of the yarn in a plated stitch: 0 lies in front.
    pub(super) plate: u16,
    pub(super) source: u32,
    /// Whether the cell before or after this one is at most half a wale away. A float then has one
    /// point instead of two.
    pub(super) short: bool,
}

/// Distance in wales below which the needles of two cells count as at most half a wale apart. It is
/// half way between half a wale and a whole one.
const SHORT: f32 = 0.75;

/// The cells of a yarn from its beginning to its end, or the cells of one round of a yarn that goes
/// on. Also returns the wales and courses by which the next round lies further; none for a yarn
/// that ends.
///
/// **Errors**: [`OutOfMemory`].
pub(super) fn cells(
    stitches: &Stitches,
    layers: &Layers,
    strand: usize,
) -> Result<(Vec<Cell>, Option<[i64; 2]>), OutOfMemory> {
    let steps = stitches.strands[strand].steps.iter().enumerate();
    let made = steps.map(|(index, step)| cell_of(stitches, layers, [strand, index], step));
    let onward = match (stitches.strands[strand].onward, stitches.repeat) {
        (Some(repeats), Some(size)) => {
            Some([0, 1].map(|axis| i64::from(repeats[axis]) * i64::from(size[axis])))
        }
        _ => None,
    };
    let mut cells: Vec<Cell> = Vec::new();
    for cell in made {
        if let Some(last) = cells.last().copied() {
            pass(&mut cells, &last, &cell)?;
        }
        room_for(&mut cells, 1, "needles that a yarn comes to")?;
        cells.push(cell);
    }
    if let (Some([right, up]), Some(first), Some(last)) =
        (onward, cells.first().copied(), cells.last().copied())
    {
        let next = Cell { at: first.at + right as f32, course: first.course + up, ..first };
        pass(&mut cells, &last, &next)?;
    }
    for index in 0..cells.len() {
        let near =
            |other: Option<&Cell>| other.is_some_and(|other| (other.at - cells[index].at).abs() < SHORT);
        let before = index.checked_sub(1).and_then(|before| cells.get(before));
        cells[index].short = near(before) || near(cells.get(index + 1));
    }
    Ok((cells, onward))
}

/// A step of the program as a cell. `at` is the number of the step's strand, and the number of the
/// step in the strand.
fn cell_of(stitches: &Stitches, layers: &Layers, at: [usize; 2], step: &Step) -> Cell {
    let (rank, visit) = (layers.rank(at), stitches.visit(step));
    Cell {
        number: visit.number,
        at: visit.at,
        course: i64::from(visit.course),
        bed: visit.bed,
        direction: if visit.direction == Direction::Right { 1.0 } else { -1.0 },
        lift: rank.lift,
        sharing: rank.sharing,
        plate: rank.plate,
        source: visit.source,
        short: false,
    }
}

/// Adds a float at each needle that a yarn passes on its way from `one` to `other`.
///
/// If `other` lies ahead of the carriage, the yarn floats on to it, and turns there if it has to.
/// If `other` lies behind the carriage, the yarn turns at once and floats back.
fn pass(cells: &mut Vec<Cell>, one: &Cell, other: &Cell) -> Result<(), OutOfMemory> {
    let way = f64::from(other.at - one.at) * one.direction;
    let turns = one.direction != other.direction;
    let (passed, gap, on) = (passed_on_way(way, turns), way.abs().round() as u32, way > 0.0);
    let direction = if on { one.direction } else { -one.direction };
    let like = if on && turns { one } else { other };
    room_for(cells, passed.len(), "needles that a yarn comes to")?;
    for step in passed {
        let at = one.at + (f64::from(step) / f64::from(gap) * way * one.direction) as f32;
        cells.push(Cell { number: None, at, direction, bed: one.bed, ..*like });
    }
    Ok(())
}

/// The needles at which a yarn floats on its way from one cell to the next, counted from the first:
/// 0 is the needle of the first cell itself.
///
/// `way` is the distance to the next cell in wales, positive in the direction in which the carriage
/// came. `turns` says whether the next cell is made in the other direction.
///
/// - The next cell lies ahead, in the same direction: the yarn floats past the needles between.
/// - The next cell lies ahead, in the other direction: the yarn also floats past the needle of the
///   next cell, turns, and comes back to that needle.
/// - The next cell lies behind: the yarn turns at once, and floats past the needle of the first
///   cell and the needles between.
///
/// There is no float if both cells are on one needle, or on neighbouring needles in the same
/// direction.
pub(super) fn passed_on_way(way: f64, turns: bool) -> Range<u32> {
    let gap = way.abs().round() as u32;
    if !turns && way.abs() <= f64::from(STEP) || gap == 0 {
        return 0..0;
    }
    match (turns, way > 0.0) {
        (false, true) => 1..gap,
        (true, true) => 1..gap + 1,
        (true, false) | (false, false) => 0..gap,
    }
}
