//! Calls about plans and sessions, and the memory that they write to, with wrong arguments. No call
//! has a valid session, because `cpu` has no sessions.

use std::ffi::c_void;
use std::ptr::{null, null_mut};

use texere_c::*;

use crate::common::sized;
use crate::handles::Handles;
use crate::mesh::settings;
use crate::tools::{Case, case, handles, no_handle, sizes, strange};

pub(crate) unsafe extern "C" fn take_bytes(_: *mut c_void, _: u64, _: *const u8, _: usize) -> i32 {
    0
}

unsafe extern "C" fn take_piece(_: *mut c_void, _: *const texere_piece) -> i32 {
    0
}

/// Invalid views: null, too small, misaligned, with values that overlap, and larger than memory.
pub(crate) fn views() -> &'static [texere_view] {
    let memory: *mut c_void = Box::leak(Box::new([0_u64; 9])).as_mut_ptr().cast();
    let of = |data, size, stride| texere_view { data, size, stride };
    Box::leak(Box::new([
        of(null_mut(), u64::MAX, 64),
        of(memory, 72, 64),
        of(memory.wrapping_byte_add(1), u64::MAX, 64),
        of(memory, u64::MAX, 8),
        of(memory, u64::MAX, 65),
        of(memory, u64::MAX, u64::MAX - 7),
    ]))
}

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    [of_plans(own), of_sessions(own)].into_iter().flatten().collect()
}

fn of_plans(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let (views, small) = (views(), &views()[1]);
    case!(cases, texere_plan_ring_offsets(own.plan, null_mut(), &mut 0));
    case!(cases, texere_plan_ring_offsets(own.plan, &mut null(), null_mut()));
    case!(cases, texere_plan_chunk(own.plan, 0, null_mut()));
    case!(cases, texere_plan_chunk(own.plan, 1, &mut sized()));
    case!(cases, texere_plan_chunk(own.plan, u64::MAX, &mut sized()));
    case!(cases, texere_plan_mesh_arrays(own.plan, null(), null()));
    case!(cases, texere_plan_stream(own.plan, null(), None, null_mut()));
    case!(cases, texere_plan_write_to(own.plan, null(), TEXERE_FORMAT_GLB, None, null_mut()));
    case!(cases, texere_plan_write_to(own.plan, null(), 9, Some(take_bytes), null_mut()));
    for view in views {
        let arrays = texere_mesh_arrays { positions: *view, ..sized() };
        case!(cases, texere_plan_mesh_arrays(own.plan, null(), &arrays));
    }
    for view in views.iter().map(std::ptr::from_ref).chain([null()]) {
        case!(cases, texere_plan_packed(own.plan, null(), view));
        case!(cases, texere_plan_attributes(own.plan, null(), view));
        case!(cases, texere_plan_trajectory(own.plan, null(), view));
    }
    handles!(cases, own, texere_plan, |it| texere_plan_write_to(it, null(), 0, Some(take_bytes), null_mut()));
    handles!(cases, own, texere_plan, |it| texere_plan_stream(it, null(), Some(take_piece), null_mut()));
    handles!(cases, own, texere_plan, |it| texere_plan_ring_offsets(it, &mut null(), &mut 0));
    handles!(cases, own, texere_plan, |it| texere_plan_chunk(it, 0, &mut sized()));
    handles!(cases, own, texere_plan, |it| texere_plan_mesh_arrays(it, null(), &sized()));
    handles!(cases, own, texere_plan, |it| texere_plan_packed(it, null(), small));
    handles!(cases, own, texere_plan, |it| texere_plan_attributes(it, null(), small));
    handles!(cases, own, texere_plan, |it| texere_plan_trajectory(it, null(), small));
    for run in strange() {
        no_handle!(cases, texere_plan_write_to(own.plan, run, 0, Some(take_bytes), null_mut()));
        no_handle!(cases, texere_plan_stream(own.plan, run, Some(take_piece), null_mut()));
        no_handle!(cases, texere_plan_mesh_arrays(own.plan, run, &sized()));
        no_handle!(cases, texere_plan_packed(own.plan, run, small));
        no_handle!(cases, texere_plan_attributes(own.plan, run, small));
        no_handle!(cases, texere_plan_trajectory(own.plan, run, small));
    }
    sizes!(cases, texere_chunk, |chunk| texere_plan_chunk(own.plan, 0, &mut chunk));
    sizes!(cases, texere_mesh_arrays, |arrays| texere_plan_mesh_arrays(own.plan, null(), &arrays));
    for quantum_mm in [0.0, 0.3, f32::NAN] {
        let settings = texere_settings { quantum_mm, ..settings() };
        case!(cases, texere_plan_new(own.yarns, own.device, &settings, &mut null_mut()));
    }
    cases
}

fn of_sessions(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    case!(cases, texere_session_new(own.plan, null(), null_mut()));
    case!(cases, texere_session_native(null(), null_mut()));
    case!(cases, texere_session_mesh(null(), 0, null_mut()));
    handles!(cases, own, texere_plan, |it| texere_session_new(it, null(), &mut null_mut()));
    handles!(cases, own, texere_session, |it| texere_session_native(it, &mut sized()));
    handles!(cases, own, texere_session, |it| texere_session_mesh(it, 0, &mut sized()));
    handles!(cases, own, texere_session, |it| texere_session_wait(it));
    handles!(cases, own, texere_session, |it| texere_session_read(it, 0, null_mut(), 0, null_mut(), 0));
    for run in strange() {
        no_handle!(cases, texere_session_new(own.plan, run, &mut null_mut()));
    }
    sizes!(cases, texere_native, |native| texere_session_native(null(), &mut native));
    sizes!(cases, texere_device_mesh, |mesh| texere_session_mesh(null(), 0, &mut mesh));
    cases
}
