//! Operations that write designs and yarns to a callback, and that read yarns from memory.

use std::ffi::c_void;
use std::ptr::{from_mut, without_provenance_mut};

use texere_c::*;

use super::Operation;
use crate::caller::Caller;

/// Takes bytes, or refuses them if `user` is 1.
unsafe extern "C" fn take_bytes(user: *mut c_void, _: u64, _: *const u8, _: usize) -> i32 {
    user.addr() as i32
}

/// Adds bytes to the vector that `user` points to.
unsafe extern "C" fn keep_bytes(user: *mut c_void, _: u64, data: *const u8, size: usize) -> i32 {
    // SAFETY: `user` is that of the call below, and the library lends the bytes.
    unsafe { (*user.cast::<Vec<u8>>()).extend_from_slice(std::slice::from_raw_parts(data, size)) };
    0
}

/// A callback with its `user`: one that takes all bytes, one that refuses them, or sometimes none.
pub(super) fn taking(caller: &mut Caller<'_>) -> (texere_write_callback, *mut c_void) {
    let callback: texere_write_callback = if caller.random.one_in(20) { None } else { Some(take_bytes) };
    (callback, without_provenance_mut(caller.random.pick(&[0, 0, 1])))
}

pub(super) fn operations() -> Vec<Operation> {
    table! {
        texere_design_write_to, 2, |caller| {
            let (design, format, (callback, user)) = (caller.handle(), caller.random.choice(3), taking(caller));
            texere_design_write_to(design, format, callback, user)
        };
        texere_design_draft_to, 1, |caller| {
            let (design, back, (callback, user)) = (caller.handle(), caller.random.choice(2), taking(caller));
            texere_design_draft_to(design, back, callback, user)
        };
        texere_yarns_write_to, 2, |caller| {
            let (yarns, format, (callback, user)) = (caller.handle(), caller.random.choice(4), taking(caller));
            texere_yarns_write_to(yarns, format, callback, user)
        };
        texere_yarns_read_memory, 2, |caller| {
            let (yarns, name, mut file) = (caller.live(), caller.text(&["a.yarns", "a"]), Vec::<u8>::new());
            texere_yarns_write_to(yarns, TEXERE_YARNS_FORMAT_YARNS, Some(keep_bytes), from_mut(&mut file).cast());
            if caller.random.one_in(2) && !file.is_empty() {
                // A file that is cut short, and one with another byte.
                let at = caller.random.below(file.len());
                if caller.random.one_in(2) { file.truncate(at) } else { file[at] ^= 1 << caller.random.below(8) }
            }
            caller.out(|out| {
                texere_yarns_read_memory(name.pointer(), name.length(), file.as_ptr(), file.len(), out)
            })
        };
    }
}
