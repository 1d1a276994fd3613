//! Calls that have to succeed, and the Rust counterparts of devices and designs.

#![allow(dead_code, reason = "each test uses a part of it")]

use std::io;
use std::path::Path;
use std::ptr::null_mut;
use std::sync::Arc;

use texere::{Backend, Design};
use texere_c::texere_status::*;
use texere_c::*;

use crate::common::message;

/// Fails the test if a call has failed.
#[track_caller]
pub(crate) fn done(status: texere_status) {
    assert_eq!(status, TEXERE_OK, "{}", message());
}

/// The handle that `call` writes to the pointer that it is given.
#[track_caller]
pub(crate) fn made<H>(call: impl FnOnce(*mut *mut H) -> texere_status) -> *mut H {
    let mut handle = null_mut();
    done(call(&mut handle));
    handle
}

/// The names of the backends that open on this machine. The test fails if one that `TEXERE_REQUIRE`
/// names does not open.
pub(crate) fn devices() -> Vec<&'static str> {
    let required = std::env::var("TEXERE_REQUIRE").unwrap_or_default();
    let opens = |name: &&str| {
        let opened = texere::open(name);
        assert!(opened.is_ok() || !required.split(',').any(|each| each.trim() == *name), "{opened:?}");
        opened.is_ok()
    };
    ["cpu", "opencl", "wgpu"].into_iter().filter(opens).collect()
}

/// A device of this name, opened from C and from Rust.
pub(crate) fn opened(name: &str) -> (*mut texere_device, Arc<dyn Backend>) {
    // SAFETY: all pointers are those of values that live as long as the call.
    let device = made(|out| unsafe { texere_device_open(name.as_ptr().cast(), name.len(), out) });
    (device, texere::open(name).unwrap().into())
}

/// The design of a text, as Rust reads it.
pub(crate) fn rust_design(text: &str) -> Design {
    let none = |_: &Path| Err(io::ErrorKind::NotFound.into());
    texere::read_from("text.toml", text.as_bytes(), none).unwrap()
}

/// The text of a call that is made twice: for the length, and for the text.
pub(crate) fn said(call: impl Fn(*mut std::ffi::c_char, usize, *mut usize) -> texere_status) -> String {
    let mut length = 0;
    done(call(null_mut(), 0, &mut length));
    let mut words = vec![0x55_u8; length + 2];
    done(call(words.as_mut_ptr().cast(), length + 1, &mut length));
    assert_eq!(words[length..], [0, 0x55], "a zero byte, and nothing behind it");
    words.truncate(length);
    String::from_utf8(words).unwrap()
}
