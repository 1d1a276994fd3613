//! Calls of the C library, as a program in C makes them.

use std::error::Error;
use std::ffi::CStr;
use std::ptr::null_mut;

use texere_c::texere_status::TEXERE_OK;
use texere_c::{texere_design, texere_error_message, texere_status};

/// Fails where a call has failed, with the library's words.
pub(crate) fn done(status: texere_status) -> Result<(), Box<dyn Error>> {
    if status == TEXERE_OK {
        return Ok(());
    }
    // SAFETY: the library ends the words with a zero byte.
    let words = unsafe { CStr::from_ptr(texere_error_message()) };
    Err(format!("{status:?}: {}", words.to_string_lossy()).into())
}

/// The handle that a call writes to the place that it is given.
pub(crate) fn made<H>(call: impl FnOnce(*mut *mut H) -> texere_status) -> Result<*mut H, Box<dyn Error>> {
    let mut handle = null_mut();
    done(call(&mut handle))?;
    Ok(handle)
}

/// A struct of zeros that says its size.
pub(crate) fn sized<T>() -> T {
    // SAFETY: zeros are a value of each of the library's structs that begin with their size.
    unsafe {
        let mut value: T = std::mem::zeroed();
        (&raw mut value).cast::<u32>().write(size_of::<T>() as u32);
        value
    }
}

/// The design of a text.
pub(crate) fn design(text: &str) -> Result<*mut texere_design, Box<dyn Error>> {
    let name = "text.toml";
    // SAFETY: all pointers are those of values that live as long as the call.
    made(|out| unsafe {
        let (name, length) = (name.as_ptr().cast(), name.len());
        texere_c::texere_design_read_memory(name, length, text.as_ptr(), text.len(), None, null_mut(), out)
    })
}

/// A plain weave of round threads, its yarns as they are placed.
pub(crate) fn plain_weave(ends: usize, picks: usize) -> String {
    format!(
        "weave = {{ notation = \"plain\", ends = {ends}, picks = {picks} }}\nfinish.settle = false\n\
         yarns.a.diameter_mm = 0.25\nwarp = {{ yarns = [\"a\"], spacing_mm = 0.75 }}\n\
         weft = {{ yarns = [\"a\"], spacing_mm = 0.75 }}\n"
    )
}
