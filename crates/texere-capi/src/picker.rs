//! Picking: what a ray hits first, and the weaver's or knitter's name of that place.

use std::ffi::c_char;
use std::sync::Arc;

use texere::backend::Plan;
use texere::mesh::{End, Ray};
use texere::yarn::YarnPlace;
use texere::{Hit, Picker, Settings, Yarns};

use crate::argument::{check, write_text};
use crate::cloth::texere_cloth;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, alone, clear, free, get, give};
use crate::live::texere_live;
use crate::settings::{chosen, texere_settings};
use crate::status::texere_status;
use crate::yarns::texere_yarns;

/// A picker, which says what a ray would hit first of the mesh of yarns. The mesh itself is not
/// made.
#[derive(Debug)]
pub struct texere_picker;

impl Handle for texere_picker {
    type Value = Picker;
    const NAME: &str = "picker";
}

/// A ray.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
pub struct texere_ray {
    /// Where it starts, mm.
    pub origin: [f64; 3],
    /// Where it goes: a direction of any length but 0.
    pub direction: [f64; 3],
}

/// No cap: the hit is on the side of the yarn.
pub const TEXERE_CAP_NONE: u32 = 0;
/// The cap that closes the start of the yarn.
pub const TEXERE_CAP_START: u32 = 1;
/// The cap that closes the end of the yarn.
pub const TEXERE_CAP_FINISH: u32 = 2;

/// What a ray hits first.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct texere_hit {
    /// 1 if the ray hits anything; else 0, and everything else is 0 as well.
    pub found: u32,
    /// The yarn, counted from 0.
    pub yarn: u32,
    /// The ring before the triangle that is hit, counted from 0 at the start of the yarn.
    pub ring: u32,
    /// The corner of the section before the triangle, counted from 0; 0 on a cap.
    pub side: u32,
    /// A constant whose name begins with TEXERE_CAP.
    pub cap: u32,
    /// The interval of the yarn, counted from 0: interval n lies between control points n and n +
    /// 1.
    pub interval: u32,
    /// Position along the interval, from 0 to 1.
    pub t: f64,
    /// Distance from the start of the ray, in lengths of its direction: in mm if the direction has
    /// length 1.
    pub distance: f64,
    /// The point that is hit, mm.
    pub position: [f64; 3],
}

impl From<texere_ray> for Ray {
    fn from(texere_ray { origin, direction }: texere_ray) -> Self {
        Self { origin, direction }
    }
}

impl From<Option<Hit>> for texere_hit {
    fn from(hit: Option<Hit>) -> Self {
        let Some(Hit { distance, place, position, interval, t, .. }) = hit else { return Self::default() };
        let cap = match place.cap {
            None => TEXERE_CAP_NONE,
            Some(End::Start) => TEXERE_CAP_START,
            Some(End::Finish) => TEXERE_CAP_FINISH,
        };
        let (yarn, ring, side) = (place.yarn, place.ring, place.side);
        Self { found: 1, yarn, ring, side, cap, interval, t, distance, position }
    }
}

/// The place of a hit along its yarn.
#[derive(Debug, Clone, Copy)]
struct Place {
    yarn: usize,
    interval: usize,
    t: f64,
    position: [f64; 3],
}

/// The share of an interval by which the mesh of a yarn may lie beside its spline. With the fewest
/// rings, none between two control points, the mesh lies 0.125 beside a spline that turns by 90
/// degrees from one control point to the next, such as one through the corners of a square.
const SAG: f64 = 0.25;

impl Place {
    /// # Safety
    ///
    /// `hit` is valid for a read.
    unsafe fn of(hit: *const texere_hit) -> Result<Self, Failure> {
        check("hit", hit)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        let texere_hit { found, yarn, interval, t, position, .. } = unsafe { hit.read() };
        if found != 1 {
            return Err(Failure::argument(format!("hit.found is {found}, so there is no place to name")));
        }
        Ok(Self { yarn: yarn as usize, interval: interval as usize, t, position })
    }

    /// The place on yarn `number` of `yarns`. Fails if there is none, and if the hit lies too far
    /// from the place to be on that yarn's surface. Such a hit is one of other yarns, for example
    /// one of live cloth from before an edit, and its numbers stand for another place here.
    fn on(&self, yarns: &Yarns, number: usize) -> Result<YarnPlace, Failure> {
        let Self { yarn, interval, t, position } = *self;
        let at = YarnPlace::at(yarns, number, interval, t).ok_or_else(|| {
            Failure::argument(format!("there is no place {t} in interval {interval} of yarn {yarn}"))
        })?;
        let points = yarns.yarn_points(number).unwrap_or_default();
        let ends = [points[interval], points[(interval + 1) % points.len()]];
        let half = ends.map(|end| end.half_width().max(end.half_height()));
        let layout = yarns.layout();
        let section = &layout.sections()[layout.yarns()[number].section as usize];
        let corners = section.outline(layout.corners().unwrap_or(Settings::default().sides));
        let reach = corners.iter().map(|corner| corner.x.hypot(corner.y)).fold(0.0, f32::max);
        let length = f64::from(ends[0].position().distance(ends[1].position()));
        let most = f64::from(half[0].max(half[1]) * reach) + SAG * length;
        let apart = [0, 1, 2].map(|axis| (position[axis] - at.position[axis]).powi(2));
        let apart = apart.iter().sum::<f64>().sqrt();
        if apart <= most {
            return Ok(at);
        }
        Err(Failure::argument(format!(
            "hit.position is {apart:.3} mm from place {t} in interval {interval} of yarn {yarn}, expected \
             {most:.3} at most: the hit is one of other yarns, or of an edited yarn before its edit"
        )))
    }
}

/// Reads a ray of the caller's, and writes what `pick` returns for it.
///
/// # Safety
///
/// `ray` is valid for a read, `hit` for a write.
unsafe fn picked(
    ray: *const texere_ray,
    hit: *mut texere_hit,
    pick: impl FnOnce(&Ray) -> Result<Option<Hit>, Failure>,
) -> Result<(), Failure> {
    check("ray", ray)?;
    check("hit", hit)?;
    // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
    let ray = unsafe { ray.read() };
    let found = pick(&ray.into())?;
    // SAFETY: as for `ray`.
    unsafe { hit.write(found.into()) };
    Ok(())
}

/// Makes a picker of yarns. `settings` may be null, and then those of `texere_settings_default`
/// apply.
///
/// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_MEMORY if memory does not
/// suffice.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_picker_new(
    yarns: *const texere_yarns,
    settings: *const texere_settings,
    out: *mut *mut texere_picker,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let yarns = get(yarns)?;
        // SAFETY: the caller vouches for `settings`.
        let settings = unsafe { chosen(settings, &yarns) }?;
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        // SAFETY: as above.
        unsafe { give(out, Picker::new(plan, yarns.points())?) }
    })
}

/// Writes which triangle a ray hits first, from either side. If several lie at the same distance,
/// it is the first along the yarns. A ray whose direction is zero, or whose numbers are not finite,
/// hits nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_picker_pick(
    picker: *const texere_picker,
    ray: *const texere_ray,
    hit: *mut texere_hit,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `ray` and `hit`.
        unsafe { picked(ray, hit, |ray| Ok(get(picker)?.pick(ray))) }
    })
}

/// Writes what a weaver or a knitter calls the place of a hit in a cloth, such as `end 3 at pick 4,
/// cotton`. If the cloth is knitted by a program, the place in the program follows. The hit is one
/// of a picker of the cloth's yarns.
///
/// `*length` becomes the length of the text in bytes. The text and a zero byte go to `words`, which
/// has room for `size` bytes. If `size` is 0, only the length is written, and `words` may be null.
///
/// Fails with TEXERE_ARGUMENT if the cloth has no such place, if the place is not where the hit is,
/// for example because the hit is one of live cloth that was edited, and if `size` is neither 0 nor
/// above the length.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_place(
    cloth: *const texere_cloth,
    hit: *const texere_hit,
    words: *mut c_char,
    size: usize,
    length: *mut usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `hit`.
        let place = unsafe { Place::of(hit) }?;
        let cloth = get(cloth)?;
        let yarns = cloth.cloth.yarns();
        let at = place.on(yarns, place.yarn)?;
        let said = cloth.cloth.design().named(yarns, &at).to_string();
        // SAFETY: the caller vouches for `words` and `length`.
        unsafe { write_text(&said, words, size, length) }
    })
}

/// Writes what a ray hits first in a live cloth as it is now, with edits that no update has brought
/// to the mesh yet.
///
/// Fails with TEXERE_MEMORY if memory does not suffice.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_pick(
    live: *const texere_live,
    ray: *const texere_ray,
    hit: *mut texere_hit,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `ray` and `hit`.
        unsafe { picked(ray, hit, |ray| alone(live, |editing| Ok(editing.live.pick(ray)?))) }
    })
}

/// Writes what a weaver or a knitter calls the place of a hit in a live cloth, such as `end 3 at
/// pick 4, cotton`, in the same way as `texere_cloth_place`. If the yarns come from no design, the
/// text only names the yarn.
///
/// Fails with TEXERE_ARGUMENT if the live cloth has no such place, and if the place is no longer
/// where the hit is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_place(
    live: *const texere_live,
    hit: *const texere_hit,
    words: *mut c_char,
    size: usize,
    length: *mut usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `hit`.
        let place = unsafe { Place::of(hit) }?;
        let said = alone(live, |editing| {
            // To name a place, its yarn is enough: `yarn` has it alone, as number 0.
            let yarn = editing.live.only(place.yarn)?;
            let at = place.on(&yarn, 0)?;
            let named = editing.known.design().map(|design| design.named(&yarn, &at).to_string());
            Ok(named.unwrap_or_else(|| yarn.layout().yarns()[0].origin.to_string()))
        })?;
        // SAFETY: the caller vouches for `words` and `length`.
        unsafe { write_text(&said, words, size, length) }
    })
}

/// Frees a picker. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_picker_free(picker: *mut texere_picker) {
    free(picker);
}
