//! Texts that the library lends to C.

use std::ffi::CString;

/// A text with a zero byte at its end, for C. Zero bytes within it become U+FFFD.
pub(crate) fn lendable(text: impl AsRef<str>) -> CString {
    CString::new(text.as_ref().replace('\0', "\u{fffd}")).unwrap_or_default()
}
