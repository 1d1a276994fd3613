//! Woven cloth from the caller's arrays: a drawdown or a shaft draft, and the threads of warp and
//! weft.

use std::ffi::c_char;

use texere::woven::{Crimp, Draft, Drawdown, Relief, Shape, Thread, Woven, WovenDesign};
use texere::yarn::{COTTON_LEAST_AREA, firmness_from_twist};
use texere::{Design, Structure};

use crate::argument::text;
use crate::design::texere_design;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{clear, give};
use crate::material::{array, texere_looks};
use crate::shafts::texere_draft;
use crate::sized::{grows_after, sized};
use crate::status::texere_status;
use crate::structure::{choice, refused};
use crate::view::texere_view;

/// An end or a pick.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_thread {
    /// Width of the strip of cloth that the thread takes, mm. The distance of two neighbours is
    /// half the sum of their spacings.
    pub spacing_mm: f64,
    /// Diameter that the yarn has when it is round, mm. `texere_diameter` works it out from a
    /// linear density in tex.
    pub diameter_mm: f64,
    /// Width over height in the cloth, 0.1 to 10; 0 stands for 1, which is round.
    pub flatness: f32,
    /// Stiffness against bending when the yarns come to rest, 0.01 to 100; 1 for cotton yarn of the
    /// same diameter. 0 stands for 1.
    pub stiffness: f32,
    /// How firmly the section keeps its shape when the yarns come to rest, 0.01 to 100; 1 for
    /// cotton of ordinary twist. Hard-twisted yarn is firmer and stays rounder, and filament
    /// without twist spreads flat at 0.1. 0 stands for what follows from `twist`, and for 1 without
    /// twist.
    pub firmness: f32,
    /// Twist, radians per mm; positive is Z twist.
    pub twist: f32,
    /// The number of its material, from 0.
    pub material: u32,
    /// The number of its section, from 0.
    pub section: u32,
    /// Least area that the yarn's section keeps when the yarns come to rest, as a share of the
    /// round yarn's section, up to 1: fibres can't be packed more closely. 0 stands for that of
    /// cotton, 0.7476.
    pub least_area: f32,
    /// Unused, 0.
    pub reserved: u32,
}

/// Threads bend round one another as round threads do, and floats lie flat.
pub const TEXERE_SHAPE_ROUND: u32 = 0;
/// A thread has one control point at each crossing, one before all of them and one after.
pub const TEXERE_SHAPE_CROSSING: u32 = 1;

/// Threads that lie too close are only reported.
pub const TEXERE_RELIEF_REPORT: u32 = 0;
/// Threads that lie too close are flattened.
pub const TEXERE_RELIEF_FLATTEN: u32 = 1;
/// Threads that lie too close are made thinner.
pub const TEXERE_RELIEF_SHRINK: u32 = 2;

/// Warp and weft share the crimp by stiffness, which is taken as the fourth power of the radius:
/// the stiffer set stays straighter. `stiffness` of the threads does not count.
pub const TEXERE_CRIMP_STIFFNESS: u32 = 0;
/// The warp has `warp_share` of the crimp.
pub const TEXERE_CRIMP_SHARE: u32 = 1;

/// Woven cloth as the caller's arrays.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_woven {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// A constant whose name begins with TEXERE_SHAPE.
    pub shape: u32,
    /// A constant whose name begins with TEXERE_RELIEF.
    pub relief: u32,
    /// 1 if the weft turns back round the outermost ends, 0 if each pick is cut at both edges.
    pub selvedge: u32,
    /// A constant whose name begins with TEXERE_CRIMP.
    pub crimp: u32,
    /// The warp's share of the crimp, 0 (straight ends) to 1 (straight picks), with
    /// TEXERE_CRIMP_SHARE.
    pub warp_share: f32,
    /// What the design is called, UTF-8.
    pub name: *const c_char,
    /// Length of the name, bytes.
    pub name_length: usize,
    /// How many ends.
    pub ends: u64,
    /// How many picks.
    pub picks: u64,
    /// A row of bits for each pick. The library only reads them. Row 0 is the first pick, at the
    /// bottom of the cloth. Bit 0 (the lowest) of a row's first byte is end 1, at the left; bit 0
    /// of its second byte is end 9. A bit is 1 where the end lies on the face. A row has (`ends` +
    /// 7) / 8 bytes, and `stride` bytes lie between the beginnings of two rows. With null `data`
    /// the cloth is that of `draft`.
    pub drawdown: texere_view,
    /// The ends from the left: `ends` of them.
    pub warp: *const texere_thread,
    /// The picks from the bottom: `picks` of them.
    pub weft: *const texere_thread,
    /// The materials and sections that the threads refer to.
    pub looks: texere_looks,
    /// The shaft draft that weaves the cloth, or null for a cloth that `drawdown` gives. WIF files
    /// and pictures of the draft show its shafts and treadles.
    pub draft: *const texere_draft,
}

grows_after!(texere_woven, looks);

impl texere_thread {
    fn read(&self) -> Thread {
        let Self { spacing_mm, diameter_mm, flatness, stiffness, firmness, twist, material, section, .. } =
            *self;
        let radius_mm = (diameter_mm / 2.0) as f32;
        let of_twist = if twist == 0.0 { 1.0 } else { firmness_from_twist(twist, radius_mm) };
        let or_one = |value: f32| if value == 0.0 { 1.0 } else { value };
        Thread {
            spacing_mm,
            radius_mm,
            flatness: or_one(flatness),
            stiffness: or_one(stiffness),
            firmness: if firmness == 0.0 { of_twist } else { firmness },
            least_area: if self.least_area == 0.0 { COTTON_LEAST_AREA } else { self.least_area },
            material,
            section,
            twist,
        }
    }
}

impl texere_woven {
    /// # Safety
    ///
    /// Arrays and texts are valid for reads.
    unsafe fn read(&self) -> Result<Design, Failure> {
        // A count that does not fit a `usize` becomes the largest one, which `Drawdown::new`
        // refuses.
        let [ends, picks] = [self.ends, self.picks].map(|count| usize::try_from(count).unwrap_or(usize::MAX));
        let refuse = |error| refused("woven", error, &[]);
        // SAFETY: the caller vouches for all of them.
        let ((drawdown, draft), warp, weft, (materials, sections), name) = unsafe {
            (
                self.weave(ends, picks)?,
                array("woven.warp", self.warp, self.ends)?,
                array("woven.weft", self.weft, self.picks)?,
                self.looks.read("woven")?,
                text("woven.name", self.name, self.name_length)?,
            )
        };
        let threads = |threads: &[texere_thread]| threads.iter().map(texere_thread::read).collect();
        let cloth = Woven::new(drawdown, threads(warp), threads(weft), materials, sections);
        let mut cloth = cloth.map_err(refuse)?;
        cloth.set_shape(choice("woven.shape", self.shape, &[Shape::Round, Shape::Crossing])?);
        cloth.set_selvedge(choice("woven.selvedge", self.selvedge, &[false, true])?);
        let crimps = [Crimp::Stiffness, Crimp::WarpShare(self.warp_share)];
        let crimp = choice("woven.crimp", self.crimp, &crimps)?;
        cloth.set_crimp(crimp).map_err(|error| refuse(error.into()))?;
        let reliefs = [Relief::Report, Relief::Flatten, Relief::Shrink];
        let relief = choice("woven.relief", self.relief, &reliefs)?;
        let woven = WovenDesign::new(cloth, draft, relief).map_err(refuse)?;
        Ok(Design::of(name, Structure::Woven(woven)))
    }

    /// The drawdown, and the draft that weaves it if one was given.
    ///
    /// # Safety
    ///
    /// The conditions of `read` hold.
    unsafe fn weave(&self, ends: usize, picks: usize) -> Result<(Drawdown, Option<Draft>), Failure> {
        let refuse = |error| refused("woven", error, &[]);
        // Sizes that no cloth has are refused before any array is read.
        let mut drawdown = Drawdown::new(ends, picks).map_err(refuse)?;
        if !self.draft.is_null() {
            if !self.drawdown.data.is_null() {
                return Err(Failure::argument("woven has both a drawdown and a draft, expected one of them"));
            }
            // SAFETY: the caller vouches for all of them.
            let draft = unsafe { sized("woven.draft", self.draft)?.read(ends, picks) }?;
            return Ok((draft.drawdown().map_err(|error| refused("woven.draft", error, &[]))?, Some(draft)));
        }
        // SAFETY: as above.
        let bits = unsafe { self.drawdown.rows("woven.drawdown", picks, ends.div_ceil(8)) }?;
        for pick in 0..picks {
            let row = bits.row(pick);
            for end in (0..ends).filter(|end| row[end / 8] >> (end % 8) & 1 == 1) {
                drawdown.set(end, pick, true).map_err(|error| refuse(error.into()))?;
            }
        }
        Ok((drawdown, None))
    }
}

/// Makes a design of woven cloth from the caller's arrays, which are copied. By default its yarns
/// come to rest; `texere_design_finished` makes a design with another finish.
///
/// Fails with TEXERE_ARGUMENT for arrays from which no cloth can be made. The message names the
/// array, the element (counted from 0), the value and the limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_woven(
    woven: *const texere_woven,
    out: *mut *mut texere_design,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `woven`.
        unsafe {
            clear(out)?;
            give(out, sized("woven", woven)?.read()?)
        }
    })
}
