//! What else a plan makes in the caller's memory: packed vertices, attributes, rings.

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

/// A vertex in half the bytes. docs/CONVENTIONS.md says how it is unpacked.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_packed_vertex {
    /// The position in whole quanta, the lowest 21 bits of each coordinate: x in bits 0 to 20 of
    /// these 64, the first word lowest, y in bits 21 to 41, z in bits 42 to 62.
    pub position: [u32; 2],
    /// The normal on an octahedron, in steps of 1/32767.
    pub normal: [i16; 2],
}

/// Where on its yarn a vertex lies, for shaders and textures.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_attribute {
    /// The yarn, from 0.
    pub yarn: u32,
    /// The angle round the section from its first corner, radians. It turns with the twist.
    pub angle: f32,
    /// The length of the yarn from its start to the vertex's ring, mm.
    pub along: f32,
    /// The unit tangent of the yarn there.
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
    /// Turn of the section about the tangent against the upright frame, in 1/2^32 of a full turn.
    pub roll: u32,
    /// Half the height of the yarn, mm.
    pub half_height: f32,
    /// Growth of the half width along the yarn, mm per mm.
    pub width_growth: f32,
    /// Growth of the half height along the yarn, mm per mm.
    pub height_growth: f32,
    /// Turn of the outline of a flattened yarn about the tangent, in 1/2^32 of a full turn.
    pub lean: u32,
}

const _: () = assert!(
    size_of::<texere_packed_vertex>() == size_of::<PackedVertex>()
        && size_of::<texere_attribute>() == size_of::<Attribute>()
        && size_of::<texere_ring>() == size_of::<Ring>()
);

/// A plan, and as many places as one of its counts says.
///
/// # Safety
///
/// `out` is valid for a read, and what it says for writes.
unsafe fn places<T: Copy>(
    plan: *const texere_plan,
    name: &str,
    out: *const texere_view,
    count: impl FnOnce(&Planned) -> u64,
) -> Result<(Arc<Planned>, Strided<'static, T>), Failure> {
    check(name, out)?;
    let plan = get(plan)?;
    // SAFETY: neither null nor misaligned; the caller vouches for the rest.
    let places = unsafe { out.read().holds(name, count(&plan) as usize) }?;
    Ok((plan, places))
}

/// A sink that writes pieces to their places.
fn writer<T: Copy>(mut places: Strided<'_, T>) -> impl FnMut(u64, &[T]) {
    move |first, piece| places.write(first as usize, piece.iter().copied())
}

/// Makes the packed vertices of a plan in the caller's memory: a `texere_packed_vertex` for each
/// vertex that `texere_plan_counts` counts, in the order of the mesh's. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT for a view that is too small, misaligned or null, with
/// TEXERE_CANCELLED where `run` was cancelled, and with TEXERE_UNSUPPORTED where the device packs
/// none.
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
/// vertex that `texere_plan_counts` counts, in the order of the mesh's. `run` may be null.
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
