//! What a yarn does at each needle that it comes to, also at those that it passes without being
//! told.

use std::ops::Range;

use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::layers::{Layers, STEP};
use super::{Bed, Direction, Step, Stitches};

/// What a yarn does at a needle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// The loop's number; none for a float.
    pub(super) number: Option<u32>,
    /// In wales, and in courses that may go on beyond the repeat.
    pub(super) at: f32,
    pub(super) course: i64,
    pub(super) bed: Bed,
    /// 1 to the right, -1 to the left.
    pub(super) direction: f64,
    /// How far up it lies in its course, of the room that there is: -0.5 to 0.5.
    pub(super) lift: f64,
    /// How many times a yarn's width that room is.
    pub(super) sharing: f64,
    /// Which of several yarns in the same stitches it is.
    pub(super) plate: u16,
    pub(super) source: u32,
    /// Whether it is no more than half a wale from a neighbour, and has only that much room.
    pub(super) short: bool,
}

/// Cells nearer than so many wales are of needles that lie half a needle apart.
const SHORT: f32 = 0.75;

/// What a yarn does from its beginning to its end, or in one round; and how many wales and courses
/// further it then goes on.
///
/// **Errors**: [`OutOfMemory`].
pub(super) fn cells(
    stitches: &Stitches,
    layers: &Layers,
    strand: usize,
) -> Result<(Vec<Cell>, Option<[i64; 2]>), OutOfMemory> {
    let steps = stitches.strands[strand].steps.iter().enumerate();
    let told = steps.map(|(index, step)| told(stitches, layers, [strand, index], step));
    let onward = match (stitches.strands[strand].onward, stitches.repeat) {
        (Some(repeats), Some(size)) => {
            Some([0, 1].map(|axis| i64::from(repeats[axis]) * i64::from(size[axis])))
        }
        _ => None,
    };
    let mut cells: Vec<Cell> = Vec::new();
    for cell in told {
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

/// A step as a cell. `at` are its strand and its number in that.
fn told(stitches: &Stitches, layers: &Layers, at: [usize; 2], step: &Step) -> Cell {
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

/// Adds a float at each needle that a yarn passes from `one` to `other`.
///
/// Where the other lies further out in the direction in which the yarn came, it floats on to there
/// and turns; where it lies further back, it turns at once and floats back.
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

/// The steps of a needle each after which a yarn floats on a way in the direction in which it came,
/// or against it; and whether the next loop is made in the other direction.
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
