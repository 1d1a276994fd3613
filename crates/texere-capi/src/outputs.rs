//! Making packed vertices, attributes and rings of a plan in the caller's memory.

use std::sync::Arc;

use texere::backend::definitions::Ring;
use texere::mesh::{Attribute, PackedVertex};

use crate::argument::check;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{get, get_any};
use crate::plan::{Planned, texere_plan};
use crate::run::texere_run;
use crate::status::texere_status;
use crate::view::{Strided, texere_view};

/// A vertex in 12 bytes, half the size of `texere_vertex`. docs/CONVENTIONS.md says how it is
/// unpacked.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_packed_vertex {
    /// The position. Each coordinate is a whole number of steps of `quantum_mm` of
    /// `texere_settings`, and the lowest 21 bits of that number are kept. The two words are one
    /// number of 64 bits, the first word its lower half: x has bits 0 to 20, y bits 21 to 41, z
    /// bits 42 to 62.
    pub position: [u32; 2],
    /// The unit normal, mapped to the octahedron and from there to a square: two coordinates from
    /// -1 to 1, in steps of 1/32767.
    pub normal: [i16; 2],
}

/// Where on its yarn a vertex lies, for shaders and textures.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_attribute {
    /// The yarn, counted from 0.
    pub yarn: u32,
    /// The angle round the section from its first corner, radians. The first corner turns with the
    /// yarn's twist.
    pub angle: f32,
    /// The length of the yarn from its start to the vertex's ring, mm.
    pub along: f32,
    /// The unit tangent of the yarn at the vertex's ring.
    pub tangent: [f32; 3],
}

/// A ring: a sample of a yarn's centreline.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_ring {
    /// Centre, mm.
    pub centre: [f32; 3],
    /// Half the width of the yarn, mm.
    pub half_width: f32,
    /// Unit tangent.
    pub tangent: [f32; 3],
    /// Turn of the section about the tangent, against the frame TEXERE_FRAME_UPRIGHT, in 1/2^32 of
    /// a full turn.
    pub roll: u32,
    /// Half the height of the yarn, mm.
    pub half_height: f32,
    /// Growth of the half width along the yarn, mm per mm.
    pub width_growth: f32,
    /// Growth of the half height along the yarn, mm per mm.
    pub height_growth: f32,
    /// Turn of the yarn's outline about the tangent, against the frame TEXERE_FRAME_UPRIGHT, in
    /// 1/2^32 of a full turn. It is 0 where the height of the yarn stands upright, and another
    /// number on, for example, a flattened yarn that runs steeply up or down.
    pub lean: u32,
}

const _: () = assert!(
    size_of::<texere_packed_vertex>() == size_of::<PackedVertex>()
        && size_of::<texere_attribute>() == size_of::<Attribute>()
        && size_of::<texere_ring>() == size_of::<Ring>()
);

/// A plan, and the caller's view `out` with room for as many values as `count` says of the plan.
///
/// # Safety
///
/// `out` is valid for a read, and the memory that it describes for writes.
unsafe fn places<T: Copy>(
    plan: *const texere_plan,
    name: &str,
    out: *const texere_view,
    count: impl FnOnce(&Planned) -> u64,
) -> Result<(Arc<Planned>, Strided<'static, T>), Failure> {
    check(name, out)?;
    let plan = get(plan)?;
    // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
    let places = unsafe { out.read().holds(name, count(&plan) as usize) }?;
    Ok((plan, places))
}

/// A closure that writes each piece of values to its places.
fn writer<T: Copy>(mut places: Strided<'_, T>) -> impl FnMut(u64, &[T]) {
    move |first, piece| places.write(first as usize, piece.iter().copied())
}

/// Makes the packed vertices of a plan in the caller's memory: a `texere_packed_vertex` for each
/// vertex that `texere_plan_counts` counts, in the order of the mesh's vertices. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT for a view that is too small, misaligned or null, with
/// TEXERE_CANCELLED if `run` was cancelled, and with TEXERE_UNSUPPORTED if the device can't make
/// them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_packed(
    plan: *const texere_plan,
    run: *const texere_run,
    packed: *const texere_view,
) -> texere_status {
    guard(|| {
        let run = get_any(run)?;
        // SAFETY: the caller vouches for `packed`.
        let (plan, places) = unsafe { places(plan, "packed", packed, |plan| plan.counts.vertices) }?;
        plan.start(run)?.packed(&plan.chunks, writer(places))?;
        Ok(())
    })
}

/// Makes the attributes of a plan's vertices in the caller's memory: a `texere_attribute` for each
/// vertex that `texere_plan_counts` counts, in the order of the mesh's vertices. `run` may be null.
///
/// Fails as `texere_plan_packed` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_attributes(
    plan: *const texere_plan,
    run: *const texere_run,
    attributes: *const texere_view,
) -> texere_status {
    guard(|| {
        let run = get_any(run)?;
        // SAFETY: the caller vouches for `attributes`.
        let (plan, places) = unsafe { places(plan, "attributes", attributes, |plan| plan.counts.vertices) }?;
        plan.start(run)?.attributes(&plan.chunks, writer(places))?;
        Ok(())
    })
}

/// Makes the centrelines of a plan's yarns in the caller's memory: a `texere_ring` for each ring
/// that `texere_plan_counts` counts, yarn after yarn as `texere_plan_ring_offsets` says. `run` may
/// be null.
///
/// Fails as `texere_plan_packed` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_trajectory(
    plan: *const texere_plan,
    run: *const texere_run,
    rings: *const texere_view,
) -> texere_status {
    guard(|| {
        let run = get_any(run)?;
        // SAFETY: the caller vouches for `rings`.
        let (plan, places) = unsafe { places(plan, "rings", rings, |plan| plan.counts.rings) }?;
        plan.start(run)?.trajectory(&plan.chunks, writer(places))?;
        Ok(())
    })
}
