//! Yarns: those of a cloth, of a file or of the caller's arrays.

use std::ffi::{c_char, c_void};
use std::path::Path;

use texere::read::CurveScale;
use texere::write::CurveFormat;
use texere::yarn::Halves;
use texere::{ControlPoint, Yarn, Yarns};

use crate::argument::{check, slice, slice_mut, text};
use crate::callback_file::{CallbackFile, texere_write_callback};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, clear, free, get, give};
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;
use crate::structure::choice;

/// Yarns: their control points, sections and materials.
#[derive(Debug)]
pub struct texere_yarns;

impl Handle for texere_yarns {
    type Value = Yarns;
    const NAME: &str = "yarns";
}

/// A control point of a yarn, mm.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct texere_point {
    /// Along the weft or the courses.
    pub x: f32,
    /// Along the warp or the wales.
    pub y: f32,
    /// Out of the technical face.
    pub z: f32,
    /// Half the width of the yarn, across the cloth.
    pub half_width: f32,
    /// Half the height of the yarn, out of the cloth. In a round yarn it equals `half_width`.
    pub half_height: f32,
}

impl From<texere_point> for ControlPoint {
    fn from(texere_point { x, y, z, half_width, half_height }: texere_point) -> Self {
        Self { halves: Halves::new(half_width, half_height), ..Self::new(x, y, z, half_width) }
    }
}

/// Yarns as the caller's arrays.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_yarn_arrays {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Tension of the splines through the control points, from 0 to below 1; 0 is usual.
    pub tension: f32,
    /// How many yarns there are.
    pub yarns: u64,
    /// `yarns + 1` numbers: for each yarn the number of its first point, counted from 0 in
    /// `points`, and at the end how many points there are in all.
    pub offsets: *const u64,
    /// The control points of all yarns, yarn after yarn.
    pub points: *const texere_point,
    /// For each yarn 1 if its last point joins up with its first, else 0. Null: no yarn is closed.
    pub closed: *const u8,
    /// For each yarn its twist, radians per mm; positive is Z twist. Null: no yarn is twisted.
    pub twist: *const f32,
}

grows_after!(texere_yarn_arrays, twist);

/// How many yarns and control points a handle of yarns has.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_yarn_counts {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Tension of the splines through the control points.
    pub tension: f32,
    /// How many yarns there are.
    pub yarns: u64,
    /// How many control points all yarns have together.
    pub points: u64,
}

grows_after!(texere_yarn_counts, points);

/// Makes yarns, round or flattened, of the caller's arrays, which are copied.
///
/// Fails with TEXERE_ARGUMENT for arrays from which no yarns can be made. The message names the
/// yarn, the point, the value and the limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_new(
    arrays: *const texere_yarn_arrays,
    out: *mut *mut texere_yarns,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `arrays`.
        let (given, offsets) = unsafe {
            clear(out)?;
            let given = sized("arrays", arrays)?;
            let ends = usize::try_from(given.yarns).ok().and_then(|yarns| yarns.checked_add(1));
            let ends = ends.ok_or_else(|| Failure::argument("arrays.yarns is too large"))?;
            (given, slice("arrays.offsets", given.offsets, ends)?)
        };
        if offsets.first() != Some(&0) || !offsets.is_sorted() {
            return Err(Failure::argument("arrays.offsets do not go up from 0"));
        }
        let total = offsets.last().and_then(|total| usize::try_from(*total).ok()).unwrap_or(0);
        let count = offsets.len() - 1;
        // SAFETY: the caller vouches for them.
        let (points, closed, twist) = unsafe {
            (
                slice("arrays.points", given.points, total)?,
                if given.closed.is_null() {
                    None
                } else {
                    Some(slice("arrays.closed", given.closed, count)?)
                },
                if given.twist.is_null() { None } else { Some(slice("arrays.twist", given.twist, count)?) },
            )
        };
        let points: Vec<ControlPoint> = points.iter().map(|&point| point.into()).collect();
        let mut yarns = Yarns::builder();
        yarns.tension(given.tension);
        for (number, bounds) in offsets.windows(2).enumerate() {
            let yarn = Yarn {
                closed: closed.is_some_and(|closed| closed[number] != 0),
                twist: twist.map_or(0.0, |twist| twist[number]),
                ..Yarn::default()
            };
            yarns.yarn(yarn, &points[bounds[0] as usize..bounds[1] as usize]);
        }
        // SAFETY: as above.
        unsafe { give(out, yarns.build()?) }
    })
}

/// Reads yarns from a `.yarns` file.
///
/// Fails with TEXERE_IO if the file can't be read, and with TEXERE_DESIGN if it holds no yarns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_read(
    path: *const c_char,
    path_length: usize,
    out: *mut *mut texere_yarns,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `path`.
        unsafe {
            clear(out)?;
            give(out, texere::read::yarns(text("path", path, path_length)?)?.yarns)
        }
    })
}

/// Reads yarns from the caller's memory, which holds the bytes of a `.yarns` file. Errors call the
/// file `name`.
///
/// Fails with TEXERE_DESIGN if the bytes hold no yarns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_read_memory(
    name: *const c_char,
    name_length: usize,
    data: *const u8,
    size: usize,
    out: *mut *mut texere_yarns,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for all of them.
        unsafe {
            clear(out)?;
            let (name, bytes) = (text("name", name, name_length)?, slice("data", data, size)?);
            give(out, texere::read::yarns_from(name, bytes)?.yarns)
        }
    })
}

/// Reads curves that another program wrote, as round yarns: Binary Curve Collection, `.bcc`; the
/// polylines of Wavefront OBJ, `.obj`; or the text form of Universal Scene Description, `.usda` or
/// `.usd`. Reads yarns of TexGen, `.tg3`, too, which keep the sections that they have there.
/// `unit_mm` is the length of the file's unit, and `diameter_mm` the diameter of all yarns. 0 for
/// either stands for what a `.usda`, `.usd` or `.tg3` file says. For other files `diameter_mm` must
/// not be 0, and a `unit_mm` of 0 stands for 1 mm.
///
/// Fails with TEXERE_IO if the file can't be read, and with TEXERE_DESIGN if it holds no curves or
/// lacks the diameter.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_read_curves(
    path: *const c_char,
    path_length: usize,
    unit_mm: f32,
    diameter_mm: f32,
    out: *mut *mut texere_yarns,
) -> texere_status {
    guard(|| {
        let given = |length: f32| (length != 0.0).then_some(length);
        let scale = CurveScale { unit_mm: given(unit_mm), diameter_mm: given(diameter_mm) };
        // SAFETY: the caller vouches for `out` and `path`.
        unsafe {
            clear(out)?;
            give(out, texere::read::curves(text("path", path, path_length)?, scale)?)
        }
    })
}

/// Writes yarns to a file. `.yarns` is texere's own form, which keeps every bit of them;
/// `texere_yarns_read` reads it. `.bcc` and `.usda` are centrelines for other programs: `.bcc`
/// holds control points alone, `.usda` also diameters and colours. An existing file of that name is
/// replaced only once the new one is complete.
///
/// Fails with TEXERE_IO if the file can't be written, and with TEXERE_UNSUPPORTED for yarns that
/// `.bcc` can't hold.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_write(
    yarns: *const texere_yarns,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        let yarns = get(yarns)?;
        if CurveFormat::from_path(Path::new(path)).is_ok() {
            texere::write::curves(&yarns, path)?;
        } else {
            texere::write::yarns(&yarns, path)?;
        }
        Ok(())
    })
}

/// texere's own form of yarns, `.yarns`.
pub const TEXERE_YARNS_FORMAT_YARNS: u32 = 0;
/// Binary Curve Collection, `.bcc`: control points alone.
pub const TEXERE_YARNS_FORMAT_BCC: u32 = 1;
/// The text form of Universal Scene Description, `.usda`: curves with diameters and colours.
pub const TEXERE_YARNS_FORMAT_USDA: u32 = 2;
/// The text form of Universal Scene Description with straight lines between control points, for
/// simulators. It has thicknesses and masses as the Alliance for OpenUSD proposes them.
pub const TEXERE_YARNS_FORMAT_LINEAR_USDA: u32 = 3;

/// Writes yarns and hands the bytes of the file to `callback`: the bytes that `texere_yarns_write`
/// writes, or those of a file of straight lines with TEXERE_YARNS_FORMAT_LINEAR_USDA. `format` is a
/// constant whose name begins with TEXERE_YARNS_FORMAT. The callback runs on the calling thread,
/// with `user` as its first argument.
///
/// Fails with TEXERE_UNSUPPORTED for yarns that TEXERE_YARNS_FORMAT_BCC can't hold, and with
/// TEXERE_CANCELLED if the callback returned a number other than 0. The bytes that came before then
/// are not a complete file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_write_to(
    yarns: *const texere_yarns,
    format: u32,
    callback: texere_write_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for the callback.
        let file = unsafe { CallbackFile::new(callback, user) }?;
        let formats = [None, Some(CurveFormat::Bcc), Some(CurveFormat::Usda), Some(CurveFormat::LinearUsda)];
        let curves = choice("format", format, &formats)?;
        let yarns = get(yarns)?;
        match curves {
            None => texere::write::yarns_to(&yarns, file)?,
            Some(format) => texere::write::curves_to(&yarns, format, file)?,
        };
        Ok(())
    })
}

/// Writes how many yarns and control points there are. The caller sets `counts->struct_size` before
/// the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_counts(
    yarns: *const texere_yarns,
    counts: *mut texere_yarn_counts,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `counts`.
        unsafe { check_sized("counts", counts) }?;
        let yarns = get(yarns)?;
        let found = texere_yarn_counts {
            struct_size: size_of::<texere_yarn_counts>() as u32,
            tension: yarns.tension(),
            yarns: yarns.layout().yarns().len() as u64,
            points: yarns.points().len() as u64,
        };
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(counts, found) };
        Ok(())
    })
}

/// Copies to the caller's memory where the points of each yarn begin, as in `offsets` of
/// `texere_yarn_arrays`, and the control points. With the numbers of `texere_yarns_counts` there
/// are `yarns + 1` offsets and `points` points.
///
/// Fails with TEXERE_ARGUMENT if `offset_count` or `point_count` is another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_points(
    yarns: *const texere_yarns,
    offsets: *mut u64,
    offset_count: u64,
    points: *mut texere_point,
    point_count: u64,
) -> texere_status {
    guard(|| {
        let yarns = get(yarns)?;
        let (from, own) = (yarns.layout().offsets(), yarns.points());
        exactly("offset_count", offset_count, from.len())?;
        exactly("point_count", point_count, own.len())?;
        check("offsets", offsets)?;
        // SAFETY: the caller vouches for both pointers, and `exactly` has compared the counts.
        let (offsets, points) =
            unsafe { (slice_mut("offsets", offsets, from.len())?, slice_mut("points", points, own.len())?) };
        offsets.copy_from_slice(from);
        for (point, own) in points.iter_mut().zip(own) {
            let (half_width, half_height) = (own.half_width(), own.half_height());
            *point = texere_point { x: own.x, y: own.y, z: own.z, half_width, half_height };
        }
        Ok(())
    })
}

/// Makes sure that the caller gives room for exactly as many values as are needed.
pub(crate) fn exactly(name: &str, given: u64, needed: usize) -> Result<(), Failure> {
    if given == needed as u64 {
        return Ok(());
    }
    Err(Failure::argument(format!("{name} is {given}, and {needed} are needed")))
}

/// Frees yarns. A null handle is allowed. Plans that were made of the yarns stay valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_free(yarns: *mut texere_yarns) {
    free(yarns);
}
