//! Reading designs from texts.

use std::ptr::null_mut;

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::common::message;

/// The design that a text describes.
pub(crate) fn read(text: &str) -> *mut texere_design {
    let (name, mut design) = ("text.toml", null_mut());
    // SAFETY: all pointers are those of values that live as long as the call.
    let read = unsafe {
        let (name, length) = (name.as_ptr().cast(), name.len());
        texere_design_read_memory(name, length, text.as_ptr(), text.len(), None, null_mut(), &mut design)
    };
    assert_eq!(read, TEXERE_OK, "{}", message());
    design
}
