//! The squares of a stitch chart.

use texere_fabric::weft::{Bed, Fate, LoopKind, Step, Stitch, Stitches};

/// The symbol of a square, seen from the technical face. The letters are those of charts in design
/// files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Symbol {
    /// Drawn to the face: `k`.
    Knit,
    /// Drawn to the back: `p`.
    Purl,
    /// Both needles of the wale knit: `b`.
    Both,
    /// Knitted on an empty needle above the first course: a knitter's yarn over. `k`
    YarnOver,
    /// Laid on a front needle: `t`.
    Tuck,
    /// Laid on a back needle: `u`.
    BackTuck,
    /// The yarn floats past: `m`.
    Miss,
    /// Knitted, and its head goes to another wale: `>` and `<`. Where it crosses others: `R` to the
    /// right in front, and `r` to the left behind; `L` to the left in front, and `l` to the right
    /// behind.
    Moved {
        /// To the right, not to the left.
        right: bool,
        /// Whether it goes behind the stitches that it crosses. None where it crosses none.
        behind: Option<bool>,
    },
}

impl Symbol {
    /// The letter of the symbol in charts of design files.
    pub(super) const fn letter(self) -> char {
        match self {
            Self::Knit | Self::YarnOver => 'k',
            Self::Purl => 'p',
            Self::Both => 'b',
            Self::Tuck => 't',
            Self::BackTuck => 'u',
            Self::Miss => 'm',
            Self::Moved { right: true, behind: None } => '>',
            Self::Moved { right: false, behind: None } => '<',
            Self::Moved { right: true, behind: Some(false) } => 'R',
            Self::Moved { right: true, behind: Some(true) } => 'l',
            Self::Moved { right: false, behind: Some(false) } => 'L',
            Self::Moved { right: false, behind: Some(true) } => 'r',
        }
    }

    /// The symbol of the stitch seen from the other side.
    const fn turned(self) -> Self {
        match self {
            Self::Knit => Self::Purl,
            Self::Purl => Self::Knit,
            Self::Tuck => Self::BackTuck,
            Self::BackTuck => Self::Tuck,
            Self::Moved { right, behind: Some(behind) } => {
                Self::Moved { right: !right, behind: Some(!behind) }
            }
            Self::Moved { right, behind } => Self::Moved { right: !right, behind },
            same => same,
        }
    }
}

/// A square: what it shows, and the carrier that makes it.
pub(super) type Square = Option<(Symbol, u32)>;

/// A stitch chart: squares by wale and course.
#[derive(Debug)]
pub(super) struct Grid {
    /// Wales and courses.
    pub(super) size: [usize; 2],
    /// Course by course, from the first.
    squares: Vec<Square>,
}

/// The furthest that a head is looked for crossing others, in wales.
const CROSSING_MAX: i64 = 32;

/// Wales and courses of a chart, and its leftmost wale.
pub(super) fn extent(stitches: &Stitches) -> ([usize; 2], i64) {
    if let Some(repeat) = stitches.repeat {
        return (repeat.map(|side| side as usize), 0);
    }
    let steps = stitches.strands.iter().flat_map(|strand| &strand.steps).map(|step| stitches.visit(step));
    let all = stitches.loops.iter().map(|stitch| (stitch.at, stitch.course));
    let all = all.chain(steps.map(|visit| (visit.at, visit.course)));
    let (mut left, mut right, mut top) = (i64::MAX, i64::MIN, 0);
    for (at, course) in all {
        let wale = at.floor() as i64;
        (left, right, top) = (left.min(wale), right.max(wale), top.max(course));
    }
    if left > right { ([0, 0], 0) } else { ([(right - left + 1) as usize, top as usize + 1], left) }
}

impl Grid {
    /// The chart of stitches. The caller knows its size.
    pub(super) fn new(stitches: &Stitches) -> Self {
        let (size, left) = extent(stitches);
        let mut grid = Self { size, squares: vec![None; size[0] * size[1]] };
        let mut carriers = vec![0; stitches.loops.len()];
        for strand in &stitches.strands {
            for step in &strand.steps {
                match *step {
                    Step::Loop { number, .. } => carriers[number as usize] = strand.carrier,
                    Step::Float { at, course, .. } => {
                        let place = grid.place(at, course, left);
                        grid.squares[place].get_or_insert((Symbol::Miss, strand.carrier));
                    }
                }
            }
        }
        // Where yarns share a square, the loop on the face shows; where yarns are plated, the first
        // one does.
        for (stitch, &carrier) in stitches.loops.iter().zip(&carriers).rev() {
            let place = grid.place(stitch.at, stitch.course, left);
            let own = symbol(stitch, stitches.repeat.is_some());
            let square = &mut grid.squares[place];
            *square = match *square {
                Some((Symbol::Knit, other)) if own == Symbol::Purl => Some((Symbol::Both, other)),
                Some((Symbol::Purl | Symbol::Both, _)) if own == Symbol::Knit => {
                    Some((Symbol::Both, carrier))
                }
                Some((shown, other)) if shown != Symbol::Miss && stitch.bed == Bed::Back => {
                    Some((shown, other))
                }
                _ => Some((own, carrier)),
            };
        }
        grid.cross(stitches, left);
        grid
    }

    fn place(&self, at: f32, course: u32, left: i64) -> usize {
        let wale = (at.floor() as i64 - left).rem_euclid(self.size[0] as i64);
        // In a repeat, a yarn may float on into the next one.
        course as usize % self.size[1] * self.size[0] + wale as usize
    }

    /// Notes which moved loops cross others, and which of them go behind.
    fn cross(&mut self, stitches: &Stitches, left: i64) {
        let mut moved = vec![None; self.squares.len()];
        let mut furthest = 0;
        for stitch in stitches.loops.iter().filter(|stitch| by(stitch) != 0) {
            moved[self.place(stitch.at, stitch.course, left)] = Some((by(stitch), stitch.head.moved));
            furthest = furthest.max(by(stitch).abs()).min(CROSSING_MAX);
        }
        let wales = self.size[0];
        for place in (0..moved.len()).filter(|_| furthest > 0) {
            let Some((own, time)) = moved[place] else { continue };
            let (row, column) = (place / wales * wales, (place % wales) as i64);
            let crossed = (1..own.abs().min(CROSSING_MAX) + furthest).find_map(|away| {
                let other = (column + away * own.signum()).rem_euclid(wales as i64);
                let (by, other_time) = moved[row + other as usize]?;
                let crosses = by * own < 0 && away < own.abs() + i64::abs(by);
                crosses.then_some(other_time < time)
            });
            if let (Some(behind), Some((Symbol::Moved { behind: own, .. }, _))) =
                (crossed, &mut self.squares[place])
            {
                *own = Some(behind);
            }
        }
    }

    /// A square, by column and by row from the top, seen from a side.
    pub(super) fn square(&self, column: usize, row: usize, back: bool) -> Square {
        let [wales, courses] = self.size;
        let column = if back { wales - 1 - column } else { column };
        let square = self.squares[(courses - 1 - row) * wales + column];
        if back { square.map(|(symbol, carrier)| (symbol.turned(), carrier)) } else { square }
    }
}

/// How many wales to the right the head of a loop has gone.
fn by(stitch: &Stitch) -> i64 {
    if stitch.head.bed == stitch.bed { f64::from(stitch.head.at - stitch.at).round() as i64 } else { 0 }
}

fn symbol(stitch: &Stitch, repeats: bool) -> Symbol {
    let by = by(stitch);
    match (stitch.kind, stitch.bed) {
        (LoopKind::Tuck, Bed::Front) => Symbol::Tuck,
        (LoopKind::Tuck, Bed::Back) => Symbol::BackTuck,
        _ if by != 0 && stitch.fate != Fate::Dropped => Symbol::Moved { right: by > 0, behind: None },
        (_, Bed::Front) if stitch.parents.is_empty() && (repeats || stitch.course > 0) => Symbol::YarnOver,
        (_, Bed::Front) => Symbol::Knit,
        (_, Bed::Back) => Symbol::Purl,
    }
}
