//! The squares of a stitch chart.

use texere_fabric::weft::{Bed, Fate, LoopKind, Step, Stitch, Stitches};

/// The symbol of a square, seen from the technical face. The letters are those of charts in design
/// files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Symbol {
    /// The loop is drawn to the face: `k`.
    Knit,
    /// The loop is drawn to the back: `p`.
    Purl,
    /// Both needles of the wale knit: `b`.
    Both,
    /// Knitted on an empty front needle, in a repeat or above the first course. It is a knitter's
    /// yarn over: `k`.
    YarnOver,
    /// The yarn is laid on a front needle: `t`.
    Tuck,
    /// The yarn is laid on a back needle: `u`.
    BackTuck,
    /// The yarn floats past: `m`.
    Miss,
    /// Knitted, and the head of the loop goes to another wale: `>` to the right, `<` to the left. A
    /// head that crosses others is `R` (to the right, in front), `l` (to the right, behind), `L`
    /// (to the left, in front) or `r` (to the left, behind).
    Moved {
        /// Whether the head goes to the right. If not, it goes to the left.
        right: bool,
        /// Whether the head goes behind the stitches that it crosses. None if it crosses none.
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

/// A square: its symbol, and the carrier whose yarn it shows. None if no yarn comes to it.
pub(super) type Square = Option<(Symbol, u32)>;

/// A stitch chart: squares by wale and course.
#[derive(Debug)]
pub(super) struct Grid {
    /// Number of wales and courses.
    pub(super) size: [usize; 2],
    /// The squares, course by course from the first.
    squares: Vec<Square>,
}

/// A limit to the search for loop heads that cross, in wales. A head is compared only with heads
/// less than twice this many wales away.
const CROSSING_MAX: i64 = 32;

/// Number of wales and courses of a chart, and its leftmost wale.
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
    /// The chart of `stitches`. The caller has checked the size of the chart.
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
        // If yarns share a square, the loop on the face is shown. If yarns are plated, the first
        // one is shown.
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
        // A yarn of a repeat may float on into the next repeat.
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

    /// The square in a column and in a row counted from the top, as it is seen from the face or
    /// from the back.
    pub(super) fn square(&self, column: usize, row: usize, back: bool) -> Square {
        let [wales, courses] = self.size;
        let column = if back { wales - 1 - column } else { column };
        let square = self.squares[(courses - 1 - row) * wales + column];
        if back { square.map(|(symbol, carrier)| (symbol.turned(), carrier)) } else { square }
    }
}

/// How many wales to the right the head of a loop has gone. It is 0 for a head that has gone to the
/// other bed.
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
