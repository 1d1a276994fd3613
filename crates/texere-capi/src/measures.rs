//! Measures of a cloth: yarn, weight, thickness, crimp, cover, loops.

use std::hint::black_box;

use texere::check::{Cover, KnitMeasures, Measures};

use crate::argument::slice_mut;
use crate::cloth::{Cloth, texere_cloth};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::get;
use crate::sized::{check_sized, grows_after, write_sized};
use crate::status::texere_status;
use crate::yarns::exactly;

/// Measures of a cloth. A measure that the cloth does not have, or that can't be known, is NaN.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_measures {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Wales of a knit; 0 of woven cloth.
    pub wales: u32,
    /// Courses of a knit; 0 of woven cloth.
    pub courses: u32,
    /// How many materials there are: `texere_cloth_lengths` gives the length of each.
    pub materials: u32,
    /// Loops of a knit; 0 of woven cloth.
    pub loops: u64,
    /// Width of the cloth, along the weft or the courses, mm.
    pub width: f64,
    /// Height of the cloth, along the warp or the wales, mm.
    pub height: f64,
    /// Thickness of the cloth without load, mm.
    pub thickness: f64,
    /// Length of all yarn, mm.
    pub length: f64,
    /// Weight, g/m². NaN unless every material that is used has a tex.
    pub areal_weight: f64,
    /// Crimp of the warp: length of yarn over length of cloth, less 1. NaN of a knit.
    pub warp_crimp: f64,
    /// Crimp of the weft, in the same way.
    pub weft_crimp: f64,
    /// The share of the cloth's width that ends cover, from 0 to 1. NaN of a knit.
    pub warp_cover: f64,
    /// The share of the cloth's height that picks cover, from 0 to 1. NaN of a knit.
    pub weft_cover: f64,
    /// The share of the cloth's area that ends and picks cover together, from 0 to 1. NaN of a
    /// knit.
    pub cover: f64,
    /// Peirce's cover factor of the warp: ends per inch over the square root of the cotton count.
    /// NaN of a knit, and unless every material that is used has a tex.
    pub warp_cover_factor: f64,
    /// Peirce's cover factor of the weft, in the same way.
    pub weft_cover_factor: f64,
    /// Peirce's cover factor of the cloth, K1 + K2 - K1 K2 / 28, where K1 and K2 are the factors of
    /// warp and weft.
    pub cover_factor: f64,
    /// Mean length of yarn in a loop, mm. NaN of woven cloth.
    pub loop_length: f64,
    /// Loops per square centimetre. NaN of woven cloth.
    pub loops_per_cm2: f64,
    /// Tightness factor: the square root of the tex over the loop length in cm. NaN of woven cloth,
    /// and unless all yarns that are used have the same tex.
    pub tightness: f64,
}

grows_after!(texere_measures, tightness);

impl Cloth {
    /// The measures. They are taken at the first call and kept.
    fn measures(&self) -> Result<&Measures, Failure> {
        if let Some(measures) = self.measures.get() {
            return Ok(measures);
        }
        let (design, yarns) = (self.cloth.design(), self.cloth.yarns());
        let measures = design.structure.measures(yarns).map_err(|error| design.refused(error))?;
        Ok(self.measures.get_or_init(|| measures))
    }
}

/// Writes the measures of a cloth. The caller sets `measures->struct_size` before the call.
///
/// Fails with TEXERE_DESIGN if they can't be taken.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_measures(
    cloth: *const texere_cloth,
    measures: *mut texere_measures,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `measures`.
        unsafe { check_sized("measures", measures) }?;
        let cloth = get(cloth)?;
        let found = of(cloth.measures()?, cloth.cloth.design().structure.size_mm());
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(measures, found) };
        Ok(())
    })
}

fn of(measures: &Measures, [width, height]: [f64; 2]) -> texere_measures {
    let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
    // A compiler may read a measure before it looks whether the measure is there, and then drop the
    // value. Checkers of memory report such a read. The black box hides where the measures lie.
    let (crimp, cover, knit) =
        black_box((measures.crimp.as_ref(), measures.cover.as_ref(), measures.knit.as_ref()));
    let factor = black_box(cover.and_then(|cover| cover.factor.as_ref()));
    texere_measures {
        struct_size: size_of::<texere_measures>() as u32,
        wales: knit.map_or(0, |knit| knit.size[0]),
        courses: knit.map_or(0, |knit| knit.size[1]),
        materials: measures.length_mm.len() as u32,
        loops: knit.map_or(0, |knit| knit.loops),
        width,
        height,
        thickness: measures.thickness_mm,
        length: measures.length_mm.iter().sum(),
        areal_weight: known(measures.areal_weight),
        warp_crimp: known(crimp.map(|crimp| crimp.warp)),
        weft_crimp: known(crimp.map(|crimp| crimp.weft)),
        warp_cover: known(cover.map(|Cover { fraction, .. }| fraction.warp)),
        weft_cover: known(cover.map(|Cover { fraction, .. }| fraction.weft)),
        cover: known(cover.map(|Cover { cloth, .. }| *cloth)),
        warp_cover_factor: known(factor.map(|factor| factor.warp)),
        weft_cover_factor: known(factor.map(|factor| factor.weft)),
        cover_factor: known(cover.and_then(|cover| cover.cloth_factor)),
        loop_length: known(knit.map(|KnitMeasures { loop_length_mm, .. }| *loop_length_mm)),
        loops_per_cm2: known(knit.map(|KnitMeasures { stitch_density, .. }| *stitch_density)),
        tightness: known(knit.and_then(|knit| knit.tightness)),
    }
}

/// Writes the length of yarn of each material of a cloth, mm. `materials` of
/// `texere_cloth_measures` says how many numbers that is.
///
/// Fails with TEXERE_ARGUMENT if `count` is another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_lengths(
    cloth: *const texere_cloth,
    lengths: *mut f64,
    count: u64,
) -> texere_status {
    guard(|| {
        let cloth = get(cloth)?;
        let own = &cloth.measures()?.length_mm;
        exactly("count", count, own.len())?;
        // SAFETY: the caller vouches for `lengths`.
        unsafe { slice_mut("lengths", lengths, own.len()) }?.copy_from_slice(own);
        Ok(())
    })
}
