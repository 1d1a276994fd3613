//! Warp knits from the caller's arrays: the laps, the threading and the Jacquard of each guide bar,
//! the gauge and the yarns.

use std::ffi::c_char;

use texere::warp::{
    Bar, CHAIN_COURSES, Chain, Displacements, Lap, NEEDLES_MOST, SPACE_MAX, Threading, WarpKnitted,
};
use texere::weft::{Cells, Gauge};
use texere::{Design, Structure};

use crate::argument::text;
use crate::design::texere_design;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{clear, give};
use crate::material::{array, texere_looks};
use crate::sized::{grows_after, sized};
use crate::status::texere_status;
use crate::structure::{choice, refused, texere_knit_yarn};

/// The lap of a guide at one course: in front of the needles, the guide moves from one needle space
/// to another. Space n lies between needle n - 1 and needle n.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_lap {
    /// The needle space before the overlap, 0 to 512.
    pub from: i32,
    /// The needle space after the overlap, 0 to 512, and at most two needles from `from`. Where it
    /// equals `from`, the yarn is laid in and makes no loop.
    pub to: i32,
}

/// The number that stands for no yarn in `threading` of a bar.
pub const TEXERE_NO_YARN: u32 = 4294967295;

/// A guide bar.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_bar {
    /// Its chain: a lap for each course, beginning with the course that is knitted first.
    pub laps: *const texere_lap,
    /// How many laps, 1 to 4096. The first lap follows the last one again.
    pub lap_count: u64,
    /// The yarn of each guide, counted from 0, or TEXERE_NO_YARN. Null with a `guide_count` of 0:
    /// all guides have yarn 0.
    pub threading: *const u32,
    /// How many guides `threading` is for. The guides after them hold the same yarns again, from
    /// the first one of `threading` on.
    pub guide_count: u64,
    /// Run-in: length of yarn for a rack of 480 courses, mm. 0: the laps give it.
    pub run_in_mm: f64,
    /// By how many needles the whole bar is moved towards the high numbers.
    pub offset: i32,
    /// Zero.
    pub reserved: u32,
}

/// The Jacquard of a guide bar: an image whose colours displace single guides. Each cell of the
/// image is for one guide and one round of the bar's chain. The image repeats beyond its edges.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_jacquard {
    /// How many guides the image is wide. 0: the bar is no Jacquard bar, and the rest is not read.
    pub guides: u32,
    /// How many rounds of the chain the image is high.
    pub rounds: u32,
    /// The number of each cell's colour, counted from 0. There are `guides` times `rounds` cells:
    /// those of the round knitted first, from guide 0 on, then those of the next round.
    pub colors: *const u8,
    /// How many colours there are, 1 to 256.
    pub color_count: u64,
    /// Two numbers, each 0 or 1, for each colour at each lap of the chain. They are the needles by
    /// which the colour moves the beginning and the end of the lap towards the high numbers. The
    /// numbers of the first colour come first, lap after lap, 2 times `lap_count` of them; then
    /// those of the next colour.
    pub shifts: *const u8,
}

/// A warp knit as the caller's arrays.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_warp_knit {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// A constant whose name begins with TEXERE_CELLS.
    pub cells: u32,
    /// How many wales: a multiple of `guide_count` of every bar that has a threading, and of
    /// `guides` of every Jacquard.
    pub wales: u32,
    /// How many courses: a multiple of `lap_count` of every bar, and for a Jacquard bar of
    /// `lap_count` times `rounds`.
    pub courses: u32,
    /// How many copies of these wales and courses lie along the courses, and how many along the
    /// wales; each 1 or more.
    pub copies: [u32; 2],
    /// What the design is called, UTF-8.
    pub name: *const c_char,
    /// Length of the name, bytes.
    pub name_length: usize,
    /// The guide bars, the front one first.
    pub bars: *const texere_bar,
    /// How many guide bars, 1 to 64.
    pub bar_count: u64,
    /// The yarns.
    pub yarns: *const texere_knit_yarn,
    /// How many yarns.
    pub yarn_count: u64,
    /// Distance from one wale to the next, mm.
    pub wale_mm: f64,
    /// Distance from one course to the next, mm.
    pub course_mm: f64,
    /// The materials and sections that the yarns refer to.
    pub looks: texere_looks,
    /// The Jacquards of the guide bars, `bar_count` of them, or null if no bar has one.
    pub jacquards: *const texere_jacquard,
}

grows_after!(texere_warp_knit, looks);

impl texere_bar {
    /// # Safety
    ///
    /// Arrays are valid for reads.
    unsafe fn read(&self, name: &str) -> Result<Bar, Failure> {
        // SAFETY: the caller vouches for both.
        let (laps, guides) = unsafe {
            (
                array(&format!("{name}.laps"), self.laps, self.lap_count)?,
                array(&format!("{name}.threading"), self.threading, self.guide_count)?,
            )
        };
        let laps: Vec<_> = laps.iter().map(|&texere_lap { from, to }| Lap { from, to }).collect();
        let Some(chain) = Chain::new(laps.clone()) else { return Err(no_chain(name, &laps)) };
        let held = |yarn: &u32| (*yarn != TEXERE_NO_YARN).then_some(*yarn);
        let threading = if guides.is_empty() {
            Threading::full(0)
        } else {
            Threading::of(guides.iter().map(held).collect())
        };
        let run_in_mm = (self.run_in_mm != 0.0).then_some(self.run_in_mm);
        Ok(Bar { chain, threading, offset: self.offset, run_in_mm, jacquard: None })
    }
}

/// The failure that says why `Chain::new` refuses these laps.
fn no_chain(name: &str, laps: &[Lap]) -> Failure {
    let space = |space: i32| (0..=SPACE_MAX).contains(&space);
    for (number, lap) in laps.iter().enumerate() {
        let lap_name = format!("{name}.laps[{number}]");
        for (member, value) in [("from", lap.from), ("to", lap.to)] {
            if !space(value) {
                return Failure::argument(format!(
                    "{lap_name}.{member} is {value}, expected 0 to {SPACE_MAX}"
                ));
            }
        }
        if lap.overlap().abs() > NEEDLES_MOST {
            let needles = lap.overlap().abs();
            return Failure::argument(format!(
                "{lap_name} goes round {needles} needles, {NEEDLES_MOST} at most are taken"
            ));
        }
    }
    Failure::argument(format!("{name}.lap_count is {}, expected 1 to {CHAIN_COURSES}", laps.len()))
}

impl texere_jacquard {
    /// The displacements, or none for a bar that is no Jacquard bar. The chain of the bar has
    /// `laps` laps.
    ///
    /// # Safety
    ///
    /// Arrays are valid for reads.
    unsafe fn read(&self, name: &str, laps: usize) -> Result<Option<Displacements>, Failure> {
        let Self { guides, rounds, color_count, .. } = *self;
        if guides == 0 {
            return Ok(None);
        }
        if rounds == 0 || guides.checked_mul(rounds).is_none() {
            return Err(Failure::argument(format!(
                "{name} has {guides} guides and {rounds} rounds, expected 1 to {} cells",
                u32::MAX
            )));
        }
        if !(1..=256).contains(&color_count) {
            return Err(Failure::argument(format!("{name}.color_count is {color_count}, expected 1 to 256")));
        }
        // SAFETY: the caller vouches for both.
        let (colors, shifts) = unsafe {
            (
                array(&format!("{name}.colors"), self.colors, u64::from(guides) * u64::from(rounds))?,
                array(&format!("{name}.shifts"), self.shifts, color_count * 2 * laps as u64)?,
            )
        };
        if let Some(at) = colors.iter().position(|color| u64::from(*color) >= color_count) {
            return Err(Failure::argument(format!(
                "{name}.colors[{at}] is {}, but there are {color_count}, counted from 0",
                colors[at]
            )));
        }
        if let Some(at) = shifts.iter().position(|shift| *shift > 1) {
            return Err(Failure::argument(format!("{name}.shifts[{at}] is {}, expected 0 or 1", shifts[at])));
        }
        let palette = shifts.chunks(2 * laps).map(|color| color.as_chunks().0.to_vec()).collect();
        let color = |guide: u32, round: u32| colors[round as usize * guides as usize + guide as usize];
        let made = Displacements::new([guides, rounds], palette, color);
        made.map(Some).ok_or_else(|| Failure::argument(format!("{name} is no image of a Jacquard")))
    }
}

impl texere_warp_knit {
    /// # Safety
    ///
    /// Arrays and texts are valid for reads.
    unsafe fn read(&self) -> Result<Design, Failure> {
        // SAFETY: the caller vouches for all of them.
        let (bars, jacquards, yarns, (materials, sections), name) = unsafe {
            (
                array("knit.bars", self.bars, self.bar_count)?,
                self.images()?,
                array("knit.yarns", self.yarns, self.yarn_count)?,
                self.looks.read("knit")?,
                text("knit.name", self.name, self.name_length)?,
            )
        };
        let bars = bars.iter().enumerate().map(|(number, bar)| {
            // SAFETY: as above.
            let mut own = unsafe { bar.read(&format!("knit.bars[{number}]")) }?;
            if let Some(jacquard) = jacquards.get(number) {
                let (name, laps) = (format!("knit.jacquards[{number}]"), own.chain.courses());
                // SAFETY: as above.
                own.jacquard = unsafe { jacquard.read(&name, laps) }?;
            }
            Ok(own)
        });
        let bars = bars.collect::<Result<Vec<_>, Failure>>()?;
        let yarns = yarns.iter().map(texere_knit_yarn::read).collect();
        let gauge = Gauge::new(self.wale_mm, self.course_mm);
        let Self { wales, courses, copies, .. } = *self;
        let knit = WarpKnitted::new(bars.clone(), gauge, wales, courses, yarns, materials, sections, copies);
        let knit = knit.map_err(|error| refused("knit", error, &bars))?;
        let cells = choice("knit.cells", self.cells, &[Cells::Round, Cells::Even])?;
        Ok(Design::of(name, Structure::Warp(knit.with_cells(cells))))
    }

    /// The Jacquards of the bars: as many as bars, or none.
    ///
    /// # Safety
    ///
    /// The array is valid for reads.
    unsafe fn images(&self) -> Result<&[texere_jacquard], Failure> {
        let count = if self.jacquards.is_null() { 0 } else { self.bar_count };
        // SAFETY: the caller vouches for it.
        unsafe { array("knit.jacquards", self.jacquards, count) }
    }
}

/// Makes a design of a warp knit from the caller's arrays, which are copied. By default its yarns
/// come to rest; `texere_design_finished` makes a design with another finish.
///
/// Fails with TEXERE_ARGUMENT for arrays from which no knit can be made. The message names the
/// array, the element (counted from 0), the value and the limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_warp_knit(
    knit: *const texere_warp_knit,
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
