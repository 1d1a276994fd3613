//! Yarns: of a cloth, of a file, or of the caller's arrays.

use std::ffi::c_char;

use texere::yarn::Halves;
use texere::{ControlPoint, Yarn, Yarns};

use crate::argument::{check, slice, slice_mut, text};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, clear, free, get, give};
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;

/// Yarns: their control points, sections and materials.
#[derive(Debug)]
pub struct texere_yarns;

impl Handle for texere_yarns {
    type Value = Yarns;
    const NAME: &str = "yarns";
}

/// A place on the centreline of a yarn, mm.
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
    /// Half the height of the yarn, out of the cloth. A round yarn has its half width.
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
    /// Bytes of this struct, which the caller sets.
    pub struct_size: u32,
    /// Tension of the splines through the control points, from 0 to below 1; 0 is usual.
    pub tension: f32,
    /// How many yarns there are.
    pub yarns: u64,
    /// Where the points of each yarn begin, and behind them how many points there are in all:
    /// `yarns + 1` numbers, the first of which is 0.
    pub offsets: *const u64,
    /// The points of all yarns, yarn after yarn.
    pub points: *const texere_point,
    /// For each yarn 1 if its last point joins up with its first, else 0. Null: all are open.
    pub closed: *const u8,
    /// For each yarn its twist, radians a mm; positive is Z twist. Null: none has twist.
    pub twist: *const f32,
}

grows_after!(texere_yarn_arrays, twist);

/// How much yarns hold.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_yarn_counts {
    /// Bytes of this struct, which the caller sets.
    pub struct_size: u32,
    /// Tension of their splines.
    pub tension: f32,
    /// How many yarns there are.
    pub yarns: u64,
    /// How many control points they have in all.
    pub points: u64,
}

grows_after!(texere_yarn_counts, points);

/// Makes round and flattened yarns of the caller's arrays, which are copied.
///
/// Fails with TEXERE_ARGUMENT for arrays that no yarns can be: the message names yarn, point, value
/// and limit.
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

/// Reads yarns that were saved in a `.yarns` file.
///
/// Fails with TEXERE_IO where the file can't be read, and with TEXERE_DESIGN where it holds no
/// yarns.
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

/// Saves yarns in a `.yarns` file, to the bit.
///
/// Fails with TEXERE_IO where the file can't be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_write(
    yarns: *const texere_yarns,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        texere::write::yarns(&*get(yarns)?, path)?;
        Ok(())
    })
}

/// Writes how much yarns hold. The caller has set `counts->struct_size`.
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
        // SAFETY: `check_sized` has taken it; the caller vouches for the rest.
        unsafe { write_sized(counts, found) };
        Ok(())
    })
}

/// Copies offsets and control points to the caller's memory: `yarns + 1` offsets and `points`
/// points, as `texere_yarns_counts` says.
///
/// Fails with TEXERE_ARGUMENT where `offset_count` or `point_count` is another number.
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
        // SAFETY: the caller vouches for both; their lengths are those that were asked for.
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

/// Makes sure that a number of values is the one that is needed.
pub(crate) fn exactly(name: &str, given: u64, needed: usize) -> Result<(), Failure> {
    if given == needed as u64 {
        return Ok(());
    }
    Err(Failure::argument(format!("{name} is {given}, and {needed} are needed")))
}

/// Frees yarns, or nothing where they are null. Plans that were made of them stay valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_yarns_free(yarns: *mut texere_yarns) {
    free(yarns);
}
