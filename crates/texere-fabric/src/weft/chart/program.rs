//! From a chart to a knitting program.

use texere_core::backend::{filled, room_for};

use super::{Beds, Cell, Chart, ChartError};
use crate::weft::{Bed, CarrierSet, Direction, Instruction, Needle, Operation, Program};

/// Rack with which front and back needles of one wale can both knit: back needles lie half way
/// between front needles.
const HALF: f64 = 0.5;

impl Chart {
    /// The program of one repeat of the chart. It has a carrier for each yarn number, from 0 to the
    /// largest that a course has. Each carrier goes to the right in its first course, to the left
    /// in its next one, and so on.
    ///
    /// The source of an operation is row × wales + column of its cell, both counted from 0, with
    /// row 0 at the bottom. In a Jacquard picture these are the row and the column of the pixel.
    ///
    /// **Errors**: [`ChartError::OutOfMemory`].
    pub fn program(&self) -> Result<Program, ChartError> {
        let carriers = self.courses.iter().map(|course| course.yarn).max().map_or(0, |most| most + 1);
        let mut knitter = Knitter {
            chart: self,
            beds: filled("wales of a chart", self.wales, Bed::Front)?,
            goes: filled("carriers", carriers as usize, Direction::Left)?,
            operations: Vec::new(),
        };
        // At the end of a round the loops of each wale hang on the bed of its last stitch. The next
        // round begins with these beds, and the first round has to begin in the same way.
        for course in 0..self.courses() {
            knitter.follow(course);
        }
        room_for(&mut knitter.operations, self.cells.len() + self.cells.len() / 4, "a knitting program")?;
        if self.cells.contains(&Cell::Both) {
            knitter.tell(Instruction::Rack(HALF), 0, 0);
        }
        for course in 0..self.courses() {
            knitter.knit(course)?;
        }
        Ok(Program {
            carriers: (1..=carriers).map(|number| number.to_string()).collect(),
            carrier_sets: std::iter::once(Vec::new())
                .chain((0..carriers).map(|carrier| vec![carrier]))
                .collect(),
            operations: knitter.operations,
            repeat: Some(self.wales as u32),
        })
    }
}

/// The state of knitting a chart.
struct Knitter<'a> {
    chart: &'a Chart,
    /// The bed on which the loops of each wale hang, if the chart has one bed.
    beds: Vec<Bed>,
    /// The last direction of each carrier.
    goes: Vec<Direction>,
    operations: Vec<Operation>,
}

impl Knitter<'_> {
    fn tell(&mut self, instruction: Instruction, set: u32, source: usize) {
        self.operations.push(Operation { instruction, carriers: CarrierSet(set), source: source as u32 });
    }

    /// Updates the bed on which the loops of each wale hang after a course.
    fn follow(&mut self, course: usize) {
        let cells = self.chart.course(course);
        for (bed, cell) in self.beds.iter_mut().zip(cells) {
            match cell {
                Cell::Knit | Cell::Moved { .. } => *bed = Bed::Front,
                Cell::Purl => *bed = Bed::Back,
                Cell::Both | Cell::Tuck | Cell::BackTuck | Cell::Miss => {}
            }
        }
        for (wale, cell) in cells.iter().enumerate() {
            if let Cell::Moved { by, .. } = *cell {
                let target = self.wale(wale as i32 + by);
                self.beds[target] = Bed::Front;
            }
        }
    }

    fn wale(&self, needle: i32) -> usize {
        needle.rem_euclid(self.chart.wales as i32) as usize
    }

    fn source(&self, course: usize, wale: usize) -> usize {
        self.chart.courses[course].row as usize * self.chart.wales + wale
    }

    fn knit(&mut self, course: usize) -> Result<(), ChartError> {
        let chart = self.chart;
        let cells = chart.course(course);
        // Each cell of a course takes at most eight operations: a change of beds, two stitches,
        // transfers and racks. The last rack comes once for the course.
        room_for(&mut self.operations, 8 * cells.len() + 1, "a knitting program")?;
        if chart.beds == Beds::One {
            self.change_beds(course, cells);
        }
        let yarn = chart.courses[course].yarn;
        let direction = match self.goes[yarn as usize] {
            Direction::Left => Direction::Right,
            Direction::Right => Direction::Left,
        };
        self.goes[yarn as usize] = direction;
        for step in 0..cells.len() {
            let wale = if direction == Direction::Right { step } else { cells.len() - 1 - step };
            self.stitch(course, wale, cells[wale], direction);
        }
        if cells.iter().any(|cell| matches!(cell, Cell::Moved { .. })) {
            self.move_loops(course, cells);
        }
        self.follow(course);
        Ok(())
    }

    /// Transfers loops to the bed on which their wale knits in this course.
    fn change_beds(&mut self, course: usize, cells: &[Cell]) {
        for (wale, cell) in cells.iter().enumerate() {
            let wanted = match cell {
                Cell::Knit | Cell::Moved { .. } => Bed::Front,
                Cell::Purl => Bed::Back,
                Cell::Both | Cell::Tuck | Cell::BackTuck | Cell::Miss => continue,
            };
            if self.beds[wale] != wanted {
                self.transfer(wale as i32, wanted.other(), wale as i32, self.source(course, wale));
                self.beds[wale] = wanted;
            }
        }
    }

    fn transfer(&mut self, from: i32, bed: Bed, to: i32, source: usize) {
        let needle = |bed, number| Needle { bed, slider: false, number };
        self.tell(Instruction::Transfer(needle(bed, from), needle(bed.other(), to)), 0, source);
    }

    fn stitch(&mut self, course: usize, wale: usize, cell: Cell, direction: Direction) {
        use Instruction::{Knit, Miss, Tuck};
        let (front, back) = (Needle::front(wale as i32), Needle::back(wale as i32));
        // With one bed, the needle on which the loops hang; with two, the front needle.
        let own = if self.beds[wale] == Bed::Back && self.chart.beds == Beds::One { back } else { front };
        let (set, source) = (self.chart.courses[course].yarn + 1, self.source(course, wale));
        match cell {
            Cell::Knit | Cell::Moved { .. } => self.tell(Knit(direction, front), set, source),
            Cell::Purl => self.tell(Knit(direction, back), set, source),
            Cell::Tuck => self.tell(Tuck(direction, own), set, source),
            Cell::BackTuck => self.tell(Tuck(direction, back), set, source),
            Cell::Miss => self.tell(Miss(direction, own), set, source),
            Cell::Both => {
                // The back needle lies to the right of the front one.
                let [first, then] = if direction == Direction::Right { [front, back] } else { [back, front] };
                self.tell(Knit(direction, first), set, source);
                self.tell(Knit(direction, then), set, source);
            }
        }
    }

    /// Moves loops to other needles by way of the back bed. The loops that are the first to come
    /// back from the back bed lie in front.
    fn move_loops(&mut self, course: usize, cells: &[Cell]) {
        let mut moves = Vec::new();
        for (wale, cell) in cells.iter().enumerate() {
            let Cell::Moved { by, behind } = *cell else { continue };
            moves.push((behind, by, wale));
            let target = self.wale(wale as i32 + by);
            let stays = !matches!(cells[target], Cell::Moved { .. });
            let bed = match cells[target] {
                Cell::Purl => Bed::Back,
                Cell::Knit | Cell::Moved { .. } => Bed::Front,
                Cell::Both | Cell::Tuck | Cell::BackTuck | Cell::Miss => self.beds[target],
            };
            if stays && bed == Bed::Back && self.beds[target] == Bed::Back {
                self.transfer(target as i32, Bed::Back, target as i32, self.source(course, target));
                self.beds[target] = Bed::Front;
            }
        }
        for &(_, _, wale) in &moves {
            self.transfer(wale as i32, Bed::Front, wale as i32, self.source(course, wale));
        }
        // Loops that lie in front are moved before loops that lie behind. In each group, moves to
        // the right come before moves to the left. If two loops of one group come to one needle,
        // the one from the left therefore comes first.
        moves.sort_by_key(|&(behind, by, wale)| (behind, -by, wale));
        let mut racked = 0;
        for (_, by, wale) in moves {
            let source = self.source(course, wale);
            if by != racked {
                self.tell(Instruction::Rack(by.into()), 0, source);
                racked = by;
            }
            self.transfer(wale as i32, Bed::Back, wale as i32 + by, source);
        }
        self.tell(Instruction::Rack(0.0), 0, self.source(course, 0));
    }
}
