//! Texts that the library lends.

use std::ffi::CString;

/// A text as C reads it, with a zero byte at its end.
pub(crate) fn lendable(text: impl AsRef<str>) -> CString {
    CString::new(text.as_ref().replace('\0', "\u{fffd}")).unwrap_or_default()
}
