//! Weft knits from the caller's arrays: a chart of stitches, the gauge and the yarns.

use std::ffi::c_char;

use texere::weft::{Backing, Beds, Cell, Cells, Chart, ChartError, Gauge, Knitted, Machine};
use texere::{Design, FabricError, Structure};

use crate::argument::text;
use crate::design::texere_design;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{clear, give};
use crate::material::{array, texere_looks};
use crate::sized::{grows_after, sized};
use crate::status::texere_status;
use crate::structure::{choice, refused, texere_knit_yarn};

/// The front needle knits.
pub const TEXERE_STITCH_KNIT: u32 = 0;
/// The back needle knits.
pub const TEXERE_STITCH_PURL: u32 = 1;
/// Front and back needle both knit. This needs two beds.
pub const TEXERE_STITCH_BOTH: u32 = 2;
/// The needle takes the yarn and keeps its loops. On two beds it is the front needle.
pub const TEXERE_STITCH_TUCK: u32 = 3;
/// The back needle takes the yarn and keeps its loops. This needs two beds.
pub const TEXERE_STITCH_BACK_TUCK: u32 = 4;
/// The yarn floats past.
pub const TEXERE_STITCH_MISS: u32 = 5;
/// The front needle knits, and its loop then moves by `moved` needles, in front of other loops that
/// move.
pub const TEXERE_STITCH_MOVED: u32 = 6;
/// The front needle knits, and its loop then moves by `moved` needles, behind other loops that
/// move.
pub const TEXERE_STITCH_MOVED_BEHIND: u32 = 7;

/// The back of a Jacquard shows floats: only the front needles knit.
pub const TEXERE_BACKING_NONE: u32 = 0;
/// Every other back needle knits, alternating from yarn to yarn and from row to row.
pub const TEXERE_BACKING_BIRDSEYE: u32 = 1;
/// Each of the n yarns of a row knits on every n-th back needle, and on the same needles in all
/// rows that have the same yarns.
pub const TEXERE_BACKING_LADDER: u32 = 2;

/// The stitch in one wale of one course.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_stitch {
    /// A constant whose name begins with TEXERE_STITCH.
    pub kind: u32,
    /// By how many needles the loop moves, -256 to 256: positive to the right, negative to the
    /// left. Only the two kinds that begin with TEXERE_STITCH_MOVED read it.
    pub moved: i32,
}

/// A weft knit as the caller's arrays: one repeat of stitches, and its copies.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_weft_knit {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Beds of needles, 1 or 2. With `jacquard` it has to be 0: a Jacquard with a backing is
    /// knitted on two beds, one without on one bed.
    pub beds: u32,
    /// A constant whose name begins with TEXERE_CELLS.
    pub cells: u32,
    /// How many copies of the repeat lie along the courses, and how many along the wales; each 1 or
    /// more.
    pub copies: [u32; 2],
    /// With `jacquard`: what the back needles knit, a constant whose name begins with
    /// TEXERE_BACKING. Else 0.
    pub backing: u32,
    /// What the design is called, UTF-8.
    pub name: *const c_char,
    /// Length of the name, bytes.
    pub name_length: usize,
    /// Wales of the repeat, 1 to 65536.
    pub wales: u64,
    /// Courses of the repeat, or rows of the picture in `jacquard`: 1 to 65536.
    pub courses: u64,
    /// The stitches, `wales` times `courses` of them: course after course from the first, which is
    /// the bottom one, and in each course from left to right as seen from the technical face. Null
    /// with `jacquard`.
    pub stitches: *const texere_stitch,
    /// The yarns that the courses take in turn, from the first course on: numbers in `yarns`,
    /// counted from 0. After the last one the first one follows again. Null with a `turn_count` of
    /// 0: all courses take yarn 0, or with `jacquard` the yarns of the picture. If `courses` is not
    /// a multiple of `turn_count`, the chart is repeated upwards until the number of its courses is
    /// such a multiple.
    pub turn: *const u32,
    /// How many numbers `turn` has.
    pub turn_count: u64,
    /// The yarns.
    pub yarns: *const texere_knit_yarn,
    /// How many yarns.
    pub yarn_count: u64,
    /// Distance from one wale to the next, mm.
    pub wale_mm: f64,
    /// Distance from one course to the next, mm.
    pub course_mm: f64,
    /// The mean length of yarn in a loop that settling aims for, mm. 0: loops take the length that
    /// they need.
    pub loop_length_mm: f64,
    /// The materials and sections that the yarns refer to.
    pub looks: texere_looks,
    /// A Jacquard picture: for each cell the number of its yarn in `yarns`, counted from 0. There
    /// are `wales` times `courses` cells, row after row from the bottom, and in each row from left
    /// to right. Null for a knit that `stitches` gives. A row becomes one course for each of its
    /// yarns, in the order of their numbers. The front needles knit the course's yarn where the
    /// picture has that yarn. The yarn floats past the other front needles.
    pub jacquard: *const u32,
}

grows_after!(texere_weft_knit, looks);

impl texere_stitch {
    fn read(self, number: usize) -> Result<Cell, Failure> {
        let moved = |behind| Cell::Moved { by: self.moved, behind };
        let cells = [
            Cell::Knit,
            Cell::Purl,
            Cell::Both,
            Cell::Tuck,
            Cell::BackTuck,
            Cell::Miss,
            moved(false),
            moved(true),
        ];
        choice(&format!("knit.stitches[{number}].kind"), self.kind, &cells)
    }
}

impl texere_weft_knit {
    /// # Safety
    ///
    /// Arrays and texts are valid for reads.
    unsafe fn read(&self) -> Result<Design, Failure> {
        // SAFETY: the caller vouches for all of them.
        let (chart, yarns, (materials, sections), name) = unsafe {
            (
                if self.jacquard.is_null() { self.charted() } else { self.pictured() }?,
                array("knit.yarns", self.yarns, self.yarn_count)?,
                self.looks.read("knit")?,
                text("knit.name", self.name, self.name_length)?,
            )
        };
        let program = chart.program().map_err(|error| self.refused(error))?;
        let loop_length_mm = (self.loop_length_mm != 0.0).then_some(self.loop_length_mm);
        let gauge = Gauge { wale_mm: self.wale_mm, course_mm: self.course_mm, loop_length_mm };
        let yarns = yarns.iter().map(texere_knit_yarn::read).collect();
        let knit = Machine::default()
            .knit(&program)
            .and_then(|knit| Knitted::new(knit.stitches, gauge, yarns, materials, sections, self.copies));
        let knit = knit.map_err(|error| refused("knit", error, &[]))?;
        let cells = choice("knit.cells", self.cells, &[Cells::Round, Cells::Even])?;
        Ok(Design::of(name, Structure::Weft(knit.with_cells(cells))))
    }

    /// The chart of `stitches` and `turn`.
    ///
    /// # Safety
    ///
    /// The conditions of `read` hold.
    unsafe fn charted(&self) -> Result<Chart, Failure> {
        let Self { wales, courses, .. } = *self;
        if self.backing != TEXERE_BACKING_NONE {
            return Err(Failure::argument(format!(
                "knit.backing is {}, expected 0 without a knit.jacquard",
                self.backing
            )));
        }
        // SAFETY: the caller vouches for both.
        let (stitches, turn) = unsafe {
            (
                array("knit.stitches", self.stitches, wales.saturating_mul(courses))?,
                array("knit.turn", self.turn, self.turn_count)?,
            )
        };
        let beds = match self.beds {
            1 => Beds::One,
            2 => Beds::Two,
            other => return Err(Failure::argument(format!("knit.beds is {other}, expected 1 or 2"))),
        };
        self.known("knit.turn", turn)?;
        let cells = stitches.iter().enumerate().map(|(number, stitch)| stitch.read(number));
        let cells = cells.collect::<Result<Vec<_>, _>>()?;
        let chart = Chart::new(wales as usize, beds, cells).and_then(|chart| chart.with_yarns(turn));
        chart.map_err(|error| self.refused(error))
    }

    /// The chart of the picture `jacquard`.
    ///
    /// # Safety
    ///
    /// The conditions of `read` hold.
    unsafe fn pictured(&self) -> Result<Chart, Failure> {
        let Self { wales, courses, .. } = *self;
        if !self.stitches.is_null() || self.turn_count != 0 || self.beds != 0 {
            return Err(Failure::argument(
                "knit.jacquard is not null, so knit.stitches has to be null, knit.turn_count and knit.beds 0",
            ));
        }
        let backings = [None, Some(Backing::Birdseye), Some(Backing::Ladder)];
        let backing = choice("knit.backing", self.backing, &backings)?;
        // SAFETY: the caller vouches for it.
        let picture = unsafe { array("knit.jacquard", self.jacquard, wales.saturating_mul(courses)) }?;
        self.known("knit.jacquard", picture)?;
        let wales = wales as usize;
        let yarn = |wale: usize, row: usize| picture[row * wales + wale];
        let chart = Chart::jacquard(wales, courses as usize, backing, yarn);
        chart.map_err(|error| self.refused(error))
    }

    /// Refuses numbers that no yarn has. `name` is the name of the array that holds them.
    fn known(&self, name: &str, numbers: &[u32]) -> Result<(), Failure> {
        match numbers.iter().position(|yarn| u64::from(*yarn) >= self.yarn_count) {
            None => Ok(()),
            Some(at) => Err(Failure::argument(format!(
                "{name}[{at}] is {}, but there are {}, counted from 0",
                numbers[at], self.yarn_count
            ))),
        }
    }

    /// The failure of a chart, with the number of the stitch that the error is about, if it is
    /// about one.
    fn refused(&self, error: ChartError) -> Failure {
        let stitch = match error {
            ChartError::OutOfMemory(error) => return refused("knit", FabricError::OutOfMemory(error), &[]),
            // Rows of a chart count from the top.
            ChartError::Beds { row, column, .. } | ChartError::Moved { row, column, .. } => {
                let course = (self.courses as usize).saturating_sub(row);
                format!("[{}]", course * self.wales as usize + column.saturating_sub(1))
            }
            _ => String::new(),
        };
        let array = if self.jacquard.is_null() { "stitches" } else { "jacquard" };
        Failure::argument(format!("knit.{array}{stitch}: {error}"))
    }
}

/// Makes a design of a weft knit from the caller's arrays, which are copied. By default its yarns
/// come to rest; `texere_design_finished` makes a design with another finish.
///
/// Fails with TEXERE_ARGUMENT for arrays from which no knit can be made. The message names the
/// array, the element (counted from 0), the value and the limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_weft_knit(
    knit: *const texere_weft_knit,
    out: *mut *mut texere_design,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `knit`.
        unsafe {
            clear(out)?;
            give(out, sized("knit", knit)?.read()?)
        }
    })
}
