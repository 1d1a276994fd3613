//! Warp knits from the caller's arrays: the laps and the threading of each guide bar, the gauge and
//! the yarns.

use std::ffi::c_char;

use texere::warp::{Bar, CHAIN_COURSES, Chain, Lap, NEEDLES_MOST, SPACE_MAX, Threading, WarpKnitted};
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

/// Stands in `threading` of a bar for a guide without a yarn.
pub const TEXERE_NO_YARN: u32 = 4294967295;

/// A guide bar.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_bar {
    /// Its chain: a lap for each course, from the first course knitted on.
    pub laps: *const texere_lap,
    /// How many laps, 1 to 4096. After the last one the first one follows again.
    pub lap_count: u64,
    /// The yarn of each guide, counted from 0, or TEXERE_NO_YARN. Null with a `guide_count` of 0:
    /// all guides have yarn 0.
    pub threading: *const u32,
    /// How many guides `threading` is for. After the last one it begins again.
    pub guide_count: u64,
    /// Run-in: length of yarn for a rack of 480 courses, mm. 0: the laps give it.
    pub run_in_mm: f64,
    /// By how many needles the whole bar is moved towards the high numbers.
    pub offset: i32,
    /// Zero.
    pub reserved: u32,
}

/// A warp knit as the caller's arrays.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_warp_knit {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// A constant whose name begins with TEXERE_CELLS.
    pub cells: u32,
    /// How many wales: a multiple of the number after which the threadings of all bars begin again.
    pub wales: u32,
    /// How many courses: a multiple of the number after which the chains of all bars begin again.
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

impl texere_warp_knit {
    /// # Safety
    ///
    /// Arrays and texts are valid for reads.
    unsafe fn read(&self) -> Result<Design, Failure> {
        // SAFETY: the caller vouches for all of them.
        let (bars, yarns, (materials, sections), name) = unsafe {
            (
                array("knit.bars", self.bars, self.bar_count)?,
                array("knit.yarns", self.yarns, self.yarn_count)?,
                self.looks.read("knit")?,
                text("knit.name", self.name, self.name_length)?,
            )
        };
        // SAFETY: as above.
        let bars = bars.iter().enumerate().map(|(n, bar)| unsafe { bar.read(&format!("knit.bars[{n}]")) });
        let bars = bars.collect::<Result<Vec<_>, _>>()?;
        let yarns = yarns.iter().map(texere_knit_yarn::read).collect();
        let gauge = Gauge::new(self.wale_mm, self.course_mm);
        let Self { wales, courses, copies, .. } = *self;
        let knit = WarpKnitted::new(bars.clone(), gauge, wales, courses, yarns, materials, sections, copies);
        let knit = knit.map_err(|error| refused("knit", error, &bars))?;
        let cells = choice("knit.cells", self.cells, &[Cells::Round, Cells::Even])?;
        Ok(Design::of(name, Structure::Warp(knit.with_cells(cells))))
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
