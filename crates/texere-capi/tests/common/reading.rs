//! Reading designs from texts.

use std::ptr::null_mut;

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::common::message;

/// The design that a text describes.
pub(crate) fn read(text: &str) -> *mut texere_design {
    let (name, mut design) = ("text.toml", null_mut());
    // SAFETY: the name, the text and `design` live as long as the call. The text names no files, so
    // that the callback and its value may be null.
    let read = unsafe {
        let (name, length) = (name.as_ptr().cast(), name.len());
        texere_design_read_memory(name, length, text.as_ptr(), text.len(), None, null_mut(), &mut design)
    };
    assert_eq!(read, TEXERE_OK, "{}", message());
    design
}
