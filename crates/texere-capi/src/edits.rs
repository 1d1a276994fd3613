//! Edits of live cloth: its lifts, yarns, materials, tension and structure, and yarns that have
//! come to rest.

use texere::yarn::Material;
use texere::{ControlPoint, Yarn};

use crate::argument::{check, flag, slice};
use crate::design::texere_design;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{alone, get};
use crate::lendable::lendable;
use crate::live::{Editing, Known, texere_live};
use crate::material::texere_material;
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;
use crate::yarns::{texere_point, texere_yarns};

/// Properties of a yarn apart from its control points.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_yarn {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// The number of its material, counted from 0.
    pub material: u32,
    /// The number of its section, counted from 0.
    pub section: u32,
    /// 1 if its last control point joins up with its first, else 0.
    pub closed: u32,
    /// Its twist, radians per mm; positive is Z twist.
    pub twist: f32,
}

grows_after!(texere_yarn, twist);

/// Sets whether the warp is up where an end and a pick cross. Ends and picks count from 0. Both
/// threads then lie as the structure places them, even if they lay otherwise before.
///
/// Fails with TEXERE_ARGUMENT if there is no such crossing, if `up` is neither 0 nor 1, and if the
/// cloth has no weave: because it is a knit, or because only its yarns were given.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_lift(
    live: *const texere_live,
    end: u64,
    pick: u64,
    up: u32,
) -> texere_status {
    guard(|| {
        let (up, [end, pick]) = (flag("up", up)?, number([("end", end), ("pick", pick)])?);
        alone(live, |editing| Ok(editing.live.set_lift(end, pick, up)?))
    })
}

/// Sets many lifts at once: where `ends` ends from `first_end` on cross `picks` picks from
/// `first_pick` on. `up` has a byte for each of these crossings, 1 if the warp is up, else 0. The
/// bytes lie pick after pick, and those of a pick in the order of the ends.
///
/// Fails as `texere_live_set_lift` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_drawdown(
    live: *const texere_live,
    first_end: u64,
    ends: u64,
    first_pick: u64,
    picks: u64,
    up: *const u8,
) -> texere_status {
    guard(|| {
        let first = number([("first_end", first_end), ("first_pick", first_pick)])?;
        let count = number([("ends", ends), ("picks", picks)])?;
        let cells = count[0].checked_mul(count[1]).ok_or_else(|| {
            Failure::argument(format!("{ends} ends and {picks} picks are more than memory can hold"))
        })?;
        // SAFETY: the caller vouches for `up`.
        let up = unsafe { slice("up", up, cells) }?;
        if let Some(at) = up.iter().position(|up| *up > 1) {
            return Err(Failure::argument(format!("up[{at}] is {}, expected 0 or 1", up[at])));
        }
        let [ends, picks] = [0, 1].map(|set| first[set]..first[set].saturating_add(count[set]));
        let up = |end: usize, pick: usize| up[(pick - first[1]) * count[0] + (end - first[0])] == 1;
        alone(live, |editing| Ok(editing.live.set_drawdown(ends, picks, up)?))
    })
}

/// Writes to `up` 1 if the warp is up where an end and a pick cross, else 0. Ends and picks count
/// from 0.
///
/// Fails as `texere_live_set_lift` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_lift(
    live: *const texere_live,
    end: u64,
    pick: u64,
    up: *mut u32,
) -> texere_status {
    guard(|| {
        check("up", up)?;
        let [end, pick] = number([("end", end), ("pick", pick)])?;
        let found = alone(live, |editing| {
            let woven = editing.live.woven().ok_or(texere::mesh::LiveError::NotWoven)?;
            let drawdown = woven.drawdown();
            let (ends, picks) = (drawdown.ends(), drawdown.picks());
            if end >= ends || pick >= picks {
                return Err(Failure::argument(format!(
                    "end {end} and pick {pick}, but there are {ends} ends and {picks} picks, from 0"
                )));
            }
            Ok(drawdown.up(end, pick))
        })?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { up.write(found.into()) };
        Ok(())
    })
}

/// Replaces a yarn, counted from 0: its properties and its control points. There may be more or
/// fewer points than before.
///
/// Fails with TEXERE_ARGUMENT if there is no such yarn, material or section, and for control points
/// that no yarn can have. The cloth then stays as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_yarn(
    live: *const texere_live,
    yarn: u64,
    what: *const texere_yarn,
    points: *const texere_point,
    point_count: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for both.
        let (given, points) = unsafe { (sized("what", what)?, slice("points", points, point_count)?) };
        let (closed, [yarn]) = (flag("what.closed", given.closed)?, number([("yarn", yarn)])?);
        let texere_yarn { material, section, twist, .. } = given;
        alone(live, |editing| {
            let what = Yarn { material, section, closed, twist, ..yarn_of(editing, yarn)? };
            Ok(editing.live.set_yarn(yarn, what, &own(points))?)
        })
    })
}

/// Gives a yarn, counted from 0, other control points. There may be more or fewer than before.
///
/// Fails as `texere_live_set_yarn` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_points(
    live: *const texere_live,
    yarn: u64,
    points: *const texere_point,
    point_count: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `points`.
        let points = unsafe { slice("points", points, point_count) }?;
        let [yarn] = number([("yarn", yarn)])?;
        alone(live, |editing| Ok(editing.live.set_points(yarn, &own(points))?))
    })
}

/// Writes the properties of a yarn, counted from 0, as they are now. `texere_live_yarns` gives its
/// control points. The caller sets `what->struct_size` before the call.
///
/// Fails with TEXERE_ARGUMENT if there is no such yarn.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_yarn(
    live: *const texere_live,
    yarn: u64,
    what: *mut texere_yarn,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `what`.
        unsafe { check_sized("what", what) }?;
        let [yarn] = number([("yarn", yarn)])?;
        let Yarn { material, section, closed, twist, .. } = alone(live, |editing| yarn_of(editing, yarn))?;
        let struct_size = size_of::<texere_yarn>() as u32;
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe {
            write_sized(what, texere_yarn { struct_size, material, section, closed: closed.into(), twist })
        };
        Ok(())
    })
}

/// Replaces a material, counted from 0. The mesh holds no colours, so no part of it has to be made
/// again. The bending stiffness that the material has from a design stays.
///
/// Fails with TEXERE_ARGUMENT if there is no such material, and for values that no material can
/// have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_material(
    live: *const texere_live,
    number: u64,
    material: *const texere_material,
) -> texere_status {
    guard(|| {
        check("material", material)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory and
        // the name.
        let material = unsafe { material.read().read("material") }?;
        let [number] = self::number([("number", number)])?;
        alone(live, |editing| {
            let bending = editing.live.materials().get(number).and_then(|material| material.bending);
            Ok(editing.live.set_material(number, Material { bending, ..material })?)
        })
    })
}

/// Writes a material, counted from 0, as it is now. Its name ends with a zero byte. The name is
/// valid until the next call of this function with this live cloth, or until the live cloth is
/// freed.
///
/// Fails with TEXERE_ARGUMENT if there is no such material.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_material(
    live: *const texere_live,
    number: u64,
    material: *mut texere_material,
) -> texere_status {
    guard(|| {
        check("material", material)?;
        let [number] = self::number([("number", number)])?;
        let found = alone(live, |editing| {
            let materials = editing.live.materials();
            let Some(Material { name, srgb, tex, hairiness, .. }) = materials.get(number) else {
                let materials = materials.len();
                return Err(texere::mesh::LiveError::NoMaterial { material: number, materials }.into());
            };
            let (srgb, tex, hairiness) = (*srgb, tex.unwrap_or(0.0), *hairiness);
            editing.name = lendable(name);
            Ok(texere_material {
                srgb,
                reserved: 0,
                tex,
                hairiness,
                name: editing.name.as_ptr(),
                name_length: editing.name.count_bytes(),
            })
        })?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { material.write(found) };
        Ok(())
    })
}

/// Sets the tension of the splines of all yarns, from 0 to below 1. The next update makes the whole
/// mesh again.
///
/// Fails with TEXERE_ARGUMENT for a tension outside these limits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_tension(live: *const texere_live, tension: f32) -> texere_status {
    guard(|| alone(live, |editing| Ok(editing.live.set_tension(tension)?)))
}

/// Replaces the structure by that of a design, such as a knit with another stitch or a weave with
/// other threads. The yarns lie as the new structure places them. The tension of splines stays. The
/// next update does not make yarns again that are the same in both structures.
///
/// Fails with TEXERE_DESIGN if the yarns of the structure can't be made, and as
/// `texere_live_of_cloth` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_structure(
    live: *const texere_live,
    design: *const texere_design,
) -> texere_status {
    guard(|| {
        let design = get(design)?;
        alone(live, |editing| {
            editing.live.set_structure(&design.structure)?;
            editing.known = Known::Design(design);
            Ok(())
        })
    })
}

/// Replaces all yarns. The next update does not make yarns again that stay the same. From then on
/// the live cloth has no weave, so its lifts can't be set.
///
/// Fails with TEXERE_ARGUMENT for yarns whose splines have another tension, and as
/// `texere_live_of_cloth` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_yarns(
    live: *const texere_live,
    yarns: *const texere_yarns,
) -> texere_status {
    guard(|| {
        let yarns = get(yarns)?;
        alone(live, |editing| {
            editing.live.set_yarns((*yarns).clone())?;
            editing.known = Known::Yarns;
            Ok(())
        })
    })
}

/// Replaces all yarns by those of the same cloth at rest, and keeps the weave. A thread whose lift
/// is set later lies as the structure places it, among the yarns at rest.
///
/// Fails with TEXERE_ARGUMENT for yarns whose splines have another tension, for more or fewer yarns
/// than the live cloth has, and for other sections.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_set_rest(
    live: *const texere_live,
    yarns: *const texere_yarns,
) -> texere_status {
    guard(|| {
        let yarns = get(yarns)?;
        alone(live, |editing| Ok(editing.live.set_rest(&yarns)?))
    })
}

/// Numbers of the caller's as `usize`. Fails for a number that does not fit.
fn number<const COUNT: usize>(given: [(&str, u64); COUNT]) -> Result<[usize; COUNT], Failure> {
    let mut numbers = [0; COUNT];
    for (own, (name, given)) in numbers.iter_mut().zip(given) {
        *own = usize::try_from(given)
            .map_err(|_| Failure::argument(format!("{name} is {given}, more than memory can hold")))?;
    }
    Ok(numbers)
}

/// Properties of yarn number `yarn` as they are now.
fn yarn_of(editing: &mut Editing, yarn: usize) -> Result<Yarn, Failure> {
    let yarns = editing.live.mesh().plan().layout().yarns();
    let missing = || texere::mesh::LiveError::NoYarn { yarn, yarns: yarns.len() };
    Ok(*yarns.get(yarn).ok_or_else(missing)?)
}

fn own(points: &[texere_point]) -> Vec<ControlPoint> {
    points.iter().map(|&point| point.into()).collect()
}
