//! The path of a yarn: loop after loop, with the arcs, turns and floats between loops.
//!
//! ```text
//! for each needle that the yarn comes to (cells.rs):
//!     join   the arc from the needle before; a turn where the carriage has reversed
//!     cell   the loop on the needle (form.rs), or a float behind it
//! ```
//!
//! A yarn that ends in the cloth also has a beginning before the first needle, and an end after the
//! last one. The points of a loop come from [`Form::points`]. [`Cloth::form`] gives the loop its
//! place.

use glam::DVec3;
use texere_core::OutOfMemory;

use super::cells::{Cell, cells};
use super::form::{Form, side};
use super::layers::{Behind, Layers};
use super::pen::{Pen, YarnPoints};
use super::shape::{ARC, Shape};
use super::{Cells, Fate, Stitches};

/// Distance between yarns that share a course where they cross, in diameters, if the course has
/// enough room. At this distance they just touch. With twice the value,
/// `interlock_is_twice_as_thick_as_jersey` is red; with half, no test is.
const CROSSING: f64 = 1.0;

/// Share of a course's height that yarns which share the course may take. By eye. With half the
/// value, and with twice, no test is red.
const ROOM: f64 = 0.75;

/// Distance by which the end of a yarn goes behind loops that hang beside it, in diameters. By eye.
/// With half the value, and with twice, no test is red.
const END_BEHIND: f64 = 1.3;

/// Distance by which a yarn goes out beyond its arc where it turns, in wales. By eye. With half the
/// value, and with twice, no test is red.
const TURN: f64 = 0.3;
/// Distance by which the yarn of each carrier goes out further than that of the carrier before, in
/// diameters, so that turns of several yarns lie beside one another. By eye. With half the value,
/// and with twice, no test is red.
const NEXT_TURN: f64 = 1.1;

/// A cloth whose yarns are to be laid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cloth<'a> {
    pub(super) stitches: &'a Stitches,
    pub(super) layers: &'a Layers,
    pub(super) shape: &'a Shape,
    /// Place of the needle at the cloth's left edge, in wales.
    pub(super) left: f32,
    pub(super) kind: Cells,
}

impl Cloth<'_> {
    /// Lays a yarn. A yarn that goes on in the next repeat is laid for one round.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn lay(&self, strand: usize) -> Result<YarnPoints, OutOfMemory> {
        let (cells, onward) = cells(self.stitches, self.layers, strand)?;
        let (Some(first), Some(last)) = (cells.first(), cells.last()) else {
            return Ok(YarnPoints::default());
        };
        let mut pen = Pen::default();
        match onward {
            Some([right, up]) => {
                pen.cell(first.source);
                let before = Cell { at: last.at - right as f32, course: last.course - up, ..*last };
                self.join(&mut pen, strand, &before, first)?;
            }
            None => self.begin(&mut pen, first)?,
        }
        self.cell(&mut pen, first)?;
        for pair in cells.windows(2) {
            pen.cell(pair[1].source);
            self.join(&mut pen, strand, &pair[0], &pair[1])?;
            self.cell(&mut pen, &pair[1])?;
        }
        if onward.is_none() {
            self.end(&mut pen, last)?;
        }
        let onward = onward.map(|[right, up]| {
            DVec3::new(right as f64 * self.shape.wale, up as f64 * self.shape.course, 0.0)
        });
        match self.kind {
            Cells::Round => Ok(pen.into_points()),
            Cells::Even => pen.even(onward),
        }
    }

    /// x of the middle of a needle's wale, mm.
    fn x(&self, at: f32) -> f64 {
        (f64::from(at - self.left) + 0.5) * self.shape.wale
    }

    /// y of the arcs on both sides of a cell, mm.
    fn y(&self, cell: &Cell) -> f64 {
        let room = (CROSSING * self.shape.diameter * cell.sharing).min(ROOM * self.shape.course);
        cell.course as f64 * self.shape.course + cell.lift * room
    }

    /// z of the arcs on both sides of a cell, mm.
    fn z(&self, cell: &Cell) -> f64 {
        if let Some(number) = cell.number {
            return self.form(cell, number).arc_z();
        }
        let Shape { depth, diameter, .. } = *self.shape;
        let plate = f64::from(cell.plate) * diameter;
        match self.layers.behind(cell.course, cell.at, cell.bed) {
            Behind::Between => -side(cell.bed) * plate,
            Behind::One { bed, made } => {
                let loops = if made { diameter } else { 0.0 };
                -side(bed) * (ARC.z.abs() * depth + loops + plate)
            }
        }
    }

    /// The form of the loop that a yarn makes at a cell. The needle gives x, and the course and the
    /// lift give y.
    fn form(&self, cell: &Cell, number: u32) -> Form<'_> {
        let y = cell.course as f64 * self.shape.course;
        let at = [self.x(cell.at), y, self.y(cell) - y];
        Form::new(self.shape, self.stitches, self.layers, number, at)
    }

    /// Lays the loop or the float that a yarn makes at a needle.
    fn cell(&self, pen: &mut Pen, cell: &Cell) -> Result<(), OutOfMemory> {
        match cell.number {
            Some(number) => {
                let (points, head) = self.form(cell, number).points(cell.direction);
                let on_needle = self.stitches.loops[number as usize].fate == Fate::OnNeedle;
                pen.room(points.len())?;
                for (index, point) in points.into_iter().enumerate() {
                    pen.point(point);
                    if on_needle && index == head {
                        pen.pin();
                    }
                }
            }
            None => {
                pen.room(2)?;
                let ways: &[f64] = if cell.short { &[0.0] } else { &[-1.0, 1.0] };
                for across in ways {
                    let x = self.x(cell.at) + across * cell.direction * self.shape.wale / 6.0;
                    pen.point(DVec3::new(x, self.y(cell), self.z(cell)));
                }
            }
        }
        Ok(())
    }

    /// Lays the yarn between two needles.
    fn join(&self, pen: &mut Pen, strand: usize, one: &Cell, other: &Cell) -> Result<(), OutOfMemory> {
        if one.direction != other.direction {
            return self.turn(pen, strand, one, other);
        }
        let x = f64::midpoint(self.x(one.at), self.x(other.at));
        let y = f64::midpoint(self.y(one), self.y(other));
        let [from, to] = [self.z(one), self.z(other)];
        // Plated yarns change places on their way from bed to bed. The yarn in front passes above.
        let below = if from * to < 0.0 { f64::from(one.plate) * self.shape.diameter } else { 0.0 };
        pen.room(1)?;
        pen.point(DVec3::new(x, y - below, between(from, to)));
        if self.is_first(one) && self.is_first(other) {
            pen.pin();
        }
        Ok(())
    }

    /// Whether a cell is a loop of the first course that is drawn through nothing.
    fn is_first(&self, cell: &Cell) -> bool {
        let stitch = cell.number.map(|number| &self.stitches.loops[number as usize]);
        self.stitches.repeat.is_none()
            && cell.course == 0
            && stitch.is_some_and(|stitch| stitch.parents.is_empty())
    }

    /// Lays the turn of a yarn beside the outer of two needles.
    fn turn(&self, pen: &mut Pen, strand: usize, one: &Cell, other: &Cell) -> Result<(), OutOfMemory> {
        let Shape { wale, course, diameter, .. } = *self.shape;
        let outwards = one.direction;
        let outer = f64::max(outwards * self.x(one.at), outwards * self.x(other.at)) + 0.5 * wale;
        let carrier = f64::from(self.stitches.strands[strand].carrier);
        let out = outwards * (outer + TURN * wale + NEXT_TURN * carrier * diameter);
        let (mut from, mut to) = (self.y(one), self.y(other));
        if (to - from).abs() < diameter {
            // The yarn turns within one course, and lies beside itself.
            let middle = f64::midpoint(from, to);
            (from, to) = (middle - diameter / 2.0, middle + diameter / 2.0);
        }
        let [start, end] =
            [(from, one), (to, other)].map(|(y, cell)| DVec3::new(outwards * outer, y, self.z(cell)));
        let steps = ((to - from).abs() / course).round().max(1.0) as u32;
        pen.room(steps as usize + 2)?;
        pen.point(start);
        for step in 0..steps {
            let way = (f64::from(step) + 0.5) / f64::from(steps);
            pen.point(start.lerp(end, way).with_x(out));
        }
        pen.point(end);
        Ok(())
    }

    /// Lays the beginning of a yarn, and pins it.
    fn begin(&self, pen: &mut Pen, first: &Cell) -> Result<(), OutOfMemory> {
        pen.room(2)?;
        let [near, far] = self.loose(first, -first.direction);
        pen.source(first.source);
        pen.point(far);
        pen.pin();
        pen.cell(first.source);
        pen.point(near);
        pen.pin();
        Ok(())
    }

    /// Lays the end of a yarn, and pins it.
    fn end(&self, pen: &mut Pen, last: &Cell) -> Result<(), OutOfMemory> {
        pen.room(2)?;
        pen.tail();
        for point in self.loose(last, last.direction) {
            pen.point(point);
            pen.pin();
        }
        Ok(())
    }

    /// Points of a yarn's end, half a wale and a whole wale beside a cell, mm. The yarn runs level,
    /// or goes behind loops that hang on the needle beside the cell.
    fn loose(&self, cell: &Cell, outwards: f64) -> [DVec3; 2] {
        let beside = cell.at + outwards as f32;
        let behind =
            if self.layers.is_held(cell.course, beside) { END_BEHIND * self.shape.diameter } else { 0.0 };
        let z = self.z(cell);
        let back = if z > 0.0 { 1.0 } else { -1.0 };
        [0.5, 1.0].map(|way| {
            let x = self.x(cell.at) + way * outwards * self.shape.wale;
            DVec3::new(x, self.y(cell), z + way * back * behind)
        })
    }
}

/// z of the arc between two loops, mm: the z of the loop that lies further from the middle, or half
/// way between two loops on opposite sides.
fn between(one: f64, other: f64) -> f64 {
    if one * other <= 0.0 {
        f64::midpoint(one, other)
    } else if one.abs() > other.abs() {
        one
    } else {
        other
    }
}
