//! Operations on sessions, and on a plan's chunks, rings, arrays, streams and files for callbacks.

use std::ffi::c_void;
use std::ptr::{null, null_mut};

use texere_c::*;

use super::Operation;
use super::files::taking;
use crate::caller::Caller;
use crate::common::sized;

/// Takes a piece, or refuses it if `user` is 1.
unsafe extern "C" fn take_piece(user: *mut c_void, _: *const texere_piece) -> i32 {
    user.addr() as i32
}

/// A random plan, a run or none, and the sizes of the plan's mesh.
fn planned(caller: &mut Caller<'_>) -> (*mut texere_plan, *mut texere_run, texere_counts) {
    let (plan, run, mut counts) = (caller.handle(), caller.handle_or_null(), sized());
    // SAFETY: the place lives as long as the call.
    unsafe { texere_plan_counts(plan, &mut counts) };
    (plan, run, counts)
}

/// Makes `call` with a view of `count` values, or sometimes with a view that is too small or with
/// none.
pub(super) fn viewed<T>(
    caller: &mut Caller<'_>,
    count: u64,
    call: impl FnOnce(*const texere_view) -> texere_status,
) -> texere_status {
    let (least, apart) = (size_of::<T>() as u64, caller.random.pick(&[0, 0, 8]));
    let mut memory = vec![0_u64; (count * (least + apart)).div_ceil(8) as usize + 1];
    let size = caller.random.pick(&[8 * memory.len() as u64, 8 * memory.len() as u64, 4]);
    let stride = caller.random.pick(&[least + apart, least + apart, least + apart, 1, u64::MAX]);
    let view = texere_view { data: memory.as_mut_ptr().cast(), size, stride };
    if caller.random.one_in(40) { call(null()) } else { call(&view) }
}

pub(super) fn operations() -> Vec<Operation> {
    table! {
        texere_plan_chunk, 3, |caller| {
            let (plan, chunk) = (caller.handle(), caller.sized());
            let number = caller.random.pick(&[0, 0, 0, 1, u64::MAX]);
            caller.place(chunk, |chunk| texere_plan_chunk(plan, number, chunk))
        };
        texere_plan_ring_offsets, 3, |caller| {
            let (plan, mut count) = (caller.handle(), 0);
            caller.place(null(), |offsets| texere_plan_ring_offsets(plan, offsets, &mut count))
        };
        texere_plan_mesh_arrays, 3, |caller| {
            let (plan, run, counts) = planned(caller);
            let (none, mut indices) =
                (texere_view { data: null_mut(), size: 0, stride: 0 }, vec![0_u32; counts.indices as usize]);
            let data = indices.as_mut_ptr().cast();
            let indices = texere_view { data, size: 4 * counts.indices, stride: 4 };
            let indices = caller.random.pick(&[none, indices]);
            let arrays = texere_mesh_arrays { normals: none, indices, ..caller.sized() };
            viewed::<[f32; 3]>(caller, counts.vertices, |view| {
                let positions = if view.is_null() { none } else { *view };
                texere_plan_mesh_arrays(plan, run, &texere_mesh_arrays { positions, ..arrays })
            })
        };
        texere_plan_packed, 2, |caller| {
            let (plan, run, counts) = planned(caller);
            viewed::<texere_packed_vertex>(caller, counts.vertices, |view| texere_plan_packed(plan, run, view))
        };
        texere_plan_attributes, 2, |caller| {
            let (plan, run, counts) = planned(caller);
            viewed::<texere_attribute>(caller, counts.vertices, |view| texere_plan_attributes(plan, run, view))
        };
        texere_plan_trajectory, 2, |caller| {
            let (plan, run, counts) = planned(caller);
            viewed::<texere_ring>(caller, counts.rings, |view| texere_plan_trajectory(plan, run, view))
        };
        texere_plan_stream, 2, |caller| {
            let (plan, run) = (caller.handle(), caller.handle_or_null());
            let callback: texere_piece_callback = if caller.random.one_in(20) { None } else { Some(take_piece) };
            let user = caller.random.pick(&[0, 0, 1]);
            texere_plan_stream(plan, run, callback, std::ptr::without_provenance_mut(user))
        };
        texere_plan_write_to, 2, |caller| {
            let (plan, run, format) = (caller.handle(), caller.handle_or_null(), caller.random.choice(10));
            let (callback, user) = taking(caller);
            texere_plan_write_to(plan, run, format, callback, user)
        };
    }
}

pub(super) fn sessions() -> Vec<Operation> {
    table! {
        texere_session_new, 1, |caller| {
            let (plan, run) = (caller.handle(), caller.handle_or_null());
            caller.out(|out| texere_session_new(plan, run, out))
        };
        texere_session_native, 2, |caller| {
            let (session, native) = (caller.handle(), caller.sized());
            caller.place(native, |native| texere_session_native(session, native))
        };
        texere_session_mesh, 3, |caller| {
            let (session, mesh) = (caller.handle(), caller.sized());
            let number = caller.random.pick(&[0, 0, 0, 1, u64::MAX]);
            caller.place(mesh, |mesh| texere_session_mesh(session, number, mesh))
        };
        texere_session_wait, 2, |caller| texere_session_wait(caller.handle());
        texere_session_read, 2, |caller| {
            let (session, number) = (caller.handle(), caller.random.pick(&[0, 0, 1, u64::MAX]));
            texere_session_read(session, number, null_mut(), 0, null_mut(), 0)
        };
    }
}
